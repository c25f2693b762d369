#include "terrane/stream/area_chunks.h"

#include <algorithm>

namespace terrane::stream {
namespace {

// Loaded by one job at once.
constexpr std::size_t kChunksOfJob = 32;

}  // namespace

base::Result<std::vector<world::Chunk>> chunksAt(std::span<const world::ChunkPos> positions,
                                                 store::ReadableStore* save, const gen::Generator& generator,
                                                 base::JobSystem& jobs) {
    std::vector<world::Chunk> chunks(positions.size());
    const std::size_t perJob = save ? kChunksOfJob : 1;
    auto done = base::parallelFor(jobs, (positions.size() + perJob - 1) / perJob, [&](std::size_t job) {
        const std::size_t first = job * perJob;
        const auto part = positions.subspan(first, std::min(perJob, positions.size() - first));
        std::vector<store::LoadedChunk> stored(part.size());
        if (save) stored = save->loadMany(part);
        for (std::size_t k = 0; k < part.size(); ++k) {
            if (stored[k].chunk) {
                chunks[first + k] = std::move(*stored[k].chunk);
            } else if (world::isInWorld(part[k])) {
                chunks[first + k] = generator.generate(part[k]);
            }
        }
    });
    if (!done) return tl::unexpected(done.error());
    return chunks;
}

}  // namespace terrane::stream

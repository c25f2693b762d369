#include "terrane/stream/area_chunks.h"

#include <algorithm>
#include <iterator>

namespace terrane::stream {
namespace {

// Chunks that one job loads at once.
constexpr std::size_t kChunksOfJob = 32;

// The stored chunk of each position; none beyond the world's edge, where keys are those of other chunks.
std::vector<store::LoadedChunk> storedOf(std::span<const world::ChunkPos> positions,
                                         store::ReadableStore* save) {
    std::vector<store::LoadedChunk> stored(positions.size());
    if (!save) return stored;
    std::vector<world::ChunkPos> inside;
    std::ranges::copy_if(positions, std::back_inserter(inside), world::isInWorld);
    auto next = inside.empty() ? std::vector<store::LoadedChunk>() : save->loadMany(inside);
    std::size_t n = 0;
    for (std::size_t k = 0; k < positions.size(); ++k)
        if (world::isInWorld(positions[k])) stored[k] = std::move(next[n++]);
    return stored;
}

}  // namespace

base::Result<std::vector<world::Chunk>> chunksAt(std::span<const world::ChunkPos> positions,
                                                 store::ReadableStore* save, const gen::Generator& generator,
                                                 base::JobSystem& jobs) {
    std::vector<world::Chunk> chunks(positions.size(), world::Chunk(generator.heights()));
    const std::size_t perJob = save ? kChunksOfJob : 1, jobCount = (positions.size() + perJob - 1) / perJob;
    std::vector<std::string> problems(jobCount);
    TERRANE_TRY(base::parallelFor(jobs, jobCount, [&](std::size_t job) {
        const std::size_t first = job * perJob;
        const auto part = positions.subspan(first, std::min(perJob, positions.size() - first));
        std::vector<store::LoadedChunk> stored = storedOf(part, save);
        for (std::size_t k = 0; k < part.size(); ++k) {
            // Generating the chunk instead would be wrong, and a caller that saves it would overwrite the
            // stored one.
            if (stored[k].isUnreadable && !stored[k].isOverBudget) problems[job] = stored[k].problem;
            if (stored[k].chunk) {
                chunks[first + k] = std::move(*stored[k].chunk);
            } else if (world::isInWorld(part[k])) {
                chunks[first + k] = generator.generate(part[k]);
            }
        }
    }));
    for (const std::string& problem : problems)
        if (!problem.empty()) return base::fail(base::ErrorCode::Io, "{}", problem);
    return chunks;
}

}  // namespace terrane::stream

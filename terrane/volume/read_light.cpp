#include <algorithm>
#include <optional>
#include <vector>

#include "terrane/light/light_chunk.h"
#include "terrane/volume/read_areas.h"
#include "terrane/volume/read_chunks.h"

namespace terrane::volume {
namespace {

// Side of the square of chunks that is lit at once, with a ring of one chunk around it, since light travels
// up to 15 blocks: 18² chunks of 110 KB of local light are 36 MB.
constexpr int kSquareChunks = 16;

light::LightScratch& volumeLightScratch() {
    thread_local light::LightScratch scratch;
    return scratch;
}

// The local light of an area of chunks and of those around it.
class LitSquare {
  public:
    LitSquare(OpenedWorld& world, const world::ChunkArea& area)
        : world_(world), area_(area), around_{area.x0 - 1, area.y0 - 1, area.x1 + 1, area.y1 + 1} {}

    base::Result<void> load(const GoesOn& goesOn) {
        locals_.resize(static_cast<std::size_t>(around_.chunkCount()));
        return readChunks(world_, chunksOf(around_), goesOn, [&](std::int64_t number, world::Chunk&& chunk) {
            // Beyond the world's edge it is dark.
            if (!world::isInWorld(chunkIn(around_, number))) return;
            locals_[static_cast<std::size_t>(number)] =
                light::solveLocal(chunk, world_.lights(), volumeLightScratch());
        });
    }

    base::Result<void> copyTo(const BlockArea& area, std::span<LightLevels> levels,
                              const GoesOn& goesOn) const {
        return forEachPart(world_, area_.chunkCount(), goesOn, [&](std::int64_t number) {
            const world::ChunkPos pos = chunkIn(area_, number);
            copyLight(light::lightChunk(around(pos), volumeLightScratch()), pos, area, levels);
            return base::Result<void>();
        });
    }

  private:
    light::LocalLightNeighborhood around(world::ChunkPos pos) const {
        light::LocalLightNeighborhood chunks{};
        for (int k = 0; k < light::kFieldChunks; ++k) {
            const std::int64_t x = pos.x + k % 3 - 1 - around_.x0, y = pos.y + k / 3 - 1 - around_.y0;
            const std::int64_t width = std::int64_t{around_.x1} - around_.x0;
            const auto& local = locals_[static_cast<std::size_t>(x + y * width)];
            chunks[static_cast<std::size_t>(k)] = local ? &*local : nullptr;
        }
        return chunks;
    }

    OpenedWorld& world_;
    world::ChunkArea area_, around_;
    std::vector<std::optional<light::LocalLight>> locals_;  // of around_; none outside the world
};

}  // namespace

base::Result<void> readLight(OpenedWorld& world, const BlockArea& area, std::span<LightLevels> levels,
                             const GoesOn& goesOn) {
    const world::ChunkArea chunks = chunksOver(area);
    for (std::int32_t y = chunks.y0; y < chunks.y1; y += kSquareChunks) {
        for (std::int32_t x = chunks.x0; x < chunks.x1; x += kSquareChunks) {
            LitSquare square(world, {x, y, std::min(x + kSquareChunks, chunks.x1),
                                     std::min(y + kSquareChunks, chunks.y1)});
            TERRANE_TRY(square.load(goesOn));
            TERRANE_TRY(square.copyTo(area, levels, goesOn));
        }
    }
    return {};
}

}  // namespace terrane::volume

#include "terrane/volume/areas.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "terrane/light/light_chunk.h"
#include "terrane/volume/read_chunks.h"
#include "terrane/world/chunk.h"

namespace terrane::volume {

namespace {

// Chunks in memory at once for a digest, about 10 KiB each.
constexpr std::int64_t kChunksOfDigest = 1024;

BlockArea areaOfChunk(world::ChunkPos pos, world::Heights heights) {
    const std::int64_t x = std::int64_t{pos.x} * world::kChunkSize,
                       y = std::int64_t{pos.y} * world::kChunkSize;
    return {x, y, heights.bottom, x + world::kChunkSize, y + world::kChunkSize, heights.top};
}

bool hasHigherLevel(std::span<const world::ChunkPos> chunks) {
    for (const world::ChunkPos pos : chunks)
        if (pos.level > 0) return true;
    return false;
}

}  // namespace

base::Result<void> readBlocks(OpenedWorld& world, const BlockArea& area, std::span<world::BlockId> blocks,
                              const ShouldContinue& shouldContinue) {
    const world::ChunkArea chunks = chunksOver(area);
    return readChunks(world, chunksOf(chunks), shouldContinue,
                      [&](std::int64_t number, const world::Chunk& chunk) {
                          copyBlocks(chunk, chunkIn(chunks, number), area, blocks);
                      });
}

base::Result<void> readStates(OpenedWorld& world, const BlockArea& area, std::span<std::uint16_t> states,
                              const ShouldContinue& shouldContinue) {
    const world::ChunkArea chunks = chunksOver(area);
    return readChunks(world, chunksOf(chunks), shouldContinue,
                      [&](std::int64_t number, const world::Chunk& chunk) {
                          copyStates(chunk, chunkIn(chunks, number), area, states);
                      });
}

base::Result<void> readChunkArrays(OpenedWorld& world, std::span<const world::ChunkPos> chunks,
                                   std::span<world::BlockId> blocks, const ShouldContinue& shouldContinue) {
    for (const world::ChunkPos pos : chunks)
        if (!world::isInWorld(pos))
            return base::fail(base::ErrorCode::BadInput, "{}: outside the world", store::nameOf(pos));
    if (hasHigherLevel(chunks)) TERRANE_TRY(world.waitForTiles());
    const ChunkList list{static_cast<std::int64_t>(chunks.size()),
                         [&](std::int64_t number) { return chunks[static_cast<std::size_t>(number)]; }};
    return readChunks(world, list, shouldContinue, [&](std::int64_t number, const world::Chunk& chunk) {
        const world::ChunkPos pos = list.at(number);
        const BlockArea area = areaOfChunk(pos, chunk.heights());
        const auto count = static_cast<std::size_t>(area.blockCount());
        copyBlocks(chunk, pos, area, blocks.subspan(static_cast<std::size_t>(number) * count, count));
    });
}

base::Result<std::string> digestOf(OpenedWorld& world, const world::ChunkArea& area,
                                   const ShouldContinue& shouldContinue) {
    base::Digest digest;
    std::vector<world::Chunk> chunks;
    for (std::int64_t first = 0; first < area.chunkCount(); first += kChunksOfDigest) {
        const ChunkList list{std::min(kChunksOfDigest, area.chunkCount() - first),
                             [&](std::int64_t number) { return chunkIn(area, first + number); }};
        chunks.resize(static_cast<std::size_t>(list.count));
        TERRANE_TRY(readChunks(world, list, shouldContinue, [&](std::int64_t number, world::Chunk&& chunk) {
            chunks[static_cast<std::size_t>(number)] = std::move(chunk);
        }));
        for (const world::Chunk& chunk : chunks) world::addToDigest(digest, chunk);
    }
    return digest.hex();
}

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

    base::Result<void> load(const ShouldContinue& shouldContinue) {
        locals_.resize(static_cast<std::size_t>(around_.chunkCount()));
        return readChunks(world_, chunksOf(around_), shouldContinue,
                          [&](std::int64_t number, world::Chunk&& chunk) {
                              // Beyond the world's edge it is dark.
                              if (!world::isInWorld(chunkIn(around_, number))) return;
                              locals_[static_cast<std::size_t>(number)] =
                                  light::solveLocal(chunk, world_.lights(), volumeLightScratch());
                          });
    }

    base::Result<void> copyTo(const BlockArea& area, std::span<LightLevels> levels,
                              const ShouldContinue& shouldContinue) const {
        return forEachPart(world_, area_.chunkCount(), shouldContinue, [&](std::int64_t number) {
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
                             const ShouldContinue& shouldContinue) {
    const world::ChunkArea chunks = chunksOver(area);
    for (std::int32_t y = chunks.y0; y < chunks.y1; y += kSquareChunks) {
        for (std::int32_t x = chunks.x0; x < chunks.x1; x += kSquareChunks) {
            LitSquare square(world, {x, y, std::min(x + kSquareChunks, chunks.x1),
                                     std::min(y + kSquareChunks, chunks.y1)});
            TERRANE_TRY(square.load(shouldContinue));
            TERRANE_TRY(square.copyTo(area, levels, shouldContinue));
        }
    }
    return {};
}

base::Result<std::int64_t> writeArea(OpenedWorld& world, const BlockArea& area, const BlockValues& values,
                                     const ShouldContinue& shouldContinue) {
    const std::size_t types = world.blocks().types().size();
    const auto unknown = std::ranges::find_if(values.ids, [&](world::BlockId id) { return id >= types; });
    if (unknown != values.ids.end())
        return base::fail(base::ErrorCode::BadInput, "block id {}: this world has 0 to {}", *unknown,
                          types - 1);
    const std::lock_guard lock(world.editMutex());
    const world::ChunkArea chunks = chunksOver(area);
    std::atomic<std::int64_t> changed{0};
    TERRANE_TRY(
        readChunks(world, chunksOf(chunks), shouldContinue, [&](std::int64_t number, world::Chunk&& chunk) {
            const world::ChunkPos pos = chunkIn(chunks, number);
            const std::int64_t count = writeBlocks(values, area, pos, chunk);
            if (count == 0) return;
            changed += count;
            world.store().save(pos, std::make_shared<const world::Chunk>(std::move(chunk)),
                               store::Provenance::Edited);
            world.markEdited(std::span(&pos, 1));
        }));
    return changed.load();
}

}  // namespace terrane::volume

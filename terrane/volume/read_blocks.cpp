#include <vector>

#include "terrane/volume/read_areas.h"
#include "terrane/volume/read_chunks.h"
#include "terrane/world/chunk_digest.h"

namespace terrane::volume {
namespace {

// Chunks in memory at once for a digest, about 10 KiB each.
constexpr std::int64_t kChunksOfDigest = 1024;

BlockArea areaOfChunk(world::ChunkPos pos) {
    const std::int64_t x = std::int64_t{pos.x} * world::kChunkSize,
                       y = std::int64_t{pos.y} * world::kChunkSize;
    return {x, y, 0, x + world::kChunkSize, y + world::kChunkSize, world::kChunkHeight};
}

bool hasHigherLevel(std::span<const world::ChunkPos> chunks) {
    for (const world::ChunkPos pos : chunks)
        if (pos.level > 0) return true;
    return false;
}

}  // namespace

base::Result<void> readBlocks(OpenedWorld& world, const BlockArea& area, std::span<world::BlockId> blocks,
                              const GoesOn& goesOn) {
    const world::ChunkArea chunks = chunksOver(area);
    return readChunks(world, chunksOf(chunks), goesOn, [&](std::int64_t number, const world::Chunk& chunk) {
        copyBlocks(chunk, chunkIn(chunks, number), area, blocks);
    });
}

base::Result<void> readChunkArrays(OpenedWorld& world, std::span<const world::ChunkPos> chunks,
                                   std::span<world::BlockId> blocks, const GoesOn& goesOn) {
    for (const world::ChunkPos pos : chunks)
        if (!world::isInWorld(pos))
            return base::fail(base::ErrorCode::BadInput, "{}: outside the world", store::nameOf(pos));
    if (hasHigherLevel(chunks)) TERRANE_TRY(world.settleTiles());
    const ChunkList list{static_cast<std::int64_t>(chunks.size()),
                         [&](std::int64_t number) { return chunks[static_cast<std::size_t>(number)]; }};
    return readChunks(world, list, goesOn, [&](std::int64_t number, const world::Chunk& chunk) {
        const world::ChunkPos pos = list.at(number);
        constexpr std::size_t kBlocks = world::kBlocksPerChunk;
        copyBlocks(chunk, pos, areaOfChunk(pos),
                   blocks.subspan(static_cast<std::size_t>(number) * kBlocks, kBlocks));
    });
}

base::Result<std::string> digestOf(OpenedWorld& world, const world::ChunkArea& area, const GoesOn& goesOn) {
    base::Digest digest;
    std::vector<world::Chunk> chunks;
    for (std::int64_t first = 0; first < area.chunkCount(); first += kChunksOfDigest) {
        const ChunkList list{std::min(kChunksOfDigest, area.chunkCount() - first),
                             [&](std::int64_t number) { return chunkIn(area, first + number); }};
        chunks.resize(static_cast<std::size_t>(list.count));
        TERRANE_TRY(readChunks(world, list, goesOn, [&](std::int64_t number, world::Chunk&& chunk) {
            chunks[static_cast<std::size_t>(number)] = std::move(chunk);
        }));
        for (const world::Chunk& chunk : chunks) world::addToDigest(digest, chunk);
    }
    return digest.hex();
}

}  // namespace terrane::volume

// Puts blocks into a world as they are, without the rules of applyChange(): for worlds that tests build.
#pragma once

#include <memory>

#include "terrane/world/world.h"

namespace terrane::world {

// False if no chunk is loaded.
inline bool changeChunk(World& world, BlockPos pos, auto change) {
    const ChunkPtr old = world.maybeChunkAt(chunkOf(pos));
    if (!old || !old->heights().contains(pos.z)) return false;
    auto chunk = std::make_shared<Chunk>(*old);
    change(*chunk);
    world.insert(chunkOf(pos), std::move(chunk));
    return true;
}

inline bool putBlock(World& world, BlockPos pos, BlockId id) {
    return changeChunk(world, pos, [&](Chunk& chunk) { chunk.setBlock(blockIndex(pos), id); });
}

inline bool putState(World& world, BlockPos pos, std::uint16_t value) {
    return changeChunk(world, pos, [&](Chunk& chunk) { chunk.setBlockState(blockIndex(pos), value); });
}

}  // namespace terrane::world

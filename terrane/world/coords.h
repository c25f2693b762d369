// Block and chunk coordinates. x and y are horizontal, z is up; one block is 1×1×1.
// x and y are any 32-bit signed integers; z is 0…255.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>

#include "terrane/shared/constants.h"

namespace terrane::world {

constexpr int kChunkSize = static_cast<int>(shared::kChunkSize);
constexpr int kChunkHeight = static_cast<int>(shared::kChunkHeight);
constexpr int kSectionSize = static_cast<int>(shared::kSectionSize);
constexpr int kSectionsPerChunk = static_cast<int>(shared::kSectionsPerChunk);
constexpr int kBlocksPerSection = static_cast<int>(shared::kBlocksPerSection);
constexpr int kBlocksPerChunk = static_cast<int>(shared::kBlocksPerChunk);

// Chunk coordinates run over [-2^27, 2^27): 2^32 blocks / 16.
constexpr std::int32_t kMinChunk = -(1 << 27);
constexpr std::int32_t kMaxChunk = (1 << 27) - 1;

struct ChunkPos {
    std::int32_t x = 0, y = 0;
    auto operator<=>(const ChunkPos&) const = default;
};

struct BlockPos {
    std::int32_t x = 0, y = 0, z = 0;
    auto operator<=>(const BlockPos&) const = default;
};

// Index of a block in its chunk: x + 16 y + 256 z, so that a layer of equal z and a section are contiguous.
using BlockIndex = std::uint16_t;

constexpr ChunkPos chunkOf(BlockPos p) {
    return {p.x >> 4, p.y >> 4};
}  // floors, also below zero

constexpr BlockIndex blockIndex(int xInChunk, int yInChunk, int z) {
    return static_cast<BlockIndex>(xInChunk | yInChunk << 4 | z << 8);
}

// p.z must be in 0…255.
constexpr BlockIndex blockIndex(BlockPos p) {
    return blockIndex(p.x & 15, p.y & 15, p.z);
}

constexpr BlockPos blockPos(ChunkPos c, BlockIndex i) {
    return {c.x * kChunkSize + (i & 15), c.y * kChunkSize + ((i >> 4) & 15), i >> 8};
}

constexpr bool isInHeight(int z) {
    return z >= 0 && z < kChunkHeight;
}

// True where every block of the chunk has 32-bit coordinates.
constexpr bool isInWorld(ChunkPos c) {
    return c.x >= kMinChunk && c.x <= kMaxChunk && c.y >= kMinChunk && c.y <= kMaxChunk;
}

// Chebyshev distance in chunks, without overflow.
constexpr std::int64_t chunkDistance(ChunkPos a, ChunkPos b) {
    const std::int64_t dx = std::int64_t{a.x} - b.x, dy = std::int64_t{a.y} - b.y;
    const std::int64_t ax = dx < 0 ? -dx : dx, ay = dy < 0 ? -dy : dy;
    return ax > ay ? ax : ay;
}

// No two positions have the same hash: multiplying by an odd number and folding the upper half are
// reversible.
struct ChunkPosHash {
    std::size_t operator()(ChunkPos c) const {
        const std::uint64_t key =
            std::uint64_t{static_cast<std::uint32_t>(c.x)} << 32 | static_cast<std::uint32_t>(c.y);
        const std::uint64_t spread =
            key * 0x9E3779B97F4A7C15u;  // 2^64 / golden ratio, which spreads neighbours evenly
        return spread ^ spread >> 32;
    }
};

}  // namespace terrane::world

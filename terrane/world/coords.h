// Block and chunk coordinates. x and y are horizontal, z is up; one block is 1×1×1.
// x and y are any 32-bit signed integers; z is in the world's heights (heights.h).
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "terrane/shared/constants.h"
#include "terrane/world/heights.h"

namespace terrane::world {

constexpr int kChunkSize = static_cast<int>(shared::kChunkSize);
constexpr int kBlocksPerLayer = static_cast<int>(shared::kBlocksPerLayer);
constexpr int kBlocksPerSection = static_cast<int>(shared::kBlocksPerSection);

// Chunk coordinates of level 0 run over [-2^27, 2^27): 2^32 blocks / 16. Each level halves the range.
constexpr std::int32_t kMinChunk = -(1 << 27);
constexpr std::int32_t kMaxChunk = (1 << 27) - 1;

// Levels 0…15. A chunk of level k has 16×16 columns, each 2^k blocks wide, and the height of every chunk. The
// game is played in level 0.
constexpr int kMaxLevel = 15;

struct ChunkPos {
    std::int32_t x = 0, y = 0;  // in chunks of the level
    std::uint8_t level = 0;
    auto operator<=>(const ChunkPos&) const = default;
};

struct BlockPos {
    std::int32_t x = 0, y = 0, z = 0;
    auto operator<=>(const BlockPos&) const = default;
};

// Index of a block in its chunk: x + 16 y + 256 z, so that a layer of equal z and a section are contiguous.
// It is negative below z = 0, and has 20 bits with its sign.
using BlockIndex = std::int32_t;

// Returns the chunk of level 0 that holds the block. Coordinates are rounded down, also below zero.
constexpr ChunkPos chunkOf(BlockPos p) {
    return {p.x >> 4, p.y >> 4};
}

// Returns the chunk of the same level that lies dx, dy chunks away.
constexpr ChunkPos offsetBy(ChunkPos c, std::int32_t dx, std::int32_t dy) {
    return {c.x + dx, c.y + dy, c.level};
}

// Returns the block that lies dx, dy, dz blocks away. Wraps around at the ends of the numbers: what lies past
// the last column is at the other end of the world, where no chunk of the same view is.
constexpr BlockPos offsetBy(BlockPos p, std::int32_t dx, std::int32_t dy, std::int32_t dz) {
    const auto sum = [](std::int32_t a, std::int32_t b) {
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
    };
    return {sum(p.x, dx), sum(p.y, dy), sum(p.z, dz)};
}

// Returns the width of a column of a chunk, in blocks.
constexpr std::int32_t columnWidth(int level) {
    return std::int32_t{1} << level;
}

constexpr BlockIndex blockIndex(int xInChunk, int yInChunk, int z) {
    return xInChunk | yInChunk << 4 | z << 8;
}

// Returns the number of the section that holds a block (heights.h), and the block's index in it.
constexpr int sectionOf(BlockIndex i) {
    return i >> 12;
}
constexpr int indexInSection(BlockIndex i) {
    return i & (kBlocksPerSection - 1);
}

// Returns the index of a block in its chunk.
constexpr BlockIndex blockIndex(BlockPos p) {
    return blockIndex(p.x & 15, p.y & 15, p.z);
}

// Returns the block, or at higher levels the block of the column with the lowest x and y.
constexpr BlockPos blockPos(ChunkPos c, BlockIndex i) {
    const std::int32_t width = columnWidth(c.level);
    return {(c.x * kChunkSize + (i & 15)) * width, (c.y * kChunkSize + ((i >> 4) & 15)) * width, i >> 8};
}

// Returns true if every block of the chunk has 32-bit coordinates.
constexpr bool isInWorld(ChunkPos c) {
    const std::int32_t low = kMinChunk >> c.level, high = kMaxChunk >> c.level;
    return c.x >= low && c.x <= high && c.y >= low && c.y <= high;
}

// Returns the Chebyshev distance between two chunks of one level, without overflow.
constexpr std::int64_t chunkDistance(ChunkPos a, ChunkPos b) {
    const std::int64_t dx = std::int64_t{a.x} - b.x, dy = std::int64_t{a.y} - b.y;
    const std::int64_t ax = dx < 0 ? -dx : dx, ay = dy < 0 ? -dy : dy;
    return ax > ay ? ax : ay;
}

// All blocks from corner to corner, both included; in each coordinate low ≤ high.
struct BlockBox {
    BlockPos low, high;

    // Of a box with more than 2^63 - 1 blocks, such as the whole world, that number.
    std::int64_t blockCount() const {
        constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
        const std::int64_t width = std::int64_t{high.x} - low.x + 1, depth = std::int64_t{high.y} - low.y + 1,
                           height = std::int64_t{high.z} - low.z + 1;
        const bool fits = width <= 0 || depth <= 0 || height <= 0 || width <= kMost / depth / height;
        return fits ? width * depth * height : kMost;
    }
    // Returns block `number` in the order of z, y, x; 0 ≤ number < blockCount().
    BlockPos blockAt(std::int64_t number) const {
        const std::int64_t width = std::int64_t{high.x} - low.x + 1, depth = std::int64_t{high.y} - low.y + 1;
        return {static_cast<std::int32_t>(low.x + number % width),
                static_cast<std::int32_t>(low.y + number / width % depth),
                static_cast<std::int32_t>(low.z + number / width / depth)};
    }
};

// Chunks x0 … x1 − 1, y0 … y1 − 1.
struct ChunkArea {
    std::int32_t x0 = 0, y0 = 0, x1 = 0, y1 = 0;
    std::int64_t chunkCount() const { return (std::int64_t{x1} - x0) * (std::int64_t{y1} - y0); }
};

// Returns (2 radius + 1)² chunks of the middle's level, row by row.
inline std::vector<ChunkPos> chunksWithin(ChunkPos middle, int radius) {
    std::vector<ChunkPos> chunks;
    for (int dy = -radius; dy <= radius; ++dy)
        for (int dx = -radius; dx <= radius; ++dx)
            chunks.push_back({middle.x + dx, middle.y + dy, middle.level});
    return chunks;
}

// Returns the chunks of a level that cover an area of chunks of level 0.
constexpr ChunkArea areaOver(const ChunkArea& area, int level) {
    const auto above = [level](std::int32_t end) { return ((end - 1) >> level) + 1; };
    return {area.x0 >> level, area.y0 >> level, above(area.x1), above(area.y1)};
}

// No two positions in the world have the same hash: coordinates have 28 bits and the level 8, and multiplying
// by an odd number and folding the upper half are reversible.
struct ChunkPosHash {
    std::size_t operator()(ChunkPos c) const {
        const std::uint64_t mask = (1u << 28) - 1;
        const std::uint64_t key = std::uint64_t{c.level} << 56 |
                                  (static_cast<std::uint32_t>(c.x) & mask) << 28 |
                                  (static_cast<std::uint32_t>(c.y) & mask);
        const std::uint64_t spread =
            key * 0x9E3779B97F4A7C15u;  // 2^64 / golden ratio, which spreads neighbors evenly
        return spread ^ spread >> 32;
    }
};

struct BlockPosHash {
    std::size_t operator()(BlockPos p) const {
        return ChunkPosHash{}(chunkOf(p)) ^ static_cast<std::uint32_t>(blockIndex(p));
    }
};

}  // namespace terrane::world

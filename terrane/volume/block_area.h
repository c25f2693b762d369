// Boxes of blocks that are read or written as arrays: their blocks, their chunks, and the position of a
// chunk's blocks in the array. All are plain values; any thread may use them.
//
// An array of an area holds its blocks by z, then y, then x: x is contiguous.
#pragma once

#include <cstddef>
#include <cstdint>

#include "terrane/base/result.h"
#include "terrane/world/coords.h"

namespace terrane::volume {

// Blocks x0 … x1 − 1, y0 … y1 − 1, z0 … z1 − 1.
struct BlockArea {
    std::int64_t x0 = 0, y0 = 0, z0 = 0;
    std::int64_t x1 = 0, y1 = 0, z1 = 0;

    std::int64_t width() const { return x1 - x0; }
    std::int64_t depth() const { return y1 - y0; }
    std::int64_t height() const { return z1 - z0; }
    std::int64_t blockCount() const { return width() * depth() * height(); }  // of a checked area
};

// 2 GiB of block ids, 4 GiB of light.
constexpr std::int64_t kMaxAreaBlocks = std::int64_t{1} << 30;

// Returns BadInput unless the area lies within a world of these heights, has a block, and at most
// kMaxAreaBlocks of them.
[[nodiscard]] base::Result<void> checkArea(const BlockArea& area, world::Heights heights);

// Returns the chunks of level 0 that a checked area touches.
world::ChunkArea chunksOver(const BlockArea& area);

// Returns chunk `number` of an area, by y, then x.
world::ChunkPos chunkIn(const world::ChunkArea& area, std::int64_t number);

// The part of an area that lies in one chunk. x and y count from the chunk's corner, z is the world's.
struct ChunkPart {
    int x0 = 0, y0 = 0, z0 = 0;
    int x1 = 0, y1 = 0, z1 = 0;
    std::int64_t first = 0;  // place of the block x0, y0, z0 in the area's array
};

// Returns the part of the area in a chunk of chunksOver().
ChunkPart partOf(const BlockArea& area, world::ChunkPos chunk);

}  // namespace terrane::volume

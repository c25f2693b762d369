// Copies between chunks and the arrays of areas. Plain functions; any thread, one array by many threads as
// long as their chunks differ.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "terrane/light/chunk_light.h"
#include "terrane/volume/block_area.h"
#include "terrane/world/chunk.h"

namespace terrane::volume {

// Light of a block as four bytes, each 0…15, in this order.
enum LightChannel : int { kSun, kRed, kGreen, kBlue, kChannelCount };
using LightLevels = std::array<std::uint8_t, kChannelCount>;

LightLevels lightLevels(light::LightValue value);

// Copies the chunk's blocks that lie in the area to their place in `blocks`, the area's array. Writes no air:
// the array begins as zeros, and the memory of empty air is never touched.
void copyBlocks(const world::Chunk& chunk, world::ChunkPos pos, const BlockArea& area,
                std::span<world::BlockId> blocks);

// The same for light; every block is written.
void copyLight(const light::ChunkLight& light, world::ChunkPos pos, const BlockArea& area,
               std::span<LightLevels> levels);

// Writes the array's blocks that lie in the chunk to it. `blocks` has one id for all blocks, or one for each
// block of the area. Resets block state and block entity data of blocks that change. Returns how many
// changed.
std::int64_t writeBlocks(std::span<const world::BlockId> blocks, const BlockArea& area, world::ChunkPos pos,
                         world::Chunk& chunk);

}  // namespace terrane::volume

// Reads chunks of a world on all of its threads: from the store, else generated. The module's other readers
// use it. Any thread may call it and takes part in the work.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>

#include "terrane/light/chunk_light.h"
#include "terrane/volume/block_area.h"
#include "terrane/volume/opened_world.h"
#include "terrane/world/chunk.h"

namespace terrane::volume {

// The light of a block as four bytes, each 0…15, in this order.
enum LightChannel : int { kSun, kRed, kGreen, kBlue, kChannelCount };
using LightLevels = std::array<std::uint8_t, kChannelCount>;

LightLevels lightLevels(light::LightValue value);

// Copies the chunk's blocks that lie in the area to their place in `blocks`, the area's array. Writes no air:
// the array begins as zeros, and the memory of empty air is never touched.
void copyBlocks(const world::Chunk& chunk, world::ChunkPos pos, const BlockArea& area,
                std::span<world::BlockId> blocks);

// The same for block states; sections without states are not written.
void copyStates(const world::Chunk& chunk, world::ChunkPos pos, const BlockArea& area,
                std::span<std::uint16_t> states);

// The same for light; every block is written.
void copyLight(const light::ChunkLight& light, world::ChunkPos pos, const BlockArea& area,
               std::span<LightLevels> levels);

// Values for the blocks of an area: one for all, or one for each by z, y, x.
struct BlockValues {
    std::span<const world::BlockId> ids;
    std::span<const std::uint16_t> states = {};  // empty: a block whose id changes gets state 0
};

// Writes the values that lie in the chunk to it. A block whose id changes loses its block entity data.
// Returns how many blocks changed.
std::int64_t writeBlocks(const BlockValues& values, const BlockArea& area, world::ChunkPos pos,
                         world::Chunk& chunk);

// The chunks to read.
struct ChunkList {
    std::int64_t count = 0;
    std::function<world::ChunkPos(std::int64_t number)> at;  // called by several threads
};
ChunkList chunksOf(const world::ChunkArea& area);  // by y, then x

// Calls use(number, chunk) once for each chunk, on several threads and in any order; the chunk is its own.
// Chunks outside the world are empty. Chunks that are damaged in the store are generated. Fails if the store
// could not read a chunk that it may have, if a level has no generator, or if `shouldContinue` says so.
using UseChunk = std::function<void(std::int64_t number, world::Chunk&& chunk)>;
[[nodiscard]] base::Result<void> readChunks(OpenedWorld& world, const ChunkList& list,
                                            const ShouldContinue& shouldContinue, const UseChunk& use);

// Calls work(k) for k = 0 … count − 1 on the world's threads; the calling thread calls shouldContinue between
// parts. The error is that of the lowest k that has one.
[[nodiscard]] base::Result<void> forEachPart(OpenedWorld& world, std::int64_t count,
                                             const ShouldContinue& shouldContinue,
                                             const std::function<base::Result<void>(std::int64_t)>& work);

}  // namespace terrane::volume

// Areas of a world as arrays: block ids, light, surfaces, digests. Any thread; all of the world's threads
// work on a call. All ask `goesOn` (opened_world.h), which may be empty.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "terrane/volume/chunk_arrays.h"
#include "terrane/volume/opened_world.h"

namespace terrane::volume {

// Block ids of a checked area. `blocks` begins as zeros. Errors as readChunks().
[[nodiscard]] base::Result<void> readBlocks(OpenedWorld& world, const BlockArea& area,
                                            std::span<world::BlockId> blocks, const GoesOn& goesOn);

// Whole chunks of any level, in the order of `chunks`: `blocks` has 65,536 for each, by z, y, x, and begins
// as zeros. BadInput if a chunk is outside the world.
[[nodiscard]] base::Result<void> readChunkArrays(OpenedWorld& world, std::span<const world::ChunkPos> chunks,
                                                 std::span<world::BlockId> blocks, const GoesOn& goesOn);

// Light of a checked area, as if all of the world around it were loaded.
[[nodiscard]] base::Result<void> readLight(OpenedWorld& world, const BlockArea& area,
                                           std::span<LightLevels> levels, const GoesOn& goesOn);

// The digest that `terrane generate --digest` prints (world/chunk_digest.h).
[[nodiscard]] base::Result<std::string> digestOf(OpenedWorld& world, const world::ChunkArea& area,
                                                 const GoesOn& goesOn);

}  // namespace terrane::volume

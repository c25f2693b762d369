// Areas of a world as arrays: block ids, light, surfaces, digests. Any thread; all of the world's threads
// work on a call. They call `shouldContinue` (opened_world.h), which may be empty.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "terrane/volume/block_area.h"
#include "terrane/volume/opened_world.h"
#include "terrane/volume/read_chunks.h"

namespace terrane::volume {

// Reads the block ids of a checked area. `blocks` must be zeros at first. Errors are those of readChunks().
[[nodiscard]] base::Result<void> readBlocks(OpenedWorld& world, const BlockArea& area,
                                            std::span<world::BlockId> blocks,
                                            const ShouldContinue& shouldContinue);

// The same for block states: 0 for blocks without one.
[[nodiscard]] base::Result<void> readStates(OpenedWorld& world, const BlockArea& area,
                                            std::span<std::uint16_t> states,
                                            const ShouldContinue& shouldContinue);

// Whole chunks of any level, in the order of `chunks`: `blocks` has 256 a layer for each, by z, y, x, and
// begins as zeros. BadInput if a chunk is outside the world.
[[nodiscard]] base::Result<void> readChunkArrays(OpenedWorld& world, std::span<const world::ChunkPos> chunks,
                                                 std::span<world::BlockId> blocks,
                                                 const ShouldContinue& shouldContinue);

// Reads the light of a checked area, as if all of the world around it were loaded.
[[nodiscard]] base::Result<void> readLight(OpenedWorld& world, const BlockArea& area,
                                           std::span<LightLevels> levels,
                                           const ShouldContinue& shouldContinue);

// Returns the digest that `terrane generate --digest` prints (world/chunk.h).
[[nodiscard]] base::Result<std::string> digestOf(OpenedWorld& world, const world::ChunkArea& area,
                                                 const ShouldContinue& shouldContinue);

// Sets the blocks of areas. Any thread; all of the world's threads work on a call, and other writes wait.
// Sets a checked area to exactly these blocks. No behavior runs (world/block_behavior.h): sand stays in the
// air. Chunks that change are saved as edited; they are durable after the store's next flush(). Returns how
// many blocks changed. BadInput if an id is not a block's: then nothing is written. After another error some
// chunks may be written.
[[nodiscard]] base::Result<std::int64_t> writeArea(OpenedWorld& world, const BlockArea& area,
                                                   const BlockValues& values,
                                                   const ShouldContinue& shouldContinue);

}  // namespace terrane::volume

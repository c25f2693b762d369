// Sets the blocks of areas. Any thread; all of the world's threads work on a call, and other writes wait.
#pragma once

#include <cstdint>
#include <span>

#include "terrane/volume/block_area.h"
#include "terrane/volume/opened_world.h"

namespace terrane::volume {

// Sets a checked area to exactly these blocks: one id for all, or one for each by z, y, x. No behavior runs
// (world/block_behavior.h): sand stays in the air. Chunks that change are saved as edited; they are durable
// after the store's next flush(). Returns how many blocks changed. BadInput if an id is not a block's: then
// nothing is written. After another error some chunks may be written.
[[nodiscard]] base::Result<std::int64_t> writeArea(OpenedWorld& world, const BlockArea& area,
                                                   std::span<const world::BlockId> blocks,
                                                   const GoesOn& goesOn);

}  // namespace terrane::volume

// Behaviors of blocks whose shape is a model (block_model.h): what they stand on or lean at, arms toward
// their neighbors, doors.
#pragma once

#include <vector>

#include "terrane/world/block_behavior.h"

namespace terrane::world {

// stands           goes when the block below goes; upside down, the one above
// leans            goes when the block goes at which it leans, in the direction of its facing
// stands_or_leans  leans in its other form and stands otherwise
// connects         has arms toward opaque cubes and blocks that connect, too
// opens            changes to its other form and back when it is used
// door             opens; NAME and NAME_top are its halves, which come, go and open together
std::vector<BlockBehavior> shapeBehaviors();

// Whether the block is the upper half of a door; of such a one, and of the lower half, the other one: air
// where the door has none.
bool isUpperHalf(const BlockType& type);
BlockId otherHalf(const BlockRegistry& blocks, BlockId id);

// Where a player builds a block.
struct Placement {
    Face face = kFacePosZ;   // of the block that it builds against
    float heightInCell = 0;  // of the spot on that face, 0…1
    float yaw = 0;           // degrees, of the player's look
};

// The block state with which a block is built: it faces where the player looks, or the wall that it leans at,
// and is upside down where it is built under a block or against the upper half of a side.
std::uint16_t placedState(const BlockType& type, const Placement& placement);

}  // namespace terrane::world

// Behaviors of blocks whose shape is a model (block_model.h): supports, arms toward neighbors, doors.
#pragma once

#include <vector>

#include "terrane/world/block_behavior.h"

namespace terrane::world {

// stands           is removed with the block below; if upside down, with the one above
// leans            is removed with the block at which it leans, in the direction of its facing
// stands_or_leans  leans in its other form and stands otherwise
// connects         has arms toward opaque cubes and blocks that connect, too
// opens            changes to its other form and back when it is used
// door             opens; NAME and NAME_top are its halves, placed, removed and opened together
std::vector<BlockBehavior> shapeBehaviors();

// Whether the block is the upper half of a door. otherHalf() gives the other half of a door; air if it has
// none.
bool isUpperHalf(const BlockType& type);
BlockId otherHalf(const BlockRegistry& blocks, BlockId id);

// The place at which a player builds a block.
struct Placement {
    Face face = kFacePosZ;   // of the block that it builds against
    float heightInCell = 0;  // of the spot on that face, 0…1
    float yaw = 0;           // degrees, of the player's look
};

// The state of a block that is built: it faces where the player looks, or the wall at which it leans, and is
// upside down if built under a block or against the upper half of a side.
std::uint16_t placedState(const BlockType& type, const Placement& placement);

}  // namespace terrane::world

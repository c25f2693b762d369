// Block states of turned and mirrored blocks. Plain functions; any thread.
#pragma once

#include <cstdint>

#include "terrane/world/block_type.h"

namespace terrane::world {

enum class MirrorAxis : std::uint8_t { X, Y };  // the coordinate that changes its sign

// Bits of the state that follow from the neighbors of a block (`connects`).
std::uint16_t armBits(const BlockType& type);

// The state of the block after `turns` quarter turns about z, counterclockwise seen from above: +x becomes
// +y. Facing and arms turn, all else stays. Any number of turns, also below 0.
std::uint16_t turnedState(const BlockType& type, std::uint16_t state, int turns);

// The state of the block seen in a mirror. A shape that is not its own mirror image (an open door) faces the
// mirrored way and keeps its hinge.
std::uint16_t mirroredState(const BlockType& type, std::uint16_t state, MirrorAxis axis);

}  // namespace terrane::world

// Converts properties of Minecraft's blocks to block states and back: facing, halves, open doors, arms of
// fences, levels of water, growth. Called by block_mapping.h. Plain functions; any thread.
//
// Minecraft's x, y, z (east, up, south) are our -x, z, y, so that the sun rises in the same east and maps
// have the same north, -y (game/places.h). Nothing is mirrored.
#pragma once

#include <cstdint>

#include "terrane/formats/named_state.h"
#include "terrane/world/block_type.h"

namespace terrane::formats {

// The bits of the state that the properties of `state` give a block of `type`; 0 if they give none.
// `isOpposite`: the block faces against its property.
std::uint16_t stateOfProperties(const world::BlockType& type, const NamedState& state, bool isOpposite);

// Adds the properties that correspond to the block state. Properties that `named` already has stay.
void addProperties(const world::BlockType& type, std::uint16_t state, bool isOpposite, NamedState& named);

}  // namespace terrane::formats

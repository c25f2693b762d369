// The outermost layer of a section as bits: what the section next to it needs to know. Used by
// section_faces.cpp for the six neighbours of a section; any thread.
#pragma once

#include "terrane/mesh/bit_cube.h"
#include "terrane/world/block_registry.h"

namespace terrane::mesh {

// Opaque cubes in the layer of `section` on its side `side`.
BitSlice opaqueOnSide(const world::Section& section, world::Face side, const world::BlockRegistry& blocks);

// Blocks of one id in that layer.
BitSlice blocksOnSide(const world::Section& section, world::Face side, world::BlockId id);

// True where no block of the section lets one see through; may be false for some such sections.
bool isAllOpaque(const world::Section& section, const world::BlockRegistry& blocks);

}  // namespace terrane::mesh

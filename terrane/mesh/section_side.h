// The outermost layer of a section as bits, for the adjacent section. Used by section_faces.cpp for the six
// neighbors of a section; any thread.
#pragma once

#include <array>
#include <cstdint>

#include "terrane/mesh/bit_cube.h"
#include "terrane/world/block_registry.h"

namespace terrane::mesh {

// The layer of a section on one of its sides. Refers to the section.
class SectionSide {
  public:
    SectionSide(const world::Section& section, world::Face side);

    BitSlice opaqueCubes(const world::BlockRegistry& blocks) const;
    BitSlice blocks(world::BlockId id) const;

  private:
    static constexpr std::size_t kGroups = 4;  // of 64 blocks

    BitSlice blocksOfIndex(std::size_t index) const;
    BitSlice denseOpaqueCubes(const world::BlockRegistry& blocks) const;

    const world::Section& section_;
    world::Face side_;
    std::array<std::uint64_t, kGroups * 16> planes_;  // as in bit_kernels.h; 16 bits at most
};

// True if all blocks of the section are opaque cubes; may be false for some such sections.
bool isAllOpaque(const world::Section& section, const world::BlockRegistry& blocks);

}  // namespace terrane::mesh

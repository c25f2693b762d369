// Blocks of one section as sets of bits, one set for each distinct id. Read from the packed form: the bits of
// all indices are sorted into planes once, then the blocks of an id take a few ANDs. Used by
// section_faces.cpp for one section at a time; any thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "terrane/mesh/bit_cube.h"
#include "terrane/world/section.h"

namespace terrane::mesh {

class SectionBits {
  public:
    explicit SectionBits(const world::Section& section);

    // Distinct ids; some may have no block.
    std::span<const world::BlockId> ids() const { return ids_; }
    // Blocks of ids()[number], in rows along x.
    BitCube blocks(std::size_t number) const;

  private:
    static constexpr std::size_t kMaxBits = 16;  // of a block in the dense form
    static constexpr std::size_t kGroups = 64;   // of 64 blocks

    std::size_t bits_;
    std::vector<world::BlockId> ids_;
    std::array<std::uint64_t, kGroups * kMaxBits> planes_;  // as in bit_kernels.h
};

}  // namespace terrane::mesh

// Finds the visible faces of one section by the rules of each shape and passes them to a FaceWriter.
// chunk_mesher.cpp calls it for each section of a chunk, on the meshing worker's thread.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "terrane/mesh/bit_cube.h"
#include "terrane/mesh/face_writer.h"
#include "terrane/mesh/quad_collector.h"
#include "terrane/mesh/shape_faces.h"
#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/section.h"

namespace terrane::mesh {

// Returns whether a face toward a block of the same type is left out. Both back ends of the mesher follow
// this rule and the next. Blocks with inner faces have two at each shared side. If both are two-sided they
// look the same, so only the block at the lower coordinate has one.
inline bool hidesSameType(const world::BlockType& type, world::Face side,
                          const world::BlockRegistry& blocks) {
    if (!type.innerFaces || type.shape == world::Shape::Liquid) return true;
    const bool isPositive = side % 2 == 1;
    return !isPositive && blocks.materials()[type.material[oppositeSide(side)]].twoSided;
}

// Returns whether faces merge. Faces whose texture waves at the top only do not: a face taller than one block
// would wave only at its top.
inline bool mergesFaces(const world::BlockType& type, world::Face side, const world::BlockRegistry& blocks) {
    return blocks.materials()[type.material[side]].animation != world::Animation::TopWaves;
}

// Blocks of one section as sets of bits, one set for each distinct id. Read from the packed form: the bits of
// all indices are sorted into planes once, then the blocks of an id take a few ANDs. section_faces.cpp uses
// it for one section at a time; any thread may use it.
class SectionBits {
  public:
    explicit SectionBits(const world::Section& section);

    // Returns the distinct ids; some may have no block.
    std::span<const world::BlockId> ids() const { return ids_; }
    // Returns the blocks of ids()[number], in rows along x.
    BitCube blocks(std::size_t number) const;

  private:
    static constexpr std::size_t kMaxBits = 16;  // of a block in the dense form
    static constexpr std::size_t kGroups = 64;   // of 64 blocks

    std::size_t bits_;
    std::vector<world::BlockId> ids_;
    std::array<std::uint64_t, kGroups * kMaxBits> planes_;  // as in bit_kernels.h
};

// The outermost layer of a section on one of its sides as bits, for the meshing of the adjacent section. It
// refers to the section.
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

// Returns true if all blocks of the section are opaque cubes; may be false for some such sections.
bool isAllOpaque(const world::Section& section, const world::BlockRegistry& blocks);

// A section and its neighbors.
struct SectionView {
    const world::Section* center = nullptr;
    // By side. Null above the world, where there is air; below it, which is never visible; and beyond an open
    // border (MeshInput).
    std::array<const world::Section*, world::kFaceCount> neighbors{};
    const world::Section* blockState = nullptr;             // of the section's blocks
    std::array<const world::Section*, 4> neighborStates{};  // null where `neighbors` are
    const world::BlockRegistry* blocks = nullptr;
    FaceTarget target;
};

void addSectionFaces(const SectionView& view, QuadCollector& out);

}  // namespace terrane::mesh

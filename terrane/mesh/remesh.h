// Remeshing after an edit: the mesh sections that may change with a block, and the mesh of only these. All
// functions are pure; any thread may call them.
#pragma once

#include <algorithm>
#include <bitset>
#include <cstddef>
#include <vector>

#include "terrane/mesh/chunk_mesher.h"
#include "terrane/world/coords.h"

namespace terrane::mesh {

// Parts of a column, each kMinMeshSectionHeight = 8 layers high: part z >> 3 has layer z, −256…255. A mesh
// section has one or several of them, and is in the set if one of its parts is.
class MeshSectionSet {
  public:
    // Returns all parts of these heights.
    static MeshSectionSet all(world::Heights heights) {
        MeshSectionSet set;
        for (int number = partOf(heights.bottom); number < partOf(heights.top); ++number) set.add(number);
        return set;
    }

    void add(int number) { bits_.set(indexOf(number)); }
    bool has(int number) const { return bits_[indexOf(number)]; }
    // Returns whether one of the layers bottom … top − 1 is in a part of the set. Both are multiples of 8;
    // layers outside of every world are in none.
    bool hasAny(int bottom, int top) const {
        const int end = std::min(partOf(top), kFirst + static_cast<int>(kParts));
        for (int number = std::max(partOf(bottom), kFirst); number < end; ++number)
            if (has(number)) return true;
        return false;
    }
    bool has(const MeshSection& meshSection) const { return hasAny(meshSection.bottom, meshSection.top); }
    bool isEmpty() const { return bits_.none(); }
    std::size_t count() const { return bits_.count(); }
    MeshSectionSet& operator|=(const MeshSectionSet& other) {
        bits_ |= other.bits_;
        return *this;
    }
    bool operator==(const MeshSectionSet&) const = default;

    // Calls use(number) for each part, from below.
    template <class Use>
    void forEach(Use use) const {
        if (bits_.none()) return;
        for (int number = kFirst; number < kFirst + static_cast<int>(kParts); ++number)
            if (has(number)) use(number);
    }

  private:
    static constexpr std::size_t kParts = world::kMostLayers / kMinMeshSectionHeight;
    static constexpr int kFirst = world::kLowestBottom / kMinMeshSectionHeight;

    static constexpr int partOf(int z) { return z >> 3; }
    static std::size_t indexOf(int number) { return static_cast<std::size_t>(number - kFirst); }
    std::bitset<kParts> bits_;

    static_assert(kMinMeshSectionHeight == 1 << 3);
};

// Parts of all worlds.
inline const MeshSectionSet kAllMeshSections =
    MeshSectionSet::all({world::kLowestBottom, world::kHighestTop});

struct TouchedChunk {
    world::ChunkPos pos;
    MeshSectionSet meshSections;

    bool operator==(const TouchedChunk&) const = default;
};

// Returns the parts of columns in which a face may change with the block at `pos`: its own, and those of its
// six neighbors. At most three chunks, the block's own first; none outside the world.
std::vector<TouchedChunk> meshSectionsTouchedBy(world::BlockPos pos);

// Builds the mesh sections of the set as meshChunk() does, and no others.
ChunkMesh buildMeshSections(const MeshInput& input, const MeshSectionSet& meshSections, MeshScratch& scratch);

// Returns `old` with the mesh sections of the set replaced by those of `newer`, which was made with the same
// options.
ChunkMesh withMeshSections(const ChunkMesh& old, const ChunkMesh& newer, const MeshSectionSet& meshSections);

}  // namespace terrane::mesh

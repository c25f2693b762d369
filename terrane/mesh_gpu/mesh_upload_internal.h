// Chunks in the form that the meshing shaders read: sections in their packed form, and a list of those with
// faces that may be visible. It uses no OpenGL.
#pragma once

#include <span>
#include <unordered_map>
#include <vector>

#include "terrane/mesh/chunk_mesher.h"
#include "terrane/mesh_gpu/block_table.h"
#include "terrane/shared/mesher.h"
#include "terrane/world/section.h"

namespace terrane::mesh_gpu {

class MeshUpload {
  public:
    explicit MeshUpload(const BlockTable& types) : types_(types) {}  // outlives it

    void clear();
    // Adds a chunk. Chunks of a batch have the same options and stay at their address until clear(): sections
    // shared by several chunks are stored once.
    void add(const mesh::MeshInput& chunk);

    std::span<const shared::MeshUnit> units() const { return units_; }
    const world::PackedSections& packed() const { return packed_; }
    // Returns the mesh sections that units are in, of one chunk after the other, without quads.
    std::span<const mesh::MeshSection> meshSections() const { return meshSections_; }
    // Returns the number of mesh sections up to the end of each chunk.
    std::span<const std::size_t> chunkEnds() const { return chunkEnds_; }

  private:
    shared::uint slotOf(const world::Section& section, bool holdsBlocks);
    void addUnits(const mesh::MeshInput& chunk, int number);
    bool mayBeSeen(const mesh::MeshInput& chunk, int number) const;
    shared::uint meshSectionOf(int z, int height);

    const BlockTable& types_;
    std::vector<shared::MeshUnit> units_;
    world::PackedSections packed_;
    std::unordered_map<const world::Section*, shared::uint> slots_;
    std::vector<mesh::MeshSection> meshSections_;
    std::vector<std::size_t> chunkEnds_;
};

}  // namespace terrane::mesh_gpu

// Remeshing after an edit: the mesh sections that may change with a block, and the mesh of only these. All
// functions are pure; any thread may call them.
#pragma once

#include <cstdint>
#include <vector>

#include "terrane/mesh/chunk_mesher.h"
#include "terrane/world/coords.h"

namespace terrane::mesh {

// One bit a mesh section, the lowest mesh section in bit 0.
using MeshSectionSet = std::uint32_t;
constexpr MeshSectionSet kAllMeshSections = ~MeshSectionSet{0};
static_assert(world::kChunkHeight / kMinMeshSectionHeight <= 32);

constexpr bool hasMeshSection(MeshSectionSet meshSections, std::size_t meshSection) {
    return (meshSections >> meshSection & 1) != 0;
}

struct TouchedChunk {
    world::ChunkPos pos;
    MeshSectionSet meshSections = 0;

    bool operator==(const TouchedChunk&) const = default;
};

// Returns the mesh sections in which a face may change with the block at `pos` (z 0…255): its own, and those
// of its six neighbors. At most three chunks, the block's own first; none outside the world.
std::vector<TouchedChunk> meshSectionsTouchedBy(world::BlockPos pos, int meshSectionHeight);

// Builds these mesh sections as meshChunk() does; the others have no quads. Bits beyond the highest mesh
// section are ignored.
ChunkMesh buildMeshSections(const MeshInput& input, MeshSectionSet meshSections, MeshScratch& scratch);

// Returns `old` with these mesh sections replaced by those of `newer`, which was made with the same options.
ChunkMesh withMeshSections(const ChunkMesh& old, const ChunkMesh& newer, MeshSectionSet meshSections);

}  // namespace terrane::mesh

// What an edit costs: which mesh sections' meshes change with a block, and the mesh of only these. Called by
// whoever owns the world; pure functions, any thread.
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

// The mesh sections in which a face may change when the block at `pos` (z 0…255) does: its own, and those of
// the six blocks beside it. At most three chunks, the block's own first; none outside the world.
std::vector<TouchedChunk> meshSectionsTouchedBy(world::BlockPos pos, int meshSectionHeight);

// What meshChunk makes of these mesh sections; the others have no quads. Bits beyond the highest mesh section
// are passed over.
ChunkMesh buildMeshSections(const MeshInput& input, MeshSectionSet meshSections, MeshScratch& scratch);

// `old` with `meshSections` as `newer` has them: both were made with the same options.
ChunkMesh withMeshSections(const ChunkMesh& old, const ChunkMesh& newer, MeshSectionSet meshSections);

}  // namespace terrane::mesh

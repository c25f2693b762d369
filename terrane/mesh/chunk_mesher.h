// Makes the mesh of a chunk: drops hidden faces, merges equal neighboring faces and sorts the quads for
// drawing. The streaming workers call it, each with a scratch of its own; the result depends on the input
// only.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "terrane/mesh/mesh_options.h"
#include "terrane/mesh/mesh_section_quads.h"
#include "terrane/mesh/quad_collector.h"
#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/chunk.h"

namespace terrane::mesh {

struct MeshInput {
    const world::Chunk* center = nullptr;
    // -x, +x, -y, +y; air beyond their heights. Null: unknown, the border is open. Faces of opaque cubes on
    // an open border are drawn down to the bottom, so that no gap shows beside lower land and caves; faces
    // that a block of the same type would hide (water) are not.
    std::array<const world::Chunk*, 4> neighbors{};
    const world::BlockRegistry* blocks = nullptr;
    MeshOptions options;
};

// The chunks that a mesh depends on: its own, then those at -x, +x, -y, +y. Null beyond the world's edge,
// which counts as air.
using MeshBlocks = std::array<world::ChunkPtr, 5>;

// Returns the input of the mesh of the first chunk; it points into `chunks`.
MeshInput meshInput(const MeshBlocks& chunks, const world::BlockRegistry& blocks, const MeshOptions& options);

// Memory reused from chunk to chunk; it has no state between calls.
struct MeshScratch {
    QuadCollector buckets;
    std::vector<shared::Quad> quads;
};

// Meshes a chunk. Quads stay inside one section and mesh section, so they are at most 16 blocks wide and
// high.
ChunkMesh meshChunk(const MeshInput& input, MeshScratch& scratch);

// Meshes a chunk surrounded by air.
ChunkMesh meshAlone(const world::Chunk& chunk, const world::BlockRegistry& blocks);
// Meshes a chunk with four open borders.
ChunkMesh meshTile(const world::Chunk& chunk, const world::BlockRegistry& blocks, const MeshOptions& options,
                   MeshScratch& scratch);

// Meshes the mesh section of a chunk that begins with layer `bottom`, and appends its quads to `quads`. Its
// ranges are indices into `quads`. Returns nothing if it has no quads.
std::optional<MeshSection> buildMeshSection(const MeshInput& input, int bottom, MeshScratch& scratch,
                                            std::vector<shared::Quad>& quads);

// Calls use(bottom, top) for the layers of each mesh section of a chunk, from below. The first and the last
// one may reach beyond the chunk.
template <class Use>
void forEachMeshSection(const MeshInput& input, Use use) {
    const world::Heights heights = input.center->heights();
    const int height = input.options.meshSectionHeight;
    // Heights of mesh sections are powers of two.
    for (int z = heights.bottom & ~(height - 1); z < heights.top; z += height) use(z, z + height);
}

// Meshes many chunks. Back ends: the CPU here, compute shaders in terrane/mesh_gpu. They give the same quads
// and ranges; the order of quads within a range differs between back ends.
class BatchMesher {
  public:
    virtual ~BatchMesher() = default;

    // Returns meshes in the order of `chunks`, which have the same registry and options.
    virtual std::vector<ChunkMesh> mesh(std::span<const MeshInput> chunks) = 0;
    virtual std::string_view backend() const = 0;  // "cpu" or "gpu"
};

// Creates the mesher of the CPU, which any one thread may use.
std::unique_ptr<BatchMesher> makeCpuMesher();

}  // namespace terrane::mesh

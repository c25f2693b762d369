// The work on a chunk as functions that workers run, independent of the pipeline.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "terrane/gen/generator.h"
#include "terrane/light/light_chunk.h"
#include "terrane/mesh/remesh.h"
#include "terrane/store/chunk_store.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::stream {

using LocalLightPtr = std::shared_ptr<const light::LocalLight>;
using MeshPtr = std::shared_ptr<const mesh::ChunkMesh>;

// The sources of chunks. All outlive the jobs.
struct ChunkSource {
    const gen::Generator* generator = nullptr;  // null: a batch generator makes chunks
    store::ChunkStore* store = nullptr;         // null: nothing is stored
    bool storesGenerated = false;               // else only edited chunks are stored
};

// A chunk and its lowest open section (light/light_sources.h), which only worlds with partial chunks need:
// elsewhere it is above the chunk.
struct ReadChunk {
    std::shared_ptr<world::Chunk> chunk;  // null: there is none
    int lowestOpen = 0;

    explicit operator bool() const { return chunk != nullptr; }
};

// Loads a chunk from the store, which has whole ones. Returns null if it has none.
ReadChunk loadStored(const ChunkSource& source, world::ChunkPos pos, const light::LightTable& lights);
// Generates a chunk at least down to `section`, and kClosedSections below its lowest open section (depth.h).
// Requires a generator.
ReadChunk generateTo(const ChunkSource& source, world::ChunkPos pos, int section,
                     const light::LightTable& lights);
// Does the same and stores the chunk if the source says so. Returns null if there is no generator.
ReadChunk generateChunk(const ChunkSource& source, world::ChunkPos pos, int section,
                        const light::LightTable& lights);

// Stores a generated chunk if it is whole and the source says so.
void storeGenerated(const ChunkSource& source, world::ChunkPos pos, const world::ChunkPtr& chunk);

// Returns the light of a chunk's own blocks.
LocalLightPtr localLight(const world::Chunk& chunk, const light::LightTable& table);

// A set of sides, a bit for each in the order of mesh::MeshBlocks: -x, +x, -y, +y.
using SideSet = std::uint8_t;

// The input for the light and mesh of a chunk: 3×3 chunks, x + 3 y. A chunk is null beyond the world's edge,
// which counts as air for meshes and as dark for light. Local light that is null is computed first.
struct ChunkNeighborhood {
    std::array<world::ChunkPtr, 9> chunks;
    std::array<LocalLightPtr, 9> localLights;
    mesh::MeshBlocks meshed;  // input of the mesh of the middle one, before closeCaves()
    SideSet openSides = 0;    // of the middle one: tiles lie there (meshing.h)
};

light::ChunkLightPtr lightOf(const ChunkNeighborhood& around, const light::LightTable& table);
// Returns the input of the mesh of the middle one of 3×3 chunks.
inline mesh::MeshBlocks meshBlocksOf(const std::array<world::ChunkPtr, 9>& chunks) {
    return {chunks[4], chunks[3], chunks[5], chunks[1], chunks[7]};
}
// Returns the input of the mesh of the middle one, with its caves closed toward tiles: these have none, so a
// cave that goes on in a tile's place would end at the sunlit side of the tile. The outermost blocks become
// those of the cave's roof where no daylight is.
mesh::MeshBlocks closeCaves(const ChunkNeighborhood& around, const light::ChunkLight& light,
                            const world::BlockRegistry& blocks);
MeshPtr meshOf(const mesh::MeshBlocks& chunks, const world::BlockRegistry& blocks,
               const mesh::MeshOptions& options, mesh::MeshSectionSet meshSections = mesh::kAllMeshSections);

}  // namespace terrane::stream

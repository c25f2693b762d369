// The work that a chunk needs, as functions that workers run: nothing here knows of the pipeline.
#pragma once

#include <array>
#include <memory>

#include "terrane/gen/generator.h"
#include "terrane/light/light_chunk.h"
#include "terrane/mesh/remesh.h"
#include "terrane/store/chunk_store.h"
#include "terrane/world/block_registry.h"

namespace terrane::stream {

using LocalLightPtr = std::shared_ptr<const light::LocalLight>;
using MeshPtr = std::shared_ptr<const mesh::ChunkMesh>;

// Where chunks come from. All outlive the jobs.
struct ChunkSource {
    const gen::Generator* generator = nullptr;  // null: chunks that are not stored are made elsewhere
    store::ChunkStore* store = nullptr;         // null: nothing is stored
    bool storesGenerated = false;               // else only edited chunks are stored
};

// From the store. Null where it has none.
std::shared_ptr<world::Chunk> loadStored(const ChunkSource& source, world::ChunkPos pos);
// From the generator, stored where the source says so. Null where it is to be made elsewhere.
std::shared_ptr<world::Chunk> generateChunk(const ChunkSource& source, world::ChunkPos pos);

// Stores a generated chunk where the source says so.
void storeGenerated(const ChunkSource& source, world::ChunkPos pos, const world::ChunkPtr& chunk);

// The light that a chunk's own blocks give.
LocalLightPtr localLight(const world::Chunk& chunk, const light::LightTable& table);

// What a chunk needs to become visible: 3×3 chunks, x + 3 y. Null beyond the world's edge, which counts as
// air for meshes and as dark for light. Local light that is null is computed first.
struct ChunkNeighborhood {
    std::array<world::ChunkPtr, 9> chunks;
    std::array<LocalLightPtr, 9> localLights;
    mesh::MeshBlocks meshed;  // what the middle one is meshed from
};

light::ChunkLightPtr lightOf(const ChunkNeighborhood& around, const light::LightTable& table);
// Of 3×3 chunks those that the middle one is meshed from.
inline mesh::MeshBlocks meshBlocksOf(const std::array<world::ChunkPtr, 9>& chunks) {
    return {chunks[4], chunks[3], chunks[5], chunks[1], chunks[7]};
}
MeshPtr meshOf(const mesh::MeshBlocks& chunks, const world::BlockRegistry& blocks,
               const mesh::MeshOptions& options, mesh::MeshSectionSet meshSections = mesh::kAllMeshSections);

}  // namespace terrane::stream

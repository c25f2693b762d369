#include "terrane/stream/chunk_jobs.h"

#include "terrane/base/profile.h"

namespace terrane::stream {
namespace {

// Memory that light and mesh reuse from chunk to chunk, for each worker.
light::LightScratch& lightScratch() {
    thread_local light::LightScratch scratch;
    return scratch;
}

}  // namespace

std::shared_ptr<world::Chunk> loadStored(const ChunkSource& source, world::ChunkPos pos) {
    if (!source.store) return nullptr;
    TERRANE_ZONE("load chunk");
    store::LoadedChunk stored = source.store->load(pos);
    return stored.state == store::LoadedChunk::State::Present ? stored.chunk : nullptr;
}

std::shared_ptr<world::Chunk> generateChunk(const ChunkSource& source, world::ChunkPos pos) {
    if (!source.generator) return nullptr;
    const auto chunk = std::make_shared<world::Chunk>(source.generator->generate(pos));
    storeGenerated(source, pos, chunk);
    return chunk;
}

void storeGenerated(const ChunkSource& source, world::ChunkPos pos, const world::ChunkPtr& chunk) {
    if (source.store && source.storesGenerated) source.store->save(pos, chunk, store::Provenance::Generated);
}

LocalLightPtr localLight(const world::Chunk& chunk, const light::LightTable& table) {
    TERRANE_ZONE("local light");
    return std::make_shared<const light::LocalLight>(light::solveLocal(chunk, table, lightScratch()));
}

light::ChunkLightPtr lightOf(const ChunkNeighborhood& around, const light::LightTable& table) {
    std::array<LocalLightPtr, 9> locals = around.localLights;
    for (std::size_t n = 0; n < locals.size(); ++n) {
        if (!locals[n] && around.chunks[n]) locals[n] = localLight(*around.chunks[n], table);
    }
    TERRANE_ZONE("light chunk");
    light::LocalLightNeighborhood neighborhood{};
    for (std::size_t n = 0; n < locals.size(); ++n) neighborhood[n] = locals[n].get();
    return std::make_shared<const light::ChunkLight>(light::lightChunk(neighborhood, lightScratch()));
}

MeshPtr meshOf(const mesh::MeshBlocks& chunks, const world::BlockRegistry& blocks,
               const mesh::MeshOptions& options, mesh::MeshSectionSet meshSections) {
    TERRANE_ZONE("mesh chunk");
    thread_local mesh::MeshScratch scratch;
    const mesh::MeshInput input = mesh::meshInput(chunks, blocks, options);
    return std::make_shared<const mesh::ChunkMesh>(mesh::buildMeshSections(input, meshSections, scratch));
}

}  // namespace terrane::stream

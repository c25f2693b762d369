#include "terrane/stream/chunk_jobs.h"

#include <algorithm>

#include "terrane/base/profile.h"
#include "terrane/mesh/section_faces.h"
#include "terrane/stream/depth.h"

namespace terrane::stream {
namespace {

// Memory that light and mesh reuse from chunk to chunk, for each worker.
light::LightScratch& lightScratch() {
    thread_local light::LightScratch scratch;
    return scratch;
}

}  // namespace

namespace {

ReadChunk wholeChunk(std::shared_ptr<world::Chunk> chunk, const light::LightTable& lights) {
    const world::Heights heights = chunk->heights();
    const int lowestOpen =
        hasPartialChunks(heights) ? light::lowestOpenSection(*chunk, lights) : heights.endSection();
    return {std::move(chunk), lowestOpen};
}

}  // namespace

ReadChunk loadStored(const ChunkSource& source, world::ChunkPos pos, const light::LightTable& lights) {
    if (!source.store) return {};
    TERRANE_ZONE("load chunk");
    store::LoadedChunk stored = source.store->load(pos);
    if (stored.state != store::LoadedChunk::State::Present) return {};
    return wholeChunk(std::move(stored.chunk), lights);
}

ReadChunk generateTo(const ChunkSource& source, world::ChunkPos pos, int section,
                     const light::LightTable& lights) {
    const gen::Generator& generator = *source.generator;
    if (section <= generator.heights().firstSection())
        return wholeChunk(std::make_shared<world::Chunk>(generator.generate(pos)), lights);
    light::OpenSections sections(lights);
    int lowestOpen = generator.heights().endSection();
    const auto goesOn = [&](const world::Chunk& chunk, int lowest) {
        if (sections.isOpen(chunk.section(lowest))) lowestOpen = lowest;
        return lowest > std::min(section, lowestOpen - kClosedSections);
    };
    auto chunk = std::make_shared<world::Chunk>(generator.generateDown(pos, goesOn));
    return {std::move(chunk), lowestOpen};
}

ReadChunk generateChunk(const ChunkSource& source, world::ChunkPos pos, int section,
                        const light::LightTable& lights) {
    if (!source.generator) return {};
    ReadChunk read = generateTo(source, pos, section, lights);
    storeGenerated(source, pos, read.chunk);
    return read;
}

void storeGenerated(const ChunkSource& source, world::ChunkPos pos, const world::ChunkPtr& chunk) {
    const bool isWhole = chunk->isMade(chunk->heights().firstSection());
    if (source.store && source.storesGenerated && isWhole)
        source.store->save(pos, chunk, store::Provenance::Generated);
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

namespace {

// Closes caves at one side of the chunk. `closed` becomes a copy of it once there is something to close.
void closeSide(const world::Chunk& chunk, std::size_t side, const light::ChunkLight& light,
               const world::BlockRegistry& blocks, std::shared_ptr<world::Chunk>& closed) {
    const int border = side % 2 == 0 ? 0 : world::kChunkSize - 1;
    const auto indexOf = [&](int k, int z) {
        return side < 2 ? world::blockIndex(border, k, z) : world::blockIndex(k, border, z);
    };
    std::array<world::BlockId, world::kChunkSize> roofs{};
    const int lowest = std::max(chunk.lowestMade(), chunk.heights().firstSection());
    for (int number = chunk.heights().endSection() - 1; number >= lowest; --number) {
        const world::Section& section = chunk.section(number);
        const light::LightBrick& brick = light.brick(number);
        const bool isSky = section.isUniform() && section.uniformValue() == world::kAir &&
                           brick.isUniform() && light::levelOf(brick.uniformValue(), light::kDaylight) > 0;
        if (isSky) continue;
        const bool isClosed = mesh::isAllOpaque(section, blocks);
        const int bottom = number * world::kSectionSize;
        for (int z = isClosed ? bottom : bottom + world::kSectionSize - 1; z >= bottom; --z) {
            for (int k = 0; k < world::kChunkSize; ++k) {
                world::BlockId& roof = roofs[static_cast<std::size_t>(k)];
                const world::BlockIndex index = indexOf(k, z);
                const world::BlockId block = chunk.block(index);
                const world::BlockType& type = blocks.type(block);
                if (block != world::kAir && type.opaqueCube) {
                    // Crystals in a roof are no columns down to the floor.
                    if (roof == world::kAir || type.emission == std::array<std::uint8_t, 3>{}) roof = block;
                } else if (roof != world::kAir && light::levelOf(light.at(index), light::kDaylight) == 0) {
                    if (!closed) closed = std::make_shared<world::Chunk>(chunk);
                    closed->setBlock(index, roof);
                }
            }
        }
    }
}

}  // namespace

mesh::MeshBlocks closeCaves(const ChunkNeighborhood& around, const light::ChunkLight& light,
                            const world::BlockRegistry& blocks) {
    std::shared_ptr<world::Chunk> closed;
    for (std::size_t side = 0; side < 4; ++side)
        if ((around.openSides >> side & 1) != 0) closeSide(*around.meshed[0], side, light, blocks, closed);
    mesh::MeshBlocks result = around.meshed;
    if (closed) result[0] = std::move(closed);
    return result;
}

MeshPtr meshOf(const mesh::MeshBlocks& chunks, const world::BlockRegistry& blocks,
               const mesh::MeshOptions& options, mesh::MeshSectionSet meshSections) {
    TERRANE_ZONE("mesh chunk");
    thread_local mesh::MeshScratch scratch;
    const mesh::MeshInput input = mesh::meshInput(chunks, blocks, options);
    return std::make_shared<const mesh::ChunkMesh>(mesh::buildMeshSections(input, meshSections, scratch));
}

}  // namespace terrane::stream

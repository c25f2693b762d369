#include "terrane/stream/relight_edits.h"

#include <algorithm>
#include <map>
#include <unordered_map>

#include "terrane/stream/neighborhood.h"

namespace terrane::stream {
namespace {

using world::ChunkPos;

bool isLitAround(const ChunkTable& table, ChunkPos center) {
    const std::array<ChunkPos, 9> around = neighborhood(center);
    return std::ranges::all_of(around, [&](ChunkPos pos) {
        const ChunkRecord* record = findRecord(table, pos);
        return !world::isInWorld(pos) || (record && record->light);
    });
}

struct SortedEdits {
    std::vector<world::BlockEdit> inLit;  // in chunks with light all around
    light::LitChunks lit;                 // those chunks and their neighbors
    std::vector<ChunkPos> unlit;          // edited chunks without light all around
};

SortedEdits sortEdits(const ChunkTable& table, const world::World& world,
                      std::span<const world::BlockEdit> edits) {
    SortedEdits sorted;
    std::unordered_map<ChunkPos, bool, world::ChunkPosHash> isLit;
    for (const world::BlockEdit& edit : edits) {
        const ChunkPos chunk = world::chunkOf(edit.pos);
        const auto [known, isNew] = isLit.try_emplace(chunk, false);
        if (isNew) {
            known->second = isLitAround(table, chunk);
            if (!known->second) sorted.unlit.push_back(chunk);
        }
        if (known->second) sorted.inLit.push_back(edit);
    }
    for (const auto& [chunk, lit] : isLit) {
        if (!lit) continue;
        for (const ChunkPos pos : neighborhood(chunk)) {
            if (world::isInWorld(pos)) {
                sorted.lit[pos] = {world.maybeChunkAt(pos), findRecord(table, pos)->light};
            }
        }
    }
    return sorted;
}

}  // namespace

ChunkNeighborhood neighborhoodOf(const ChunkTable& table, const world::World& world, ChunkPos pos) {
    ChunkNeighborhood around;
    const std::array<ChunkPos, 9> positions = neighborhood(pos);
    for (std::size_t n = 0; n < positions.size(); ++n) {
        around.chunks[n] = world.maybeChunkAt(positions[n]);
        if (const ChunkRecord* record = findRecord(table, positions[n])) {
            around.localLights[n] = record->localLight;
        }
    }
    around.meshed = meshBlocksOf(around.chunks);
    return around;
}

// Light reaches 15 blocks, less than a chunk: an edit changes only light in its chunk's 3×3. Chunks around
// unlit ones are lit from scratch after the others, which replaces light that these got wrong there.
std::vector<light::LightChange> relightEdits(ChunkTable& table, const world::World& world,
                                             std::span<const world::BlockEdit> edits,
                                             const light::LightTable& lights) {
    SortedEdits sorted = sortEdits(table, world, edits);
    std::map<ChunkPos, std::uint16_t> changed;
    thread_local light::LightScratch scratch;
    for (const light::LightChange& change : light::relight(sorted.lit, sorted.inLit, lights, scratch)) {
        findRecord(table, change.pos)->light = sorted.lit.at(change.pos).light;
        changed[change.pos] = change.bricks;
    }
    std::map<ChunkPos, std::uint16_t> fromScratch;
    for (const ChunkPos center : sorted.unlit) {
        for (const ChunkPos pos : neighborhood(center)) {
            if (isAt(table, pos, ChunkStage::Visible)) fromScratch[pos] = kAllBricks;
        }
    }
    for (const auto& [pos, bricks] : fromScratch) {
        findRecord(table, pos)->light = lightOf(neighborhoodOf(table, world, pos), lights);
        changed[pos] = bricks;
    }
    std::vector<light::LightChange> changes;
    for (const auto& [pos, bricks] : changed) changes.push_back({pos, bricks});
    return changes;
}

}  // namespace terrane::stream

#include "terrane/stream/lighting.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <set>
#include <unordered_map>
#include <utility>

#include "terrane/stream/depth.h"

namespace terrane::stream {

namespace {

using world::ChunkPos;

constexpr int kNeighbors = 8;

}  // namespace

void requestLighting(ChunkTable& table, ChunkPos pos) {
    const ChunkRecord* record = findRecord(table, pos);
    if (!record || record->loadedNeighbors != kNeighbors || !isNeeded(table.view, pos)) return;
    table.lightCursor = std::min(table.lightCursor, rankOf(table.view, pos));
}

void requestLightAgain(ChunkTable& table, ChunkPos pos) {
    ChunkRecord* record = findRecord(table, pos);
    assert(record && record->stage == ChunkStage::Visible && "others are lit for the first time");
    if (!std::exchange(record->isToLightAgain, true)) table.toLightAgain.push_back(pos);
}

namespace {

// Begins the lighting of a chunk if all that it needs is there, and requests what is not made deep enough.
bool beginLighting(ChunkTable& table, ChunkPos pos, ChunkRecord& record) {
    if (record.loadedNeighbors != kNeighbors || record.isBeingLit) return false;
    const std::optional<DepthAround> around = depthAround(table, pos);
    if (!around || !requestMissingDepth(table, pos, *around)) return false;
    record.isOutdated = false;
    record.isBeingLit = true;
    record.isToLightAgain = false;
    record.litDepths = around->depths;
    return true;
}

// Whether the neighbors in view have all that they need, too: what they need later would be light for this
// chunk again.
bool areNeighborsDeepEnough(ChunkTable& table, ChunkPos pos) {
    if (!table.nearDepth) return true;
    for (const ChunkPos at : neighborhood(pos)) {
        if (at == pos || !isInView(table.view, at) || !world::isInWorld(at)) continue;
        const std::optional<DepthAround> around = depthAround(table, at);
        if (!around || !requestMissingDepth(table, at, *around)) return false;
    }
    return true;
}

}  // namespace

std::vector<ChunkPos> popLightingRequests(ChunkTable& table, std::size_t limit) {
    std::vector<ChunkPos> popped;
    for (; popped.size() < limit && !table.toLightAgain.empty(); table.toLightAgain.pop_front()) {
        const ChunkPos pos = table.toLightAgain.front();
        ChunkRecord* record = findRecord(table, pos);
        if (!record || !std::exchange(record->isToLightAgain, false)) continue;
        if (record->isBeingLit) {
            record->isOutdated = true;
        } else if (record->stage == ChunkStage::Visible && beginLighting(table, pos, *record)) {
            ++table.lightAgainCount;
            popped.push_back(pos);
        }
    }
    bool isPrefix = true;  // all before this one are Lighting or Visible, or of no interest
    for (std::size_t k = table.lightCursor; k < table.loadCursor && popped.size() < limit; ++k) {
        const ChunkPos pos = table.view.at(k);
        if (isInView(table.view, pos) && world::isInWorld(pos)) {
            ChunkRecord* record = findRecord(table, pos);
            const bool isLoaded =
                record && record->stage == ChunkStage::Loaded && record->loadedNeighbors == kNeighbors;
            if (isLoaded && areNeighborsDeepEnough(table, pos) && beginLighting(table, pos, *record)) {
                setStage(table, pos, *record, ChunkStage::Lighting);
                popped.push_back(pos);
            } else if (!record || record->stage < ChunkStage::Lighting) {
                isPrefix = false;
            }
        }
        if (isPrefix) table.lightCursor = k + 1;
    }
    return popped;
}

bool finishLighting(ChunkTable& table, ChunkPos pos) {
    ChunkRecord* record = findRecord(table, pos);
    assert(record && record->isBeingLit && "what is finished was popped");
    record->isBeingLit = false;
    const bool isGood = !record->isOutdated && isNeeded(table.view, pos);
    if (!isGood) record->litDepths.fill(kNoDepth);
    if (record->stage == ChunkStage::Lighting) {
        setStage(table, pos, *record, isGood ? ChunkStage::Visible : ChunkStage::Loaded);
        if (!isGood) requestLighting(table, pos);
        return isGood;
    }
    --table.lightAgainCount;
    if (record->stage == ChunkStage::Visible) {
        if (!isGood) requestLightAgain(table, pos);
        return isGood;
    }
    requestLighting(table, pos);  // it was hidden meanwhile
    return false;
}

void invalidateLighting(ChunkTable& table, ChunkPos pos) {
    for (const ChunkPos at : neighborhood(pos)) {
        if (ChunkRecord* record = findRecord(table, at)) record->isOutdated = true;
    }
}

namespace {

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
    std::map<ChunkPos, world::SectionSet> changed;
    thread_local light::LightScratch scratch;
    for (const light::LightChange& change : light::relight(sorted.lit, sorted.inLit, lights, scratch)) {
        findRecord(table, change.pos)->light = sorted.lit.at(change.pos).light;
        changed[change.pos] = change.bricks;
    }
    std::set<ChunkPos> fromScratch;
    for (const ChunkPos center : sorted.unlit) {
        for (const ChunkPos pos : neighborhood(center)) {
            if (isAt(table, pos, ChunkStage::Visible)) fromScratch.insert(pos);
        }
    }
    for (const ChunkPos pos : fromScratch) {
        findRecord(table, pos)->light = lightOf(neighborhoodOf(table, world, pos), lights);
        changed[pos] = world::SectionSet::all(world.heights());
    }
    std::vector<light::LightChange> changes;
    for (const auto& [pos, bricks] : changed) changes.push_back({pos, bricks});
    return changes;
}

}  // namespace terrane::stream

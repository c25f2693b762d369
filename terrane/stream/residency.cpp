#include "terrane/stream/residency.h"

#include <algorithm>
#include <cassert>

#include "terrane/stream/depth.h"
#include "terrane/stream/lighting.h"

namespace terrane::stream {
namespace {

using world::ChunkPos;

std::uint8_t countLoadedAround(const ChunkTable& table, ChunkPos pos) {
    int count = 0;
    for (const ChunkPos at : neighborhood(pos)) {
        if (at == pos) continue;
        const ChunkRecord* record = findRecord(table, at);
        const bool isLoaded = record && record->stage != ChunkStage::Loading;
        count += isLoaded || !world::isInWorld(at) ? 1 : 0;
    }
    return static_cast<std::uint8_t>(count);
}

void changeLoadedAround(ChunkTable& table, ChunkPos pos, int change) {
    for (const ChunkPos at : neighborhood(pos)) {
        ChunkRecord* record = at == pos ? nullptr : findRecord(table, at);
        if (record) record->loadedNeighbors = static_cast<std::uint8_t>(record->loadedNeighbors + change);
    }
}

// Takes the visible chunks for which `isPopped` is true and makes them Loaded.
template <class IsPopped>
std::vector<ChunkPos> popVisibleWhere(ChunkTable& table, const IsPopped& isPopped) {
    std::vector<ChunkPos> popped;
    for (auto& [pos, record] : table.records) {
        if (record.stage != ChunkStage::Visible || !isPopped(pos)) continue;
        setStage(table, pos, record, ChunkStage::Loaded);
        record.light = nullptr;
        record.toMesh = {};
        record.meshJob = 0;
        popped.push_back(pos);
    }
    return popped;
}

}  // namespace

bool setView(ChunkTable& table, ChunkPos center, int distance, glm::vec2 direction) {
    ViewOrder& view = table.view;
    if (center == view.center && distance == view.distance && direction == view.direction) return false;
    moveView(view, center, distance, direction);
    table.loadCursor = table.lightCursor = 0;
    table.chunksInView = table.visibleInView = 0;
    for (std::size_t k = 0; k < view.size(); ++k) {
        const ChunkPos pos = view.at(k);
        if (!isInView(view, pos) || !world::isInWorld(pos)) continue;
        ++table.chunksInView;
        if (isAt(table, pos, ChunkStage::Visible)) ++table.visibleInView;
    }
    updateDepthNearCamera(table);
    return true;
}

void requestChunk(ChunkTable& table, ChunkPos pos, Time now) {
    assert(world::isInWorld(pos) && "only chunks of the world can be requested");
    if (ChunkRecord* record = findRecord(table, pos)) {
        record->neededAt = now;
        record->isRequested = true;
        requestDepth(table, pos, table.heights.firstSection());
    } else if (table.requested.insert(pos).second) {
        table.requests.push_back(pos);
    }
}

std::vector<ChunkPos> popLoadRequests(ChunkTable& table, std::size_t limit) {
    std::vector<ChunkPos> popped;
    const auto pop = [&](ChunkPos pos, bool isRequested) {
        if (!world::isInWorld(pos) || findRecord(table, pos)) return;
        ChunkRecord& record = addRecord(table, pos);
        record.isRequested = isRequested;
        record.loadedNeighbors = countLoadedAround(table, pos);
        popped.push_back(pos);
    };
    for (; popped.size() < limit && !table.requests.empty(); table.requests.pop_front()) {
        table.requested.erase(table.requests.front());
        pop(table.requests.front(), true);
    }
    for (; popped.size() < limit && table.loadCursor < table.view.size(); ++table.loadCursor) {
        pop(table.view.at(table.loadCursor), false);
    }
    return popped;
}

bool mayCancelLoad(const ChunkTable& table, ChunkPos pos) {
    const ChunkRecord* record = findRecord(table, pos);
    return record && record->stage == ChunkStage::Loading && !record->isRequested &&
           !isNeeded(table.view, pos);
}

void finishLoad(ChunkTable& table, ChunkPos pos, Time now, LoadedDepths depths) {
    ChunkRecord* record = findRecord(table, pos);
    assert(record && record->stage == ChunkStage::Loading && "what arrives was asked for");
    record->neededAt = now;
    record->lowestMade = depths.lowestMade;
    record->lowestOpen = depths.lowestOpen;
    setStage(table, pos, *record, ChunkStage::Loaded);
    changeLoadedAround(table, pos, 1);
    updateDepthAround(table, pos);
    if (record->isRequested) requestDepth(table, pos, table.heights.firstSection());
}

void abandonLoad(ChunkTable& table, ChunkPos pos) {
    assert(isAt(table, pos, ChunkStage::Loading) && "what ends was asked for");
    eraseRecord(table, pos);
    if (isNeeded(table.view, pos)) table.loadCursor = std::min(table.loadCursor, rankOf(table.view, pos));
}

std::vector<ChunkPos> popVisible(ChunkTable& table) {
    std::vector<ChunkPos> popped = popVisibleWhere(table, [](ChunkPos) { return true; });
    for (const ChunkPos pos : popped) requestLighting(table, pos);
    return popped;
}

std::vector<ChunkPos> popHidden(ChunkTable& table) {
    return popVisibleWhere(table, [&](ChunkPos pos) { return !isNeeded(table.view, pos); });
}

std::vector<ChunkPos> findUnneeded(ChunkTable& table, Time now) {
    std::vector<ChunkPos> unneeded;
    for (auto& [pos, record] : table.records) {
        if (isNeeded(table.view, pos)) record.neededAt = now;
        if (record.stage == ChunkStage::Loaded && !record.isBeingLit &&
            now - record.neededAt >= kUnloadDelay) {
            unneeded.push_back(pos);
        }
    }
    return unneeded;
}

void unload(ChunkTable& table, ChunkPos pos) {
    assert(isAt(table, pos, ChunkStage::Loaded) && "only loaded chunks without work are unloaded");
    eraseRecord(table, pos);
    changeLoadedAround(table, pos, -1);
}

}  // namespace terrane::stream

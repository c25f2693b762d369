#include "terrane/stream/lighting.h"

#include <algorithm>
#include <cassert>

#include "terrane/stream/neighborhood.h"

namespace terrane::stream {
namespace {

using world::ChunkPos;

constexpr int kNeighbors = 8;

}  // namespace

void considerLighting(ChunkTable& table, ChunkPos pos) {
    const ChunkRecord* record = findRecord(table, pos);
    if (!record || record->loadedAround != kNeighbors || !isNeeded(table.view, pos)) return;
    table.lightCursor = std::min(table.lightCursor, rankOf(table.view, pos));
}

std::vector<ChunkPos> popLightingRequests(ChunkTable& table, std::size_t limit) {
    std::vector<ChunkPos> popped;
    bool isPrefix = true;  // all before this one are Lighting or Visible, or of no interest
    for (std::size_t k = table.lightCursor; k < table.loadCursor && popped.size() < limit; ++k) {
        const ChunkPos pos = table.view.at(k);
        if (isInView(table.view, pos) && world::isInWorld(pos)) {
            ChunkRecord* record = findRecord(table, pos);
            const bool isReady =
                record && record->stage == ChunkStage::Loaded && record->loadedAround == kNeighbors;
            if (isReady) {
                record->isOutdated = false;
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
    assert(record && record->stage == ChunkStage::Lighting && "what is finished was popped");
    const bool isGood = !record->isOutdated && isNeeded(table.view, pos);
    setStage(table, pos, *record, isGood ? ChunkStage::Visible : ChunkStage::Loaded);
    if (!isGood) considerLighting(table, pos);
    return isGood;
}

void outdateLighting(ChunkTable& table, ChunkPos pos) {
    for (const ChunkPos at : neighborhood(pos)) {
        if (ChunkRecord* record = findRecord(table, at)) record->isOutdated = true;
    }
}

}  // namespace terrane::stream

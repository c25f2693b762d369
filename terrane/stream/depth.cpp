#include "terrane/stream/depth.h"

#include <algorithm>
#include <cassert>
#include <utility>

#include "terrane/stream/lighting.h"

namespace terrane::stream {
namespace {

using world::ChunkPos;

bool isLoaded(const ChunkRecord* record) {
    return record && record->stage != ChunkStage::Loading;
}

// The section that the camera needs, whatever the blocks are; above the world if it needs none.
int depthByCamera(const ChunkTable& table, ChunkPos pos) {
    if (!table.nearDepth) return table.heights.firstSection();
    const bool isNear = world::chunkDistance(pos, table.view.center) <= kNearChunks;
    return isNear ? *table.nearDepth : table.heights.endSection();
}

int depthByOpenings(const ChunkRecord& record) {
    return record.lowestOpen - kClosedSections;
}

void updateDepth(ChunkTable& table, ChunkPos pos) {
    const ChunkRecord* record = findRecord(table, pos);
    if (!record || record->stage != ChunkStage::Visible) return requestLighting(table, pos);
    const std::optional<DepthAround> around = depthAround(table, pos);
    if (!around || !requestMissingDepth(table, pos, *around)) return;
    if (around->depths != record->litDepths) requestLightAgain(table, pos);
}

}  // namespace

void setCameraHeight(ChunkTable& table, std::optional<int> z) {
    std::optional<int> depth;
    if (z) {
        const int lowest = (*z - kNearBlocks) & ~(kNearStep - 1);
        depth = std::clamp(lowest / world::kSectionSize, table.heights.firstSection(),
                           table.heights.endSection());
    }
    if (depth == table.nearDepth) return;
    table.nearDepth = depth;
    if (depth) return updateDepthNearCamera(table);
    for (auto& [pos, record] : table.records) updateDepth(table, pos);
}

std::optional<DepthAround> depthAround(const ChunkTable& table, ChunkPos pos) {
    DepthAround around{depthByCamera(table, pos), table.heights.firstSection()};
    around.depths.fill(kNoDepth);
    const std::array<ChunkPos, 9> positions = neighborhood(pos);
    for (std::size_t n = 0; n < positions.size(); ++n) {
        const ChunkPos at = positions[n];
        if (!world::isInWorld(at)) continue;
        const ChunkRecord* record = findRecord(table, at);
        if (!isLoaded(record)) return std::nullopt;
        around.needed = std::min(around.needed, depthByOpenings(*record));
        around.highest = std::max(around.highest, record->lowestMade);
        around.depths[n] = static_cast<std::int16_t>(record->lowestMade);
    }
    around.needed = std::max(around.needed, table.heights.firstSection());
    return around;
}

int depthToLoad(const ChunkTable& table, ChunkPos pos) {
    int section = depthByCamera(table, pos);
    for (const ChunkPos at : neighborhood(pos)) {
        const ChunkRecord* record = findRecord(table, at);
        if (isLoaded(record)) section = std::min(section, depthByOpenings(*record));
    }
    return std::max(section, table.heights.firstSection());
}

void requestDepth(ChunkTable& table, ChunkPos pos, int section) {
    ChunkRecord* record = findRecord(table, pos);
    if (!isLoaded(record) || section >= std::min(record->lowestMade, record->wantedDepth)) return;
    record->wantedDepth = section;
    table.toDeepen.push_back(pos);
}

bool requestMissingDepth(ChunkTable& table, ChunkPos pos, const DepthAround& around) {
    if (around.isDeepEnough()) return true;
    for (const ChunkPos at : neighborhood(pos)) requestDepth(table, at, around.needed);
    return false;
}

void updateDepthAround(ChunkTable& table, ChunkPos pos) {
    for (const ChunkPos at : neighborhood(pos)) updateDepth(table, at);
}

void updateDepthNearCamera(ChunkTable& table) {
    if (!table.nearDepth) return;
    for (int dy = -kNearChunks; dy <= kNearChunks; ++dy)
        for (int dx = -kNearChunks; dx <= kNearChunks; ++dx)
            updateDepth(table, world::offsetBy(table.view.center, dx, dy));
}

std::size_t pendingLoads(const ChunkTable& table) {
    if (!table.nearDepth) return 0;
    return countOf(table, ChunkStage::Loading) + table.view.size() - table.loadCursor;
}

int lowestNeeded(const ChunkTable& table) {
    if (!table.nearDepth) return table.heights.firstSection();
    int lowest = *table.nearDepth;
    for (const auto& [pos, record] : table.records)
        if (isLoaded(&record) && isNeeded(table.view, pos))
            lowest = std::min(lowest, depthByOpenings(record));
    return std::max(lowest, table.heights.firstSection());
}

namespace {

// The section that the chunks of the 3×3 in view need of a chunk; nothing while one of them is not known to
// need it yet.
std::optional<int> depthForAll(const ChunkTable& table, ChunkPos pos, const ChunkRecord& record) {
    int section = record.wantedDepth;
    for (const ChunkPos at : neighborhood(pos)) {
        if (section == table.heights.firstSection()) break;
        if (!isInView(table.view, at) || !world::isInWorld(at)) continue;
        const std::optional<DepthAround> around = depthAround(table, at);
        if (!around) return std::nullopt;
        section = std::min(section, around->needed);
    }
    return section;
}

}  // namespace

std::vector<DepthJob> popDepthJobs(ChunkTable& table, std::size_t limit) {
    std::vector<DepthJob> popped;
    std::deque<ChunkPos> waiting;
    for (; popped.size() < limit && !table.toDeepen.empty(); table.toDeepen.pop_front()) {
        const ChunkPos pos = table.toDeepen.front();
        ChunkRecord* record = findRecord(table, pos);
        const bool isWanted = isLoaded(record) && record->wantedDepth < record->lowestMade;
        if (!isWanted || record->isDeepening) continue;
        // Once for all that need it, rather than step by step.
        const std::optional<int> section = depthForAll(table, pos, *record);
        if (!section) {
            waiting.push_back(pos);
            continue;
        }
        record->wantedDepth = *section;
        record->isDeepening = true;
        popped.push_back({pos, *section});
    }
    table.toDeepen.insert(table.toDeepen.end(), waiting.begin(), waiting.end());
    table.depthJobCount += popped.size();
    return popped;
}

bool finishDepthJob(ChunkTable& table, ChunkPos pos, LoadedDepths depths) {
    assert(table.depthJobCount > 0 && "what is finished was popped");
    --table.depthJobCount;
    ChunkRecord* record = findRecord(table, pos);
    if (!isLoaded(record)) return false;
    record->isDeepening = false;
    record->lowestMade = std::min(record->lowestMade, depths.lowestMade);
    record->lowestOpen = std::min(record->lowestOpen, depths.lowestOpen);
    if (record->wantedDepth < record->lowestMade) table.toDeepen.push_back(pos);
    return true;
}

}  // namespace terrane::stream

#include "terrane/stream/chunk_table.h"

#include <cassert>

namespace terrane::stream {

using world::ChunkPos;

ChunkRecord* findRecord(ChunkTable& table, ChunkPos pos) {
    const auto found = table.records.find(pos);
    return found != table.records.end() ? &found->second : nullptr;
}

const ChunkRecord* findRecord(const ChunkTable& table, ChunkPos pos) {
    const auto found = table.records.find(pos);
    return found != table.records.end() ? &found->second : nullptr;
}

std::optional<ChunkStage> stageAt(const ChunkTable& table, ChunkPos pos) {
    const ChunkRecord* record = findRecord(table, pos);
    return record ? std::optional(record->stage) : std::nullopt;
}

bool isAt(const ChunkTable& table, ChunkPos pos, ChunkStage stage) {
    const ChunkRecord* record = findRecord(table, pos);
    return record && record->stage == stage;
}

std::size_t countOf(const ChunkTable& table, ChunkStage stage) {
    return table.stageCounts[static_cast<std::size_t>(stage)];
}

ChunkRecord& addRecord(ChunkTable& table, ChunkPos pos) {
    const auto [it, isNew] = table.records.try_emplace(pos);
    assert(isNew && "only absent chunks are added");
    ++table.stageCounts[static_cast<std::size_t>(ChunkStage::Loading)];
    return it->second;
}

void eraseRecord(ChunkTable& table, ChunkPos pos) {
    const auto found = table.records.find(pos);
    assert(found != table.records.end() && found->second.stage != ChunkStage::Visible &&
           "visible chunks are hidden before they are unloaded");
    --table.stageCounts[static_cast<std::size_t>(found->second.stage)];
    table.records.erase(found);
}

void setStage(ChunkTable& table, ChunkPos pos, ChunkRecord& record, ChunkStage stage) {
    const auto count = [&](std::ptrdiff_t change) {
        table.stageCounts[static_cast<std::size_t>(record.stage)] += static_cast<std::size_t>(change);
        if (record.stage == ChunkStage::Visible && isInView(table.view, pos)) {
            table.visibleInView += static_cast<std::size_t>(change);
        }
    };
    count(-1);
    record.stage = stage;
    count(1);
}

}  // namespace terrane::stream

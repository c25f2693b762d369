#include "terrane/store/rows_reader.h"

#include "terrane/base/log.h"
#include "terrane/base/profile.h"

namespace terrane::store {

LoadedChunk RowsReader::decode(const StoredRow& row, world::ChunkPos pos) {
    LoadedChunk loaded = decodeRow(row, rows_->ids(), budget_);
    if (loaded.state != LoadedChunk::State::Damaged) return loaded;
    loaded.problem = fmt::format("{}: {}: {}", rows_->name(), nameOf(pos), loaded.problem);
    if (!loaded.isOverBudget || budget_.isFirstRefusal()) base::logWarning("{}", loaded.problem);
    return loaded;
}

LoadedChunk RowsReader::load(world::ChunkPos pos) {
    TERRANE_ZONE("load chunk");
    return decode(rows_->read(pos), pos);
}

std::vector<LoadedChunk> RowsReader::loadMany(std::span<const world::ChunkPos> positions) {
    TERRANE_ZONE("load chunks");
    std::vector<LoadedChunk> loaded(positions.size());
    rows_->readMany(positions,
                    [&](std::size_t k, const StoredRow& row) { loaded[k] = decode(row, positions[k]); });
    return loaded;
}

bool RowsReader::contains(world::ChunkPos pos) {
    const auto found = rows_->contains(pos);
    return found && *found;
}

std::optional<std::string> RowsReader::metadata(std::string_view name) {
    const auto found = rows_->metadata().find(name);
    if (found == rows_->metadata().end()) return std::nullopt;
    return found->second;
}

}  // namespace terrane::store

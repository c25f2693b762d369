#include "terrane/store/sqlite_reader.h"

#include <utility>

#include "terrane/base/log.h"
#include "terrane/base/profile.h"

namespace terrane::store {

base::Result<std::unique_ptr<SqliteReader>> SqliteReader::open(const std::filesystem::path& path,
                                                               const world::BlockRegistry& registry,
                                                               const SaveLimits& limits) {
    auto file = openToRead(path, registry);
    if (!file) return tl::unexpected(file.error());
    if (auto ended = file->database.execute("COMMIT"); !ended) return tl::unexpected(ended.error());
    if (!file->inUse.empty())
        base::logInfo("{}: {}; read as it is saved, and left as it is", file->database.path(), file->inUse);
    return std::unique_ptr<SqliteReader>(new SqliteReader(std::move(*file), limits));
}

SqliteReader::SqliteReader(SaveFile file, const SaveLimits& limits)
    : file_(std::move(file)),
      budget_(limits.entityBytes),
      reader_(file_.database.path(), file_.readers, file_.format) {}

LoadedChunk SqliteReader::decode(const StoredRow& row, world::ChunkPos pos) {
    LoadedChunk loaded = decodeRow(row, file_.ids, budget_);
    if (loaded.state != LoadedChunk::State::Damaged) return loaded;
    loaded.problem = fmt::format("{}: {}: {}", file_.database.path(), nameOf(pos), loaded.problem);
    if (!loaded.isOverBudget || budget_.isFirstRefusal()) base::logWarning("{}", loaded.problem);
    return loaded;
}

LoadedChunk SqliteReader::load(world::ChunkPos pos) {
    TERRANE_ZONE("load chunk");
    return decode(reader_.read(pos), pos);
}

std::vector<LoadedChunk> SqliteReader::loadMany(std::span<const world::ChunkPos> positions) {
    TERRANE_ZONE("load chunks");
    std::vector<LoadedChunk> loaded(positions.size());
    reader_.readMany(positions,
                     [&](std::size_t k, const StoredRow& row) { loaded[k] = decode(row, positions[k]); });
    return loaded;
}

bool SqliteReader::contains(world::ChunkPos pos) {
    const auto found = reader_.contains(pos);
    return found && *found;
}

std::optional<std::string> SqliteReader::metadata(std::string_view name) {
    const auto found = file_.metadata.find(name);
    if (found == file_.metadata.end()) return std::nullopt;
    return found->second;
}

}  // namespace terrane::store

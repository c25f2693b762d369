#include "terrane/store/sqlite_store.h"

#include <utility>

#include "terrane/base/log.h"
#include "terrane/base/profile.h"

namespace terrane::store {

base::Result<std::unique_ptr<SqliteStore>> SqliteStore::open(const std::filesystem::path& path,
                                                             const world::BlockRegistry& registry,
                                                             const SaveAccess& access, SaveLimits limits) {
    auto file = openToWrite(path, registry, access);
    if (!file) return tl::unexpected(file.error());
    std::unique_ptr<SqliteStore> store(new SqliteStore(std::move(*file), limits));
    auto writer = SqliteWriter::make(store->file_, store->budget_);
    if (!writer) return tl::unexpected(writer.error());
    store->writer_ = std::move(*writer);
    store->queue_ = std::make_unique<SaveQueue>(
        [self = store.get()](const SaveBatch& batch) { return self->write(batch); }, limits);
    return store;
}

SqliteStore::SqliteStore(SaveFile file, const SaveLimits& limits)
    : file_(std::move(file)),
      budget_(limits.entityBytes),
      reader_(file_.database.path(), file_.readers, file_.format),
      metadata_(file_.metadata) {}

SqliteStore::~SqliteStore() = default;

namespace {

LoadedChunk copyOf(const WaitingChunk& waiting) {
    LoadedChunk loaded;
    loaded.state = LoadedChunk::State::Present;
    loaded.chunk = std::make_shared<world::Chunk>(*waiting.chunk);
    loaded.provenance = waiting.provenance;
    return loaded;
}

}  // namespace

void SqliteStore::setUnread(world::ChunkPos pos, bool isUnread) {
    const std::lock_guard lock(unreadMutex_);
    if (isUnread) {
        unread_.insert(pos);
    } else if (!unread_.empty()) {
        unread_.erase(pos);
    }
}

bool SqliteStore::isUnread(world::ChunkPos pos) {
    const std::lock_guard lock(unreadMutex_);
    return unread_.contains(pos);
}

ChunkPosSet SqliteStore::unreadOf(const SaveBatch& batch) {
    const std::lock_guard lock(unreadMutex_);
    ChunkPosSet found;
    for (const world::ChunkPos pos : unread_)
        if (batch.chunks.contains(pos)) found.insert(pos);
    return found;
}

LoadedChunk SqliteStore::loadStored(const StoredRow& row, world::ChunkPos pos) {
    LoadedChunk loaded = decodeRow(row, file_.ids, budget_);
    setUnread(pos, loaded.isUnread);
    if (loaded.state != LoadedChunk::State::Damaged) return loaded;
    const std::string reason = std::exchange(
        loaded.problem, fmt::format("{}: {}: {}", file_.database.path(), nameOf(pos), loaded.problem));
    if (loaded.isUnread) {
        if (!loaded.isOverBudget || budget_.isFirstRefusal())
            base::logWarning("{}; what it has stays", loaded.problem);
    } else {
        base::logWarning("{}; what it had is kept in the table quarantine", loaded.problem);
        queue_->add(DamagedRow{pos, hashOfRow((*row)->data), reason});
    }
    return loaded;
}

LoadedChunk SqliteStore::load(world::ChunkPos pos) {
    TERRANE_ZONE("load chunk");
    if (const auto waiting = queue_->find(pos)) return copyOf(*waiting);
    return loadStored(reader_.read(pos), pos);
}

// The queue first: what is no longer in it is in the file, and in the transaction that reads it.
std::vector<LoadedChunk> SqliteStore::loadMany(std::span<const world::ChunkPos> positions) {
    TERRANE_ZONE("load chunks");
    const auto waiting = queue_->findMany(positions);
    std::vector<world::ChunkPos> stored;
    for (std::size_t k = 0; k < positions.size(); ++k)
        if (!waiting[k]) stored.push_back(positions[k]);
    std::vector<LoadedChunk> read(stored.size());
    reader_.readMany(stored,
                     [&](std::size_t k, const StoredRow& row) { read[k] = loadStored(row, stored[k]); });
    auto next = read.begin();
    std::vector<LoadedChunk> loaded;
    loaded.reserve(positions.size());
    for (std::size_t k = 0; k < positions.size(); ++k)
        loaded.push_back(waiting[k] ? copyOf(*waiting[k]) : std::move(*next++));
    return loaded;
}

bool SqliteStore::contains(world::ChunkPos pos) {
    if (queue_->find(pos)) return true;
    const auto found = reader_.contains(pos);
    return found && *found;
}

SaveNumber SqliteStore::save(world::ChunkPos pos, world::ChunkPtr chunk, Provenance provenance) {
    if (provenance == Provenance::Generated && isUnread(pos)) return queue_->status().queued;
    return queue_->add(pos, {std::move(chunk), provenance});
}

std::optional<std::string> SqliteStore::metadata(std::string_view name) {
    const std::lock_guard lock(metadataMutex_);
    const auto found = metadata_.find(name);
    if (found == metadata_.end()) return std::nullopt;
    return found->second;
}

SaveNumber SqliteStore::setMetadata(std::string_view name, std::string value) {
    if (isReserved(name)) {
        base::logError("{}: {} is written by the store alone and stays as it is", file_.database.path(),
                       name);
        return queue_->status().queued;
    }
    const std::lock_guard lock(metadataMutex_);
    if (!fitsMetadata(metadata_, name, value)) {
        base::logError("{}: the setting {} of {} bytes is more than a save keeps, and is not saved",
                       file_.database.path(), name.substr(0, 64), value.size());
        return queue_->status().queued;
    }
    metadata_.insert_or_assign(std::string(name), value);
    return queue_->add(std::string(name), std::move(value));
}

void SqliteStore::setDerivedRows(DerivedRows rows) {
    const std::lock_guard writing(writeMutex_);
    derivedRows_ = std::move(rows);
}

// Rows are derived before the transaction begins, and read what is in the file by other connections.
base::Result<void> SqliteStore::write(const SaveBatch& batch) {
    const std::lock_guard writing(writeMutex_);
    const std::vector<ChunkRow> edited = batch.editedChunks();
    SavedRows saved([this](world::ChunkPos pos) { return reader_.read(pos); }, file_.ids, budget_);
    std::vector<ChunkRow> derived;
    if (!edited.empty() && derivedRows_.derive) derived = derivedRows_.derive(edited, saved.reader());
    if (!saved.result()) return saved.result();
    const bool isComplete = edited.empty() || (derivedRows_.derive && !saved.metDamage());
    const ChunkPosSet unread = unreadOf(batch);
    const auto written = writer_->write(batch, unread, derived, isComplete);
    if (!written) return tl::unexpected(written.error());
    for (const world::ChunkPos pos : unread) setUnread(pos, false);
    if (!*written) {
        const std::lock_guard lock(metadataMutex_);
        if (const auto mark = metadata_.find(kDerivedRowsMark); mark != metadata_.end())
            metadata_.erase(mark);
    }
    if (derivedRows_.written && !derived.empty()) derivedRows_.written(derived);
    return {};
}

base::Result<void> SqliteStore::deriveAll(std::string_view rules) {
    const std::lock_guard writing(writeMutex_);
    if (auto done = writer_->deriveAll(derivedRows_, rules); !done) return done;
    const std::lock_guard lock(metadataMutex_);
    metadata_.insert_or_assign(std::string(kDerivedRowsMark), std::string(rules));
    return {};
}

}  // namespace terrane::store

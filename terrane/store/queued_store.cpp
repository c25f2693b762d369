#include "terrane/store/queued_store.h"

#include <cassert>
#include <utility>

#include "terrane/base/log.h"
#include "terrane/base/profile.h"

namespace terrane::store {

void RowMessages::tell() {
    for (const Message& message : messages_) {
        if (message.level == base::LogLevel::Warning)
            base::logWarning("{}", message.text);
        else
            base::logError("{}", message.text);
    }
    messages_.clear();
}

world::ChunkPtr SavedRows::editedChunk(world::ChunkPos pos) {
    const StoredRow row = read_(pos);
    if (row && (!*row || (*row)->provenance != Provenance::Edited)) return nullptr;
    LoadedChunk loaded = decodeRow(row, ids_, heights_, budget_);
    if (loaded.state == LoadedChunk::State::Damaged) foundDamage_ = true;
    if (result_ && !row && row.error().code != base::ErrorCode::Damaged)
        result_ = tl::unexpected(row.error());
    return std::move(loaded.chunk);
}

QueuedStore::QueuedStore(std::unique_ptr<ChunkRows> rows, const SaveLimits& limits)
    : rows_(std::move(rows)), budget_(limits.entityBytes), metadata_(rows_->metadata()) {
    queue_ = std::make_unique<SaveQueue>([this](const SaveBatch& batch) { return write(batch); }, limits);
}

namespace {

LoadedChunk copyOf(const QueuedChunk& waiting) {
    return loadedCopy(waiting.chunk, waiting.provenance);
}

bool isEdited(const std::optional<QueuedChunk>& waiting) {
    return waiting && waiting->provenance == Provenance::Edited;
}

// Whether the queued chunk replaces the stored one: a generated chunk never replaces an edited one.
bool hides(const std::optional<QueuedChunk>& waiting, const LoadedChunk& stored) {
    const bool isEditedRow =
        stored.state == LoadedChunk::State::Present && stored.provenance == Provenance::Edited;
    return waiting && !isEditedRow;
}

}  // namespace

void QueuedStore::setUnread(world::ChunkPos pos, bool isUnreadable) {
    const std::lock_guard lock(unreadMutex_);
    if (isUnreadable) {
        unread_.insert(pos);
    } else if (!unread_.empty()) {
        unread_.erase(pos);
    }
}

bool QueuedStore::isUnreadable(world::ChunkPos pos) {
    const std::lock_guard lock(unreadMutex_);
    return unread_.contains(pos);
}

ChunkPosSet QueuedStore::unreadOf(const SaveBatch& batch) {
    const std::lock_guard lock(unreadMutex_);
    ChunkPosSet found;
    for (const world::ChunkPos pos : unread_)
        if (batch.chunks.contains(pos)) found.insert(pos);
    return found;
}

LoadedChunk QueuedStore::loadStored(const StoredRow& row, world::ChunkPos pos) {
    LoadedChunk loaded = decodeRow(row, rows_->ids(), rows_->identity().heights, budget_);
    setUnread(pos, loaded.isUnreadable);
    if (loaded.state != LoadedChunk::State::Damaged) return loaded;
    const std::string reason =
        std::exchange(loaded.problem, fmt::format("{}: {}: {}", rows_->name(), nameOf(pos), loaded.problem));
    if (loaded.isUnreadable) {
        if (!loaded.isOverBudget || budget_.isFirstRefusal())
            base::logWarning("{}; its saved data stays", loaded.problem);
    } else {
        base::logWarning("{}; its old data is kept in the table quarantine", loaded.problem);
        queue_->add(DamagedRow{pos, hashOfRow((*row)->data), reason});
    }
    return loaded;
}

LoadedChunk QueuedStore::load(world::ChunkPos pos) {
    TERRANE_ZONE("load chunk");
    const auto waiting = queue_->find(pos);
    if (isEdited(waiting)) return copyOf(*waiting);
    LoadedChunk stored = loadStored(rows_->read(pos), pos);
    return hides(waiting, stored) ? copyOf(*waiting) : std::move(stored);
}

// Looks in the queue first: chunks that have left it are in the file, and visible to the transaction that
// reads it.
std::vector<LoadedChunk> QueuedStore::loadMany(std::span<const world::ChunkPos> positions) {
    TERRANE_ZONE("load chunks");
    const auto waiting = queue_->findMany(positions);
    std::vector<world::ChunkPos> stored;
    for (std::size_t k = 0; k < positions.size(); ++k)
        if (!isEdited(waiting[k])) stored.push_back(positions[k]);
    std::vector<LoadedChunk> read(stored.size());
    rows_->readMany(stored,
                    [&](std::size_t k, const StoredRow& row) { read[k] = loadStored(row, stored[k]); });
    auto next = read.begin();
    std::vector<LoadedChunk> loaded;
    loaded.reserve(positions.size());
    for (const auto& saved : waiting) {
        if (isEdited(saved)) {
            loaded.push_back(copyOf(*saved));
            continue;
        }
        loaded.push_back(hides(saved, *next) ? copyOf(*saved) : std::move(*next));
        ++next;
    }
    return loaded;
}

bool QueuedStore::contains(world::ChunkPos pos) {
    if (queue_->find(pos)) return true;
    const auto found = rows_->contains(pos);
    return found && *found;
}

SaveNumber QueuedStore::save(world::ChunkPos pos, world::ChunkPtr chunk, Provenance provenance) {
    assert(chunk->heights() == identity().heights && "a chunk of this world");
    if (provenance == Provenance::Generated && isUnreadable(pos)) return queue_->status().queued;
    return queue_->add(pos, {std::move(chunk), provenance, version_});
}

std::optional<std::string> QueuedStore::metadata(std::string_view name) {
    const std::lock_guard lock(metadataMutex_);
    const auto found = metadata_.find(name);
    if (found == metadata_.end()) return std::nullopt;
    return found->second;
}

SaveNumber QueuedStore::setMetadata(std::string_view name, std::string value) {
    if (isReserved(name)) {
        base::logError("{}: only the store writes {}; it stays unchanged", rows_->name(), name);
        return queue_->status().queued;
    }
    const std::lock_guard lock(metadataMutex_);
    if (!fitsMetadata(metadata_, name, value)) {
        base::logError("{}: the setting {} has {} bytes, too many for a save, and is not saved",
                       rows_->name(), name.substr(0, 64), value.size());
        return queue_->status().queued;
    }
    metadata_.insert_or_assign(std::string(name), value);
    return queue_->add(std::string(name), std::move(value));
}

void QueuedStore::setDerivedRows(DerivedRows rows) {
    const std::lock_guard writing(writeMutex_);
    derivedRows_ = std::move(rows);
}

base::Result<DerivedBatch> QueuedStore::derive(const std::vector<ChunkRow>& edited, const ReadRow& read) {
    SavedRows saved(read, rows_->ids(), rows_->identity().heights, budget_);
    DerivedBatch derived;
    if (!edited.empty() && derivedRows_.derive) derived.rows = derivedRows_.derive(edited, saved.reader());
    if (!saved.result()) return tl::unexpected(saved.result().error());
    derived.isComplete = edited.empty() || (derivedRows_.derive && !saved.foundDamage());
    return derived;
}

DeriveBatch QueuedStore::deriver() {
    return [this](const std::vector<ChunkRow>& edited, const ReadRow& read) {
        const std::lock_guard writing(writeMutex_);
        return derive(edited, read);
    };
}

base::Result<void> QueuedStore::write(const SaveBatch& batch) {
    const std::lock_guard writing(writeMutex_);
    std::vector<ChunkRow> derivedRows;
    const auto deriveBatch = [&](const std::vector<ChunkRow>& edited, const ReadRow& read) {
        auto derived = derive(edited, read);
        if (derived) derivedRows = derived->rows;
        return derived;
    };
    const ChunkPosSet unread = unreadOf(batch);
    const auto written = rows_->write(batch, unread, deriveBatch);
    if (!written) return tl::unexpected(written.error());
    for (const world::ChunkPos pos : unread) setUnread(pos, false);
    if (!*written) {
        const std::lock_guard lock(metadataMutex_);
        if (const auto mark = metadata_.find(kDerivedRowsMark); mark != metadata_.end())
            metadata_.erase(mark);
    }
    if (derivedRows_.written && !derivedRows.empty()) derivedRows_.written(derivedRows);
    return {};
}

base::Result<void> QueuedStore::deriveAll(std::string_view rules) {
    const std::lock_guard writing(writeMutex_);
    TERRANE_TRY(rows_->deriveAll(derivedRows_, rules, budget_));
    const std::lock_guard lock(metadataMutex_);
    metadata_.insert_or_assign(std::string(kDerivedRowsMark), std::string(rules));
    return {};
}

LoadedChunk RowsReader::decode(const StoredRow& row, world::ChunkPos pos) {
    LoadedChunk loaded = decodeRow(row, rows_->ids(), rows_->identity().heights, budget_);
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

#include "terrane/store/overlay_store.h"

#include <algorithm>
#include <utility>

#include "terrane/base/log.h"
#include "terrane/store/saves/world_identity.h"

namespace terrane::store {

OverlayStore::OverlayStore(std::unique_ptr<ReadableStore> below, SaveLimits limits)
    : below_(std::move(below)),
      queue_(std::make_unique<SaveQueue>([this](const SaveBatch& batch) { return write(batch); }, limits)) {}

// Disables deriving: nobody can load its rows any more.
OverlayStore::~OverlayStore() {
    OverlayStore::setDerivedRows({});
}

std::optional<OverlayStore::Row> OverlayStore::find(world::ChunkPos pos) {
    const std::lock_guard lock(mutex_);
    const auto found = rows_.find(pos);
    if (found != rows_.end()) return found->second;
    return hidesTiles_ && pos.level > 0 ? std::optional(Row{}) : std::nullopt;
}

LoadedChunk OverlayStore::load(world::ChunkPos pos) {
    return std::move(OverlayStore::loadMany(std::span(&pos, 1)).front());
}

// Looks in the queue first: chunks that have left it are in the rows.
std::vector<LoadedChunk> OverlayStore::loadMany(std::span<const world::ChunkPos> positions) {
    const auto waiting = queue_->findMany(positions);
    std::vector<LoadedChunk> loaded(positions.size());
    std::vector<std::size_t> missing;
    std::vector<world::ChunkPos> missingPositions;
    for (std::size_t k = 0; k < positions.size(); ++k) {
        if (waiting[k] && waiting[k]->provenance == Provenance::Edited) continue;
        if (const auto row = find(positions[k])) {
            loaded[k] = loadedCopy(row->chunk, row->provenance);
        } else {
            missing.push_back(k);
            missingPositions.push_back(positions[k]);
        }
    }
    if (!missing.empty()) {
        auto below = below_->loadMany(missingPositions);
        for (std::size_t n = 0; n < missing.size(); ++n) loaded[missing[n]] = std::move(below[n]);
    }
    for (std::size_t k = 0; k < positions.size(); ++k)
        if (waiting[k] && loaded[k].provenance == Provenance::Generated)
            loaded[k] = loadedCopy(waiting[k]->chunk, waiting[k]->provenance);
    return loaded;
}

bool OverlayStore::contains(world::ChunkPos pos) {
    if (queue_->find(pos)) return true;
    const auto row = find(pos);
    return row ? row->chunk != nullptr : below_->contains(pos);
}

base::Result<std::vector<world::ChunkPos>> OverlayStore::editedChunks() {
    auto edited = TERRANE_TRY(below_->editedChunks());
    {
        const std::lock_guard lock(mutex_);
        for (const auto& [pos, row] : rows_)
            if (pos.level == 0 && row.chunk && row.provenance == Provenance::Edited) edited.push_back(pos);
    }
    std::sort(edited.begin(), edited.end());
    edited.erase(std::unique(edited.begin(), edited.end()), edited.end());
    return edited;
}

std::optional<std::string> OverlayStore::metadata(std::string_view name) {
    {
        const std::lock_guard lock(mutex_);
        const auto found = metadata_.find(name);
        if (found != metadata_.end()) return found->second;
    }
    return below_->metadata(name);
}

SaveNumber OverlayStore::save(world::ChunkPos pos, world::ChunkPtr chunk, Provenance provenance) {
    return queue_->add(pos, {std::move(chunk), provenance});
}

SaveNumber OverlayStore::setMetadata(std::string_view name, std::string value) {
    if (isReserved(name)) {
        base::logError("only the store writes {}; it stays unchanged", name);
        return queue_->status().queued;
    }
    const std::lock_guard lock(mutex_);
    metadata_.insert_or_assign(std::string(name), value);
    return queue_->add(std::string(name), std::move(value));
}

void OverlayStore::setDerivedRows(DerivedRows rows) {
    const std::lock_guard writing(writeMutex_);
    derivedRows_ = std::move(rows);
}

world::ChunkPtr OverlayStore::editedChunk(world::ChunkPos pos) {
    if (const auto row = find(pos)) return row->provenance == Provenance::Edited ? row->chunk : nullptr;
    if (!below_->contains(pos)) return nullptr;
    LoadedChunk loaded = below_->load(pos);
    return loaded.provenance == Provenance::Edited ? std::move(loaded.chunk) : nullptr;
}

base::Result<void> OverlayStore::write(const SaveBatch& batch) {
    const std::lock_guard writing(writeMutex_);
    const std::vector<ChunkRow> edited = editedOf(batch.chunks);
    std::vector<ChunkRow> derived;
    if (!edited.empty() && derivedRows_.derive)
        derived = derivedRows_.derive(edited, [this](world::ChunkPos pos) { return editedChunk(pos); });
    std::vector<std::pair<world::ChunkPos, Row>> changes;
    for (const auto& [pos, chunk] : batch.chunks)
        if (chunk.provenance == Provenance::Edited || !editedChunk(pos))
            changes.push_back({pos, {chunk.chunk, chunk.provenance}});
    for (const ChunkRow& row : derived) changes.push_back({row.pos, {row.chunk, Provenance::Edited}});
    {
        const std::lock_guard lock(mutex_);
        for (auto& [pos, row] : changes) rows_.insert_or_assign(pos, std::move(row));
        if (!edited.empty() && !derivedRows_.derive)
            metadata_.insert_or_assign(std::string(kDerivedRowsMark), std::nullopt);
    }
    if (derivedRows_.written && !derived.empty()) derivedRows_.written(derived);
    return {};
}

base::Result<void> OverlayStore::deriveAll(std::string_view rules) {
    const std::lock_guard writing(writeMutex_);
    auto edited = TERRANE_TRY(editedChunks());
    decltype(rows_) tiles;
    const auto saved = [&](world::ChunkPos pos) {
        if (pos.level == 0) return editedChunk(pos);
        const auto found = tiles.find(pos);
        return found == tiles.end() ? nullptr : found->second.chunk;
    };
    const auto write = [&](std::span<const ChunkRow> rows) -> base::Result<void> {
        for (const ChunkRow& row : rows) tiles.insert_or_assign(row.pos, Row{row.chunk, Provenance::Edited});
        return {};
    };
    TERRANE_TRY(deriveInGroups(derivedRows_, std::move(edited), saved, write));
    const std::lock_guard lock(mutex_);
    std::erase_if(rows_, [](const auto& entry) { return entry.first.level > 0; });
    rows_.merge(tiles);
    hidesTiles_ = true;
    metadata_.insert_or_assign(std::string(kDerivedRowsMark), std::string(rules));
    return {};
}

namespace {

class EmptyStore : public ReadableStore {
  public:
    explicit EmptyStore(WorldIdentity identity) : identity_(std::move(identity)) {}

    LoadedChunk load(world::ChunkPos) override { return {}; }
    bool contains(world::ChunkPos) override { return false; }
    base::Result<std::vector<world::ChunkPos>> editedChunks() override { return {}; }
    std::optional<std::string> metadata(std::string_view) override { return std::nullopt; }
    const WorldIdentity& identity() const override { return identity_; }

  private:
    WorldIdentity identity_;
};

}  // namespace

MemoryStore::MemoryStore(WorldIdentity identity, SaveLimits limits)
    : OverlayStore(std::make_unique<EmptyStore>(std::move(identity)), limits) {}

}  // namespace terrane::store

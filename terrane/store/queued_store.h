// A store whose rows are in a database: saves wait in a SaveQueue, loads run on the thread that asks. What
// kind of database it is, ChunkRows knows: SqliteStore is one of a file.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "terrane/store/chunk_reader.h"
#include "terrane/store/chunk_store.h"
#include "terrane/store/metadata.h"
#include "terrane/store/save_queue.h"

namespace terrane::store {

// The rows that follow from a batch.
struct DerivedBatch {
    std::vector<ChunkRow> rows;
    bool isComplete = true;  // false: derived rows are missing now, so kDerivedRowsMark goes
};

using ReadRow = std::function<StoredRow(world::ChunkPos)>;
// Derives them from the batch's edited chunks by what `read` finds: the database as it is without the batch.
using DeriveBatch =
    std::function<base::Result<DerivedBatch>(const std::vector<ChunkRow>& edited, const ReadRow& read)>;

// What is written into a world as it is, in one transaction.
struct RowChanges {
    std::vector<KeyedRow> rows;
    std::vector<std::int64_t> deleted;  // keys
    Metadata metadata;                  // reserved names, too
};

// The rows of a world in a database, to be read.
class ReadableRows {
  public:
    virtual ~ReadableRows() = default;

    // As they were when the world was opened. `name` is for messages: the file, or the database.
    virtual const std::string& name() const = 0;
    virtual const WorldIdentity& identity() const = 0;
    virtual const Metadata& metadata() const = 0;
    virtual const BlockIdMap& ids() const = 0;

    // Any thread.
    [[nodiscard]] virtual StoredRow read(world::ChunkPos pos) = 0;
    // Hands on each with its number in `positions` before it reads many more. Up to 256 are as they were at
    // one moment.
    using TakeRow = std::function<void(std::size_t, StoredRow)>;
    virtual void readMany(std::span<const world::ChunkPos> positions, const TakeRow& take) = 0;
    [[nodiscard]] virtual base::Result<bool> contains(world::ChunkPos pos) = 0;
    // As ReadableStore::editedChunks().
    [[nodiscard]] virtual base::Result<std::vector<world::ChunkPos>> editedChunks() = 0;
    // The next rows in the order of keys, of all levels: at most `count`, and no more once they have
    // kBytesOfRows. None at the end.
    [[nodiscard]] virtual base::Result<std::vector<KeyedRow>> rowsAfter(std::int64_t key,
                                                                        std::size_t count) = 0;
    [[nodiscard]] virtual base::Result<std::uint64_t> rowCount() = 0;
};

class ChunkRows : public ReadableRows {
  public:
    // One thread at a time. The batch and what follows from it, in one transaction. What the chunks of
    // `unread` replace is put aside first. False: the world lost kDerivedRowsMark. `derive` may be called
    // again where a transaction is tried again.
    [[nodiscard]] virtual base::Result<bool> write(const SaveBatch& batch, const ChunkPosSet& unread,
                                                   const DeriveBatch& derive) = 0;
    // As ChunkStore::deriveAll().
    [[nodiscard]] virtual base::Result<void> deriveAll(const DerivedRows& rows, std::string_view rules,
                                                       EntityBudget& budget) = 0;
    // For copies of worlds (world_copy.h). Nothing is checked or derived.
    [[nodiscard]] virtual base::Result<void> change(const RowChanges& changes) = 0;
};

// What DerivedRows::derive() reads of a database, and what goes wrong meanwhile.
class SavedRows {
  public:
    SavedRows(ReadRow read, const BlockIdMap& ids, EntityBudget& budget)
        : read_(std::move(read)), ids_(ids), budget_(budget) {}

    world::ChunkPtr editedChunk(world::ChunkPos pos);
    ReadEdited reader() {
        return [this](world::ChunkPos pos) { return editedChunk(pos); };
    }

    bool metDamage() const { return metDamage_; }
    // What could not be read: rows that were derived are not to be written. Damage is no problem.
    const base::Result<void>& result() const { return result_; }

  private:
    ReadRow read_;
    const BlockIdMap& ids_;
    EntityBudget& budget_;
    bool metDamage_ = false;
    base::Result<void> result_;
};

class QueuedStore : public ChunkStore {
  public:
    QueuedStore(std::unique_ptr<ChunkRows> rows, const SaveLimits& limits);

    LoadedChunk load(world::ChunkPos pos) override;
    std::vector<LoadedChunk> loadMany(std::span<const world::ChunkPos> positions) override;
    bool contains(world::ChunkPos pos) override;
    [[nodiscard]] base::Result<std::vector<world::ChunkPos>> editedChunks() override {
        return rows_->editedChunks();
    }
    // A chunk with more block entity data than a save keeps (62 MiB) is reported and left out.
    SaveNumber save(world::ChunkPos pos, world::ChunkPtr chunk, Provenance provenance) override;
    std::optional<std::string> metadata(std::string_view name) override;
    SaveNumber setMetadata(std::string_view name, std::string value) override;
    [[nodiscard]] base::Result<void> flush() override { return queue_->flush(); }
    SaveStatus status() override { return queue_->status(); }
    void setDerivedRows(DerivedRows rows) override;
    [[nodiscard]] base::Result<void> deriveAll(std::string_view rules) override;
    const WorldIdentity& identity() const override { return rows_->identity(); }
    void setVersion(std::int64_t newestEdit) override { version_ = newestEdit; }
    bool isPersistent() const override { return true; }

  private:
    LoadedChunk loadStored(const StoredRow& row, world::ChunkPos pos);
    void setUnread(world::ChunkPos pos, bool isUnread);
    bool isUnread(world::ChunkPos pos);
    ChunkPosSet unreadOf(const SaveBatch& batch);
    base::Result<DerivedBatch> derive(const std::vector<ChunkRow>& edited, const ReadRow& read);
    base::Result<void> write(const SaveBatch& batch);

    std::unique_ptr<ChunkRows> rows_;
    EntityBudget budget_;
    std::atomic<std::int64_t> version_ = 0;
    std::mutex metadataMutex_;
    Metadata metadata_;
    std::mutex unreadMutex_;
    ChunkPosSet unread_;     // reading these failed last: what is there is not known
    std::mutex writeMutex_;  // held while a batch is derived and written
    DerivedRows derivedRows_;
    std::unique_ptr<SaveQueue> queue_;  // ends first
};

}  // namespace terrane::store

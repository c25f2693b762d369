// A store whose rows are in a database: saves are queued in a SaveQueue, loads run on the calling thread.
// ChunkRows implements the kind of database; SqliteStore uses a file.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "terrane/base/log.h"
#include "terrane/store/chunk_store.h"
#include "terrane/store/save_queue.h"
#include "terrane/store/saves/world_identity.h"
#include "terrane/store/sqlite/chunk_reader.h"

namespace terrane::store {

// The derived rows of a batch.
struct DerivedBatch {
    std::vector<ChunkRow> rows;
    bool isComplete = true;  // false: derived rows are missing, so kDerivedRowsMark is removed
};

using ReadRow = std::function<StoredRow(world::ChunkPos)>;
// Derives rows from the batch's edited chunks. `read` reads the database without the batch.
using DeriveBatch =
    std::function<base::Result<DerivedBatch>(const std::vector<ChunkRow>& edited, const ReadRow& read)>;

// Changes to be written unchecked, in one transaction.
struct RowChanges {
    std::vector<KeyedRow> rows;
    std::vector<std::int64_t> deleted;  // keys
    Metadata metadata;                  // may have reserved names
};

// Messages about rows of a transaction. They are told once it is committed, and not at each attempt.
class RowMessages {
  public:
    void warn(std::string text) { messages_.push_back({base::LogLevel::Warning, std::move(text)}); }
    void error(std::string text) { messages_.push_back({base::LogLevel::Error, std::move(text)}); }
    void forget() { messages_.clear(); }  // the transaction failed
    void tell();

  private:
    struct Message {
        base::LogLevel level;
        std::string text;
    };
    std::vector<Message> messages_;
};

// Read access to the rows of a world in a database.
class ReadableRows {
  public:
    virtual ~ReadableRows() = default;

    // These return the state when the world was opened. name() is the file or database, for messages.
    virtual const std::string& name() const = 0;
    virtual const WorldIdentity& identity() const = 0;
    virtual const Metadata& metadata() const = 0;
    virtual const BlockIdMap& ids() const = 0;

    // Reads a row. Any thread may call it.
    [[nodiscard]] virtual StoredRow read(world::ChunkPos pos) = 0;
    // Passes each row with its index in `positions` to `take` before reading many more. Up to 256 rows are
    // read as of one moment.
    using TakeRow = std::function<void(std::size_t, StoredRow)>;
    virtual void readMany(std::span<const world::ChunkPos> positions, const TakeRow& take) = 0;
    [[nodiscard]] virtual base::Result<bool> contains(world::ChunkPos pos) = 0;
    // See ReadableStore::editedChunks().
    [[nodiscard]] virtual base::Result<std::vector<world::ChunkPos>> editedChunks() = 0;
    // Returns the next rows by key, of all levels: at most `count`, and no more after kBytesOfRows. Empty at
    // the end.
    [[nodiscard]] virtual base::Result<std::vector<KeyedRow>> rowsAfter(std::int64_t key,
                                                                        std::size_t count) = 0;
    [[nodiscard]] virtual base::Result<std::uint64_t> rowCount() = 0;
};

class ChunkRows : public ReadableRows {
  public:
    // Writes the batch and its derived rows in one transaction. Rows in `unread` are quarantined before they
    // are replaced. Returns false if the world lost kDerivedRowsMark. `derive` may be called again if the
    // transaction is retried. One thread at a time may use it.
    [[nodiscard]] virtual base::Result<bool> write(const SaveBatch& batch, const ChunkPosSet& unread,
                                                   const DeriveBatch& derive) = 0;
    // See ChunkStore::deriveAll().
    [[nodiscard]] virtual base::Result<void> deriveAll(const DerivedRows& rows, std::string_view rules,
                                                       EntityBudget& budget) = 0;
    // Writes changes of a copy of a world (world_copy.h) without checking or deriving rows.
    [[nodiscard]] virtual base::Result<void> change(const RowChanges& changes) = 0;
};

// Reads a database for DerivedRows::derive(), and records errors.
class SavedRows {
  public:
    SavedRows(ReadRow read, const BlockIdMap& ids, world::Heights heights, EntityBudget& budget)
        : read_(std::move(read)), ids_(ids), heights_(heights), budget_(budget) {}

    world::ChunkPtr editedChunk(world::ChunkPos pos);
    ReadEdited reader() {
        return [this](world::ChunkPos pos) { return editedChunk(pos); };
    }

    bool foundDamage() const { return foundDamage_; }
    // Returns the first read error; then the derived rows must not be written. Damaged rows are not an error.
    const base::Result<void>& result() const { return result_; }

  private:
    ReadRow read_;
    const BlockIdMap& ids_;
    world::Heights heights_;
    EntityBudget& budget_;
    bool foundDamage_ = false;
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
    // Queues a chunk. A chunk with more block entity data than a save can store (62 MiB) is reported and not
    // saved.
    SaveNumber save(world::ChunkPos pos, world::ChunkPtr chunk, Provenance provenance) override;
    std::optional<std::string> metadata(std::string_view name) override;
    SaveNumber setMetadata(std::string_view name, std::string value) override;
    [[nodiscard]] std::shared_ptr<void> together() override { return queue_->hold(); }
    [[nodiscard]] base::Result<void> flush() override { return queue_->flush(); }
    SaveStatus status() override { return queue_->status(); }
    void setDerivedRows(DerivedRows rows) override;
    [[nodiscard]] base::Result<void> deriveAll(std::string_view rules) override;
    const WorldIdentity& identity() const override { return rows_->identity(); }
    void setVersion(std::int64_t newestEdit) override { version_ = newestEdit; }
    bool isPersistent() const override { return true; }

  protected:
    const ReadableRows& rows() const { return *rows_; }
    // See SaveQueue::unsaved().
    SaveBatch unsaved(const std::function<void()>& look) { return queue_->unsaved(look); }
    // Derives the rows of a batch as for this store's own. On any thread, while the store exists.
    DeriveBatch deriver();

  private:
    LoadedChunk loadStored(const StoredRow& row, world::ChunkPos pos);
    void setUnread(world::ChunkPos pos, bool isUnreadable);
    bool isUnreadable(world::ChunkPos pos);
    ChunkPosSet unreadOf(const SaveBatch& batch);
    base::Result<DerivedBatch> derive(const std::vector<ChunkRow>& edited, const ReadRow& read);
    base::Result<void> write(const SaveBatch& batch);

    std::unique_ptr<ChunkRows> rows_;
    EntityBudget budget_;
    std::atomic<std::int64_t> version_ = 0;
    std::mutex metadataMutex_;
    Metadata metadata_;
    std::mutex unreadMutex_;
    ChunkPosSet unread_;     // positions whose last read failed, so their rows are unknown
    std::mutex writeMutex_;  // held while a batch is derived and written
    DerivedRows derivedRows_;
    std::unique_ptr<SaveQueue> queue_;  // destroyed first
};

// A read-only store of a world in a database.
class RowsReader : public ReadableStore {
  public:
    RowsReader(std::unique_ptr<ReadableRows> rows, const SaveLimits& limits)
        : rows_(std::move(rows)), budget_(limits.entityBytes) {}

    LoadedChunk load(world::ChunkPos pos) override;
    std::vector<LoadedChunk> loadMany(std::span<const world::ChunkPos> positions) override;
    bool contains(world::ChunkPos pos) override;
    [[nodiscard]] base::Result<std::vector<world::ChunkPos>> editedChunks() override {
        return rows_->editedChunks();
    }
    std::optional<std::string> metadata(std::string_view name) override;
    const WorldIdentity& identity() const override { return rows_->identity(); }

  private:
    LoadedChunk decode(const StoredRow& row, world::ChunkPos pos);

    std::unique_ptr<ReadableRows> rows_;
    EntityBudget budget_;
};

}  // namespace terrane::store

// Writes batches and derived rows into an open save, each call in one transaction. Used by one thread at a
// time.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string_view>

#include "terrane/store/chunk_reader.h"
#include "terrane/store/derived_rows.h"
#include "terrane/store/metadata_table.h"
#include "terrane/store/save_file.h"
#include "terrane/store/save_queue.h"

namespace terrane::store {

// What DerivedRows::derive() reads of a file, and what goes wrong meanwhile.
class SavedRows {
  public:
    SavedRows(std::function<StoredRow(world::ChunkPos)> read, const BlockIdMap& ids, EntityBudget& budget)
        : read_(std::move(read)), ids_(ids), budget_(budget) {}

    world::ChunkPtr editedChunk(world::ChunkPos pos);
    ReadEdited reader() {
        return [this](world::ChunkPos pos) { return editedChunk(pos); };
    }

    bool metDamage() const { return metDamage_; }
    // What could not be read: rows that were derived are not to be written. Damage is no problem.
    const base::Result<void>& result() const { return result_; }

  private:
    std::function<StoredRow(world::ChunkPos)> read_;
    const BlockIdMap& ids_;
    EntityBudget& budget_;
    bool metDamage_ = false;
    base::Result<void> result_;
};

class SqliteWriter {
  public:
    // Keeps both.
    [[nodiscard]] static base::Result<std::unique_ptr<SqliteWriter>> make(SaveFile& file,
                                                                          EntityBudget& budget);

    // The batch and the rows derived from it. What the chunks of `unread` replace is put aside first. Unless
    // `isComplete`, or where a row is lost, the world has not all derived rows any more: kDerivedRowsMark
    // goes, and false comes back.
    [[nodiscard]] base::Result<bool> write(const SaveBatch& batch, const ChunkPosSet& unread,
                                           std::span<const ChunkRow> derived, bool isComplete);
    // As ChunkStore::deriveAll().
    [[nodiscard]] base::Result<void> deriveAll(const DerivedRows& rows, std::string_view rules);

  private:
    struct Statements {
        Statement selectChunk, putChunk, deleteChunk, quarantineAll, noteQuarantine;
    };
    SqliteWriter(SaveFile& file, EntityBudget& budget, Statements statements, MetadataTable metadata)
        : file_(file), budget_(budget), use_(std::move(statements)), metadata_(std::move(metadata)) {}

    base::Result<void> writeBatch(const SaveBatch& batch, const ChunkPosSet& unread);
    base::Result<void> writeChunk(world::ChunkPos pos, const WaitingChunk& chunk);
    base::Result<void> writeDerived(std::span<const ChunkRow> rows);
    base::Result<void> putAside(world::ChunkPos pos, std::string_view reason);
    base::Result<void> putAsideIfDamaged(world::ChunkPos pos);
    base::Result<void> quarantine(const DamagedRow& row);
    base::Result<void> deleteRow(world::ChunkPos pos);

    SaveFile& file_;
    EntityBudget& budget_;
    Statements use_;
    MetadataTable metadata_;
    bool isComplete_ = true;  // of the transaction that runs
};

}  // namespace terrane::store

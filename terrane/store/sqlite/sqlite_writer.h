// Writes batches and derived rows into an open save, each call in one transaction. It is used by one thread
// at a time.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "terrane/base/result.h"
#include "terrane/store/queued_store.h"
#include "terrane/store/saves/save_file.h"
#include "terrane/store/sqlite/metadata_table.h"

namespace terrane::store {

class SqliteWriter {
  public:
    // Creates a writer, which keeps a reference to `file`.
    [[nodiscard]] static base::Result<std::unique_ptr<SqliteWriter>> make(SaveFile& file);

    // See ChunkRows::write(). Fails and writes nothing if the save was deleted or replaced.
    [[nodiscard]] base::Result<bool> write(const SaveBatch& batch, const ChunkPosSet& unread,
                                           const DerivedBatch& derived);
    // See ChunkStore::deriveAll().
    [[nodiscard]] base::Result<void> deriveAll(const DerivedRows& rows, std::string_view rules,
                                               EntityBudget& budget);
    // See ChunkRows::change().
    [[nodiscard]] base::Result<void> change(const RowChanges& changes);

  private:
    struct Statements {
        Statement selectChunk, putChunk, deleteChunk, quarantineAll, noteQuarantine;
    };
    SqliteWriter(SaveFile& file, Statements statements, MetadataTable metadata)
        : file_(file),
          files_(file.database.path()),
          use_(std::move(statements)),
          metadata_(std::move(metadata)) {}

    base::Result<Transaction> begin();
    base::Result<void> commit(Transaction& transaction);
    base::Result<void> writeBatch(const SaveBatch& batch, const ChunkPosSet& unread);
    base::Result<void> writeChunk(world::ChunkPos pos, const QueuedChunk& chunk);
    base::Result<void> writeDerived(std::span<const ChunkRow> rows);
    base::Result<void> quarantineRow(world::ChunkPos pos, std::string_view reason);
    base::Result<void> quarantineIfDamaged(world::ChunkPos pos);
    base::Result<std::optional<DamagedRow>> readDamaged(world::ChunkPos pos);
    base::Result<bool> isSaved(const DamagedRow& row);  // as it was read
    base::Result<void> quarantine(const DamagedRow& row);
    base::Result<void> deleteRow(world::ChunkPos pos);

    SaveFile& file_;
    OpenFiles files_;
    Statements use_;
    MetadataTable metadata_;
    bool isComplete_ = true;  // derived rows of the running transaction are complete
    bool hasFailed_ = false;  // the last transaction failed
    RowMessages messages_;    // of the running transaction
};

}  // namespace terrane::store

// Writes batches and derived rows into a world in PostgreSQL, each call in one transaction, through the
// connection that holds the world's locks. Used by one thread at a time.
#pragma once

#include <optional>

#include "terrane/store/queued_store.h"
#include "terrane/store_postgres/connection.h"
#include "terrane/store_postgres/world_database.h"

namespace terrane::store_postgres {

class PostgresWriter {
  public:
    // Keeps references to the pool, whose times limit retries, and to the contents. `connection` has the
    // locks of `sharing`; it is replaced if it is lost.
    PostgresWriter(ConnectionPool& pool, const WorldContents& contents, Connection connection,
                   store::WorldSharing sharing)
        : pool_(pool), contents_(contents), connection_(std::move(connection)), sharing_(sharing) {}
    ~PostgresWriter();
    PostgresWriter(const PostgresWriter&) = delete;
    PostgresWriter& operator=(const PostgresWriter&) = delete;

    // See store::ChunkRows. A transaction whose COMMIT was cut off is repeated with the same rows.
    [[nodiscard]] base::Result<bool> write(const store::SaveBatch& batch, const store::ChunkPosSet& unread,
                                           const store::DeriveBatch& derive);
    [[nodiscard]] base::Result<void> deriveAll(const store::DerivedRows& rows, std::string_view rules,
                                               store::EntityBudget& budget);
    [[nodiscard]] base::Result<void> change(const store::RowChanges& changes);

  private:
    template <class T, class Do>
    base::Result<T> inTransaction(Do action);
    base::Result<bool> writeBatch(const store::SaveBatch& batch, const store::ChunkPosSet& unread,
                                  const store::DeriveBatch& derive);
    base::Result<void> deriveRows(const store::DerivedRows& rows, std::string_view rules,
                                  store::EntityBudget& budget);
    base::Result<void> quarantine(const store::DamagedRow& row);
    base::Result<void> quarantineRow(world::ChunkPos pos, std::string_view reason);
    base::Result<void> quarantineDamaged(std::span<const std::int64_t> keys);
    base::Result<void> writeDerived(std::span<const store::ChunkRow> rows);
    base::Result<store::QueuedChunks> newestChunks(const store::SaveBatch& batch);
    base::Result<void> writeChunks(const store::QueuedChunks& chunks);
    base::Result<void> changeRows(const store::RowChanges& changes);
    base::Result<void> writeMetadata(const store::Metadata& metadata);

    ConnectionPool& pool_;
    const WorldContents& contents_;
    Connection connection_;
    store::WorldSharing sharing_;
    bool isComplete_ = true;       // derived rows of the running transaction are complete
    store::RowMessages messages_;  // of the running transaction
};

}  // namespace terrane::store_postgres

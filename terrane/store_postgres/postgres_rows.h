// Reads the rows of a world in PostgreSQL.
#pragma once

#include <memory>

#include "terrane/store/queued_store.h"
#include "terrane/store_postgres/connection.h"
#include "terrane/store_postgres/world_database.h"

namespace terrane::store_postgres {

// Reads on any number of threads, through connections of the pool.
class ChunkQueries {
  public:
    explicit ChunkQueries(ConnectionPool& pool) : pool_(pool) {}

    [[nodiscard]] store::StoredRow read(world::ChunkPos pos);
    void readMany(std::span<const world::ChunkPos> positions, const store::ReadableRows::TakeRow& take);
    [[nodiscard]] base::Result<bool> contains(world::ChunkPos pos);
    [[nodiscard]] base::Result<std::vector<world::ChunkPos>> editedChunks();
    [[nodiscard]] base::Result<std::vector<store::KeyedRow>> rowsAfter(std::int64_t key, std::size_t count);
    [[nodiscard]] base::Result<std::uint64_t> rowCount();

  private:
    ConnectionPool& pool_;
};

// Reads through one connection, inside its transaction.
[[nodiscard]] store::StoredRow readRow(Connection& connection, world::ChunkPos pos);
// The existing rows, unordered, all in memory at once. Data of more than 256 KiB is left out, as a problem.
[[nodiscard]] base::Result<std::vector<store::KeyedRow>> readRows(Connection& connection,
                                                                  std::span<const std::int64_t> keys);
[[nodiscard]] base::Result<std::vector<world::ChunkPos>> readEditedChunks(Connection& connection);
// See store::ReadableRows::rowsAfter().
[[nodiscard]] base::Result<std::vector<store::KeyedRow>> readRowsAfter(Connection& connection,
                                                                       std::int64_t key, std::size_t count);
// Reads data and origin from the columns `column` and `column` + 1.
store::StoredChunk storedChunk(const Rows& rows, int row, int column, world::ChunkPos pos);

}  // namespace terrane::store_postgres

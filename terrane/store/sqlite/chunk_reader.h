// Reads chunks of an open save on any number of threads, with a pool of connections.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "terrane/store/chunk_store.h"
#include "terrane/store/chunks/block_id_map.h"
#include "terrane/store/chunks/entity_budget.h"
#include "terrane/store/sqlite/sqlite.h"

namespace terrane::store {

struct StoredChunk {
    Bytes data;
    Provenance provenance = Provenance::Generated;
    std::string problem;     // error in the row's columns; empty if none
    std::uint64_t seed = 0;  // of its checksum
};

// Limit of row data in memory at once, exceeded by at most one row.
constexpr std::size_t kBytesOfRows = std::size_t{8} << 20;

struct KeyedRow {
    std::int64_t key = 0;
    StoredChunk row;
};

// A row has no value if the save has no such chunk; it is an error if the file is damaged.
using StoredRow = base::Result<std::optional<StoredChunk>>;

// Reads one row with a statement that selects data and origin of the key ?1. `format`: of the save.
StoredRow readRow(Statement& select, world::ChunkPos pos, std::int64_t format);

// Returns the seed of a row's checksum; `origin` has a valid type.
std::uint64_t seedOf(world::ChunkPos pos, std::int64_t origin, std::int64_t format);

// Returns the error in the types or the origin of a row; empty if there is none.
std::string rowProblem(const Statement& row, int dataColumn, int originColumn);

// See ReadableStore::editedChunks().
[[nodiscard]] base::Result<std::vector<world::ChunkPos>> readEditedChunks(Database& database);

// Decodes the chunk of a row, or reports its error without file and position.
LoadedChunk decodeRow(const StoredRow& row, const BlockIdMap& ids, world::Heights heights,
                      EntityBudget& budget);

class ChunkReader {
  public:
    // `format` is the save's format.
    ChunkReader(std::filesystem::path path, OpenMode mode, std::int64_t format)
        : path_(std::move(path)), mode_(mode), format_(format) {}

    // Reads a row. Any thread may call it.
    [[nodiscard]] StoredRow read(world::ChunkPos pos);
    // Reads all in one transaction, as of one moment. Passes each to `take` with its index in `positions`
    // before reading the next, since together they may be large.
    void readMany(std::span<const world::ChunkPos> positions,
                  const std::function<void(std::size_t, StoredRow)>& take);
    [[nodiscard]] base::Result<bool> contains(world::ChunkPos pos);
    [[nodiscard]] base::Result<std::vector<world::ChunkPos>> editedChunks();
    // See ReadableRows::rowsAfter().
    [[nodiscard]] base::Result<std::vector<KeyedRow>> rowsAfter(std::int64_t key, std::size_t count);
    [[nodiscard]] base::Result<std::uint64_t> rowCount();

  private:
    base::Result<std::vector<KeyedRow>> readRowsAfter(Database& database, std::int64_t key,
                                                      std::size_t count) const;
    struct Connection {
        Database database;
        Statement select, count, begin, end;
    };
    base::Result<std::unique_ptr<Connection>> open() const;
    base::Result<std::unique_ptr<Connection>> acquireConnection();
    void releaseConnection(std::unique_ptr<Connection> connection);

    std::filesystem::path path_;
    OpenMode mode_;
    std::int64_t format_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<Connection>> idle_;
};

}  // namespace terrane::store

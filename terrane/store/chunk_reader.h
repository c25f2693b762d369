// Reads chunks of an open save on any number of threads: each uses a connection of its own for the moment,
// and leaves it for the next.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "terrane/store/block_id_map.h"
#include "terrane/store/chunk_store.h"
#include "terrane/store/entity_budget.h"
#include "terrane/store/sqlite.h"

namespace terrane::store {

struct StoredChunk {
    Bytes data;
    Provenance provenance = Provenance::Generated;
    std::string problem;     // what is wrong with the row beside its data; empty where nothing is
    std::uint64_t seed = 0;  // of its checksum
};

// Of the data of rows in memory at once, and one row more.
constexpr std::size_t kBytesOfRows = std::size_t{8} << 20;

struct KeyedRow {
    std::int64_t key = 0;
    StoredChunk row;
};

// Nothing where the save has no chunk; an error where the file is damaged.
using StoredRow = base::Result<std::optional<StoredChunk>>;

// By a statement that selects data and origin of the key ?1, of a save of this format.
StoredRow readRow(Statement& select, world::ChunkPos pos, std::int64_t format);

// With what the checksum of a row begins, whose origin has the type that it should.
std::uint64_t seedOf(world::ChunkPos pos, std::int64_t origin, std::int64_t format);

// What is wrong with the types of a row; empty where nothing is.
std::string rowProblem(const Statement& row, int dataColumn, int originColumn);

// As ReadableStore::editedChunks().
[[nodiscard]] base::Result<std::vector<world::ChunkPos>> readEditedChunks(Database& database);

// The chunk of a row, or what is wrong with it, without the file and the position.
LoadedChunk decodeRow(const StoredRow& row, const BlockIdMap& ids, EntityBudget& budget);

class ChunkReader {
  public:
    // `format`: of the save.
    ChunkReader(std::filesystem::path path, OpenMode mode, std::int64_t format)
        : path_(std::move(path)), mode_(mode), format_(format) {}

    // Any thread.
    [[nodiscard]] StoredRow read(world::ChunkPos pos);
    // All as they were at one moment, in one transaction. Hands on each with its number in `positions` before
    // it reads the next: together they may be large.
    void readMany(std::span<const world::ChunkPos> positions,
                  const std::function<void(std::size_t, StoredRow)>& take);
    [[nodiscard]] base::Result<bool> contains(world::ChunkPos pos);
    [[nodiscard]] base::Result<std::vector<world::ChunkPos>> editedChunks();
    // As ReadableRows::rowsAfter().
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
    base::Result<std::unique_ptr<Connection>> takeConnection();
    void giveBack(std::unique_ptr<Connection> connection);

    std::filesystem::path path_;
    OpenMode mode_;
    std::int64_t format_;
    std::mutex mutex_;
    std::vector<std::unique_ptr<Connection>> idle_;
};

}  // namespace terrane::store

#include "terrane/store/sqlite/chunk_reader.h"

#include <utility>

#include "terrane/store/chunks/chunk_codec.h"
#include "terrane/store/chunks/chunk_key.h"
#include "terrane/store/sqlite/schema.h"

namespace terrane::store {

namespace {

base::Result<world::Chunk> decodeStored(const StoredChunk& stored, const BlockIdMap& ids,
                                        world::Heights heights, EntityBudget& budget) {
    if (!stored.problem.empty()) return base::fail(base::ErrorCode::Damaged, "{}", stored.problem);
    return decodeChunk(stored.data, ids, heights, stored.seed, &budget);
}

}  // namespace

LoadedChunk decodeRow(const StoredRow& row, const BlockIdMap& ids, world::Heights heights,
                      EntityBudget& budget) {
    if (row && !*row) return {};
    base::Result<world::Chunk> chunk =
        row ? decodeStored(**row, ids, heights, budget) : tl::unexpected(row.error());
    if (chunk) {
        LoadedChunk loaded;
        loaded.state = LoadedChunk::State::Present;
        loaded.chunk = std::make_shared<world::Chunk>(std::move(*chunk));
        loaded.provenance = (*row)->provenance;
        return loaded;
    }
    LoadedChunk damaged;
    damaged.state = LoadedChunk::State::Damaged;
    damaged.problem = chunk.error().message;
    damaged.isOverBudget = row && chunk.error().code == base::ErrorCode::OutOfResources;
    damaged.isUnreadable = !row || damaged.isOverBudget;
    return damaged;
}

std::string rowProblem(const Statement& row, int dataColumn, int originColumn) {
    if (row.type(dataColumn) != ColumnType::Blob) return "its data is not a blob";
    const bool isNumber = row.type(originColumn) == ColumnType::Integer;
    if (isNumber && (row.number(originColumn) == 0 || row.number(originColumn) == 1)) return "";
    return fmt::format("its origin is \"{}\", expected 0 or 1", row.text(originColumn).substr(0, 64));
}

std::uint64_t seedOf(world::ChunkPos pos, std::int64_t origin, std::int64_t format) {
    return format < kFirstWithChecksums ? kLegacySeed : checksumSeed(pos, origin != 0);
}

namespace {

// Reads the columns data and origin.
StoredChunk storedChunk(const Statement& row, world::ChunkPos pos, std::int64_t format) {
    std::string problem = rowProblem(row, 0, 1);
    const ByteView data = row.blob(0);
    const Provenance provenance = row.number(1) == 0 ? Provenance::Generated : Provenance::Edited;
    return {Bytes(data.begin(), data.end()), provenance, std::move(problem),
            seedOf(pos, row.number(1), format)};
}

// `count`: SELECT count(*).
base::Result<bool> hasRow(Statement& count, world::ChunkPos pos) {
    const ResetGuard reset(count);
    count.bind(1, keyOf(pos));
    const auto row = TERRANE_TRY(count.step());
    return row && count.number(0) > 0;
}

}  // namespace

StoredRow readRow(Statement& select, world::ChunkPos pos, std::int64_t format) {
    const ResetGuard reset(select);
    select.bind(1, keyOf(pos));
    const auto row = TERRANE_TRY(select.step());
    return row ? std::optional(storedChunk(select, pos, format)) : std::nullopt;
}

base::Result<std::vector<world::ChunkPos>> readEditedChunks(Database& database) {
    std::vector<world::ChunkPos> edited;
    const auto take = [&](const Statement& row) -> base::Result<void> {
        const world::ChunkPos pos = posOf(row.number(0));
        // A cycle of damaged pages would return rows forever.
        if (!edited.empty() && keyOf(pos) <= keyOf(edited.back()))
            return base::fail(base::ErrorCode::Damaged, "{}: damaged: its chunks are out of order",
                              database.path());
        edited.push_back(pos);
        return {};
    };
    const std::string sql =
        fmt::format("SELECT key FROM chunks WHERE origin = {} AND key >= 0 AND key < {} ORDER BY key",
                    static_cast<int>(Provenance::Edited), kFirstTileKey);
    TERRANE_TRY(forEachRow(database, sql, take));
    return edited;
}

base::Result<std::vector<KeyedRow>> ChunkReader::readRowsAfter(Database& database, std::int64_t key,
                                                               std::size_t count) const {
    auto select = TERRANE_TRY(database.prepare(fmt::format(
        "SELECT data, origin, key FROM chunks WHERE key > {} ORDER BY key LIMIT {}", key, count)));
    std::vector<KeyedRow> rows;
    std::size_t bytes = 0;
    while (bytes < kBytesOfRows) {
        const auto row = TERRANE_TRY(select.step());
        if (!row) break;
        const std::int64_t next = select.number(2);
        if (next <= (rows.empty() ? key : rows.back().key))
            return base::fail(base::ErrorCode::Damaged, "{}: damaged: its chunks are out of order",
                              path_.string());
        rows.push_back({next, storedChunk(select, posOf(next), format_)});
        bytes += rows.back().row.data.size();
    }
    return rows;
}

base::Result<std::vector<KeyedRow>> ChunkReader::rowsAfter(std::int64_t key, std::size_t count) {
    auto connection = TERRANE_TRY(acquireConnection());
    auto rows = readRowsAfter(connection->database, key, count);
    releaseConnection(std::move(connection));
    return rows;
}

base::Result<std::uint64_t> ChunkReader::rowCount() {
    auto connection = TERRANE_TRY(acquireConnection());
    const auto count = connection->database.queryNumber("SELECT count(*) FROM chunks");
    releaseConnection(std::move(connection));
    if (!count) return tl::unexpected(count.error());
    return static_cast<std::uint64_t>(count->value_or(0));
}

base::Result<std::unique_ptr<ChunkReader::Connection>> ChunkReader::open() const {
    auto database = TERRANE_TRY(Database::open(path_, mode_));
    auto select = TERRANE_TRY(database.prepare("SELECT data, origin FROM chunks WHERE key = ?1"));
    auto count = TERRANE_TRY(database.prepare("SELECT count(*) FROM chunks WHERE key = ?1"));
    auto begin = TERRANE_TRY(database.prepare("BEGIN"));
    auto end = TERRANE_TRY(database.prepare("COMMIT"));
    return std::make_unique<Connection>(Connection{std::move(database), std::move(select), std::move(count),
                                                   std::move(begin), std::move(end)});
}

base::Result<std::unique_ptr<ChunkReader::Connection>> ChunkReader::acquireConnection() {
    {
        const std::lock_guard lock(mutex_);
        if (!idle_.empty()) {
            auto connection = std::move(idle_.back());
            idle_.pop_back();
            return connection;
        }
    }
    return open();
}

void ChunkReader::releaseConnection(std::unique_ptr<Connection> connection) {
    const std::lock_guard lock(mutex_);
    idle_.push_back(std::move(connection));
}

StoredRow ChunkReader::read(world::ChunkPos pos) {
    auto connection = TERRANE_TRY(acquireConnection());
    StoredRow row = readRow(connection->select, pos, format_);
    releaseConnection(std::move(connection));
    return row;
}

void ChunkReader::readMany(std::span<const world::ChunkPos> positions,
                           const std::function<void(std::size_t, StoredRow)>& take) {
    auto connection = acquireConnection();
    if (!connection) {
        for (std::size_t k = 0; k < positions.size(); ++k) take(k, tl::unexpected(connection.error()));
        return;
    }
    // Without a transaction the reads are slower, but correct.
    const bool hasBegun = (*connection)->begin.run().has_value();
    for (std::size_t k = 0; k < positions.size(); ++k)
        take(k, readRow((*connection)->select, positions[k], format_));
    const bool hasEnded = !hasBegun || (*connection)->end.run();
    // If the transaction cannot end, drop the connection.
    if (hasEnded) releaseConnection(std::move(*connection));
}

base::Result<bool> ChunkReader::contains(world::ChunkPos pos) {
    auto connection = TERRANE_TRY(acquireConnection());
    const auto found = hasRow(connection->count, pos);
    releaseConnection(std::move(connection));
    return found;
}

base::Result<std::vector<world::ChunkPos>> ChunkReader::editedChunks() {
    auto connection = TERRANE_TRY(acquireConnection());
    auto edited = readEditedChunks(connection->database);
    releaseConnection(std::move(connection));
    return edited;
}

}  // namespace terrane::store

#include "terrane/store_postgres/postgres_rows.h"

#include <unordered_map>

#include "terrane/store/chunks/chunk_codec.h"
#include "terrane/store/chunks/chunk_key.h"

namespace terrane::store_postgres {
namespace {

using store::StoredChunk;
using store::StoredRow;
using world::ChunkPos;

// Longer data is not a valid chunk and is not fetched.
#define TERRANE_CHUNK_DATA "CASE WHEN octet_length(data) <= 68157440 THEN data END"  // 65 MiB
static_assert(store::kMaxChunkBytes + (1u << 20) == 68157440, "a chunk and the overhead of its zstd frame");

constexpr Statement kRead = {"SELECT " TERRANE_CHUNK_DATA ", origin FROM chunks WHERE key = $1"};
// Longer rows are fetched one by one, since all rows of a call are in memory at once.
constexpr Statement kReadMany = {
    "SELECT key, CASE WHEN octet_length(data) <= 262144 THEN data END, origin FROM chunks WHERE key = ANY "
    "($1)"};
constexpr Statement kRowsAfter = {
    "SELECT key, data, origin FROM (SELECT key, data, origin, coalesce(sum(octet_length(data)) OVER (ORDER "
    "BY key ROWS "
    "BETWEEN UNBOUNDED PRECEDING AND 1 PRECEDING), 0) AS before FROM (SELECT key, " TERRANE_CHUNK_DATA
    " AS data, origin FROM chunks WHERE key > $1 ORDER BY key LIMIT $2) AS page) AS counted WHERE before < "
    "$3 "
    "ORDER BY key"};
constexpr Statement kCount = {"SELECT count(*) FROM chunks"};
constexpr Statement kContains = {"SELECT EXISTS (SELECT 1 FROM chunks WHERE key = $1)"};
constexpr Statement kEdited = {
    "SELECT key FROM chunks WHERE origin = 1 AND key >= 0 AND key < $1 ORDER BY key"};

// Rows per query: about 2 MB for rows of 1 to 10 KB, at most 64 MiB.
constexpr std::size_t kRowsAtOnce = 256;
static_assert(kRowsAtOnce * 262144 == (64u << 20), "the limit of data in kReadMany");

}  // namespace

StoredChunk storedChunk(const Rows& rows, int row, int column, ChunkPos pos) {
    StoredChunk chunk;
    const ByteView data = rows.bytes(row, column);
    const std::int64_t origin = rows.number(row, column + 1);
    chunk.data.assign(data.begin(), data.end());
    if (rows.isNull(row, column)) chunk.problem = "longer than a chunk can be";
    if (origin != 0 && origin != 1) chunk.problem = fmt::format("its origin is {}, expected 0 or 1", origin);
    chunk.provenance = origin == 0 ? store::Provenance::Generated : store::Provenance::Edited;
    chunk.seed = store::checksumSeed(pos, origin != 0);
    return chunk;
}

namespace {

std::vector<store::KeyedRow> keyedRows(const Rows& found) {
    std::vector<store::KeyedRow> rows;
    for (int row = 0; row < found.count(); ++row) {
        const std::int64_t at = found.number(row, 0);
        rows.push_back({at, storedChunk(found, row, 1, store::posOf(at))});
    }
    return rows;
}

}  // namespace

StoredRow readRow(Connection& connection, ChunkPos pos) {
    const auto rows = TERRANE_TRY(connection.run(kRead, Parameters().number(store::keyOf(pos))));
    if (rows.count() == 0) return std::optional<StoredChunk>();
    return std::optional(storedChunk(rows, 0, 0, pos));
}

base::Result<std::vector<ChunkPos>> readEditedChunks(Connection& connection) {
    const auto rows = TERRANE_TRY(connection.run(kEdited, Parameters().number(store::kFirstTileKey)));
    std::vector<ChunkPos> edited;
    edited.reserve(static_cast<std::size_t>(rows.count()));
    for (int row = 0; row < rows.count(); ++row) edited.push_back(store::posOf(rows.number(row, 0)));
    return edited;
}

base::Result<std::vector<store::KeyedRow>> readRows(Connection& connection,
                                                    std::span<const std::int64_t> keys) {
    const auto found = TERRANE_TRY(connection.run(kReadMany, Parameters().numbers(keys)));
    return keyedRows(found);
}

base::Result<std::vector<store::KeyedRow>> readRowsAfter(Connection& connection, std::int64_t key,
                                                         std::size_t count) {
    const auto found =
        TERRANE_TRY(connection.run(kRowsAfter, Parameters()
                                                   .number(key)
                                                   .number(static_cast<std::int64_t>(count))
                                                   .number(static_cast<std::int64_t>(store::kBytesOfRows))));
    return keyedRows(found);
}

base::Result<std::vector<store::KeyedRow>> ChunkQueries::rowsAfter(std::int64_t key, std::size_t count) {
    return pool_.run<std::vector<store::KeyedRow>>(
        [&](Connection& connection) { return readRowsAfter(connection, key, count); });
}

base::Result<std::uint64_t> ChunkQueries::rowCount() {
    return pool_.run<std::uint64_t>([](Connection& connection) -> base::Result<std::uint64_t> {
        const auto rows = TERRANE_TRY(connection.run(kCount));
        return static_cast<std::uint64_t>(rows.number(0, 0));
    });
}

StoredRow ChunkQueries::read(ChunkPos pos) {
    return pool_.run<std::optional<StoredChunk>>(
        [&](Connection& connection) { return readRow(connection, pos); });
}

void ChunkQueries::readMany(std::span<const ChunkPos> positions, const store::ReadableRows::TakeRow& take) {
    for (std::size_t first = 0; first < positions.size(); first += kRowsAtOnce) {
        const auto group = positions.subspan(first, std::min(kRowsAtOnce, positions.size() - first));
        std::vector<std::int64_t> keys;
        for (const ChunkPos pos : group) keys.push_back(store::keyOf(pos));
        const auto rows = pool_.run<Rows>(
            [&](Connection& connection) { return connection.run(kReadMany, Parameters().numbers(keys)); });
        std::unordered_map<std::int64_t, int> rowOf;
        for (int row = 0; rows && row < rows->count(); ++row) rowOf[rows->number(row, 0)] = row;
        for (std::size_t k = 0; k < group.size(); ++k) {
            if (!rows) {
                take(first + k, tl::unexpected(rows.error()));
                continue;
            }
            const auto found = rowOf.find(keys[k]);
            if (found == rowOf.end())
                take(first + k, std::optional<StoredChunk>());
            else if (rows->isNull(found->second, 1))
                take(first + k, read(group[k]));
            else
                take(first + k, storedChunk(*rows, found->second, 1, group[k]));
        }
    }
}

base::Result<bool> ChunkQueries::contains(ChunkPos pos) {
    return pool_.run<bool>([&](Connection& connection) -> base::Result<bool> {
        const auto rows = TERRANE_TRY(connection.run(kContains, Parameters().number(store::keyOf(pos))));
        return rows.number(0, 0) != 0;
    });
}

base::Result<std::vector<ChunkPos>> ChunkQueries::editedChunks() {
    return pool_.run<std::vector<ChunkPos>>(
        [](Connection& connection) { return readEditedChunks(connection); });
}

}  // namespace terrane::store_postgres

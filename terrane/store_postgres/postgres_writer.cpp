#include "terrane/store_postgres/postgres_writer.h"

#include <algorithm>
#include <utility>

#include "terrane/base/profile.h"
#include "terrane/base/text.h"
#include "terrane/store/chunks/chunk_codec.h"
#include "terrane/store/chunks/chunk_key.h"
#include "terrane/store_postgres/postgres_rows.h"
#include "terrane/store_postgres/schema.h"
#include "terrane/store_postgres/world_locks.h"

namespace terrane::store_postgres {
namespace {

using store::ChunkRow;
using store::Provenance;
using store::QueuedChunks;
using store::StoredChunk;
using store::StoredRow;
using world::ChunkPos;

// Tiles are always replaced, since they are derived from the current chunks.
constexpr Statement kPutChunks = {
    "INSERT INTO chunks (key, origin, data, version) SELECT * FROM unnest($1::bigint[], $2::smallint[], "
    "$3::bytea[], $4::bigint[]) ON CONFLICT (key) DO UPDATE SET origin = excluded.origin, data = "
    "excluded.data, "
    "version = excluded.version WHERE (excluded.origin <> 0 OR chunks.origin = 0) AND "
    "(excluded.version >= chunks.version OR chunks.key >= 72057594037927936)"};
static_assert(store::kFirstTileKey == 72057594037927936);
constexpr Statement kNewer = {
    "SELECT key FROM chunks JOIN unnest($1::bigint[], $2::bigint[]) AS batch(k, v) ON key = k WHERE version "
    "> v"};
constexpr Statement kReplaceChunks = {
    "INSERT INTO chunks (key, origin, data) SELECT * FROM unnest($1::bigint[], $2::smallint[], $3::bytea[]) "
    "ON CONFLICT (key) DO UPDATE SET origin = excluded.origin, data = excluded.data"};
constexpr Statement kDeleteChunks = {"DELETE FROM chunks WHERE key = ANY ($1)"};
constexpr Statement kQuarantine = {
    "WITH gone AS (DELETE FROM chunks WHERE key = $1 RETURNING key, data) "
    "INSERT INTO quarantine (key, reason, data) SELECT key, $2, data FROM gone"};
constexpr Statement kDeleteTiles = {"DELETE FROM chunks WHERE key >= $1"};

// Bytes of data per statement, and rows checked together.
constexpr std::size_t kBytesAtOnce = 8 << 20, kKeysAtOnce = 64;

// PostgreSQL stores text in UTF-8 without zero bytes.
bool isText(std::string_view text) {
    return text.find('\0') == std::string_view::npos && base::isUtf8(text);
}

}  // namespace

PostgresWriter::~PostgresWriter() {
    releaseAllLocks(connection_);
}

template <class T, class Do>
base::Result<T> PostgresWriter::inTransaction(Do action) {
    auto done = pool_.retry<T>([&]() -> base::Result<T> {
        messages_.forget();
        if (!connection_.isUsable()) {
            auto connection = TERRANE_TRY(reconnect(pool_.address(), sharing_, contents_));
            connection_ = std::move(connection);
        }
        return store_postgres::inTransaction(connection_, action);
    });
    if (done) messages_.tell();
    return done;
}

base::Result<bool> PostgresWriter::write(const store::SaveBatch& batch, const store::ChunkPosSet& unread,
                                         const store::DeriveBatch& derive) {
    TERRANE_ZONE("save batch");
    return inTransaction<bool>([&] { return writeBatch(batch, unread, derive); });
}

base::Result<void> PostgresWriter::deriveAll(const store::DerivedRows& rows, std::string_view rules,
                                             store::EntityBudget& budget) {
    TERRANE_ZONE("derive all rows");
    return inTransaction<void>([&] { return deriveRows(rows, rules, budget); });
}

// Tiles are derived from chunks of several servers: the lock serializes this, so that each server sees the
// rows of the others.
base::Result<bool> PostgresWriter::writeBatch(const store::SaveBatch& batch, const store::ChunkPosSet& unread,
                                              const store::DeriveBatch& derive) {
    isComplete_ = true;
    if (!store::editedOf(batch.chunks).empty())
        TERRANE_TRY(lockForTransaction(connection_, pool_.address(), WorldLock::Tiles));
    auto chunks = TERRANE_TRY(newestChunks(batch));
    const auto derived = TERRANE_TRY(
        derive(store::editedOf(chunks), [this](ChunkPos pos) { return readRow(connection_, pos); }));
    isComplete_ = derived.isComplete;
    for (const store::DamagedRow& row : batch.damaged) TERRANE_TRY(quarantine(row));
    // A newer row of another server stays, even if it could not be read before.
    for (const ChunkPos pos : unread)
        if (chunks.contains(pos)) TERRANE_TRY(quarantineRow(pos, "could not be read when it was replaced"));
    TERRANE_TRY(writeChunks(chunks));
    TERRANE_TRY(writeDerived(derived.rows));
    store::Metadata metadata(batch.metadata.begin(), batch.metadata.end());
    TERRANE_TRY(writeMetadata(metadata));
    return isComplete_;
}

base::Result<void> PostgresWriter::deriveRows(const store::DerivedRows& rows, std::string_view rules,
                                              store::EntityBudget& budget) {
    isComplete_ = true;
    TERRANE_TRY(lockForTransaction(connection_, pool_.address(), WorldLock::Tiles));
    TERRANE_TRY(connection_.change(kDeleteTiles, Parameters().number(store::kFirstTileKey)));
    auto edited = TERRANE_TRY(readEditedChunks(connection_));
    store::SavedRows saved([this](ChunkPos pos) { return readRow(connection_, pos); }, contents_.ids,
                           contents_.identity.heights, budget);
    const auto write = [&](std::span<const ChunkRow> group) {
        return saved.result() ? writeDerived(group) : saved.result();
    };
    TERRANE_TRY(store::deriveInGroups(rows, std::move(edited), saved.reader(), write));
    if (!saved.result()) return saved.result();
    return connection_.change(kPutSetting, Parameters().text(store::kDerivedRowsMark).text(rules));
}

base::Result<void> PostgresWriter::change(const store::RowChanges& changes) {
    return inTransaction<void>([&] { return changeRows(changes); });
}

base::Result<void> PostgresWriter::changeRows(const store::RowChanges& changes) {
    isComplete_ = true;
    std::vector<std::int64_t> keys;
    std::vector<std::int16_t> origins;
    std::vector<store::Bytes> data;
    for (const store::KeyedRow& row : changes.rows) {
        keys.push_back(row.key);
        origins.push_back(row.row.provenance == Provenance::Edited ? 1 : 0);
        data.push_back(row.row.data);
    }
    const auto rows = Parameters().numbers(keys).smallNumbers(origins).byteStrings(data);
    TERRANE_TRY(connection_.change(kReplaceChunks, rows));
    if (!changes.deleted.empty()) {
        TERRANE_TRY(connection_.change(kDeleteChunks, Parameters().numbers(changes.deleted)));
    }
    return writeMetadata(changes.metadata);
}

base::Result<void> PostgresWriter::writeMetadata(const store::Metadata& metadata) {
    std::vector<Command> commands;
    for (const auto& [name, value] : metadata) {
        if (isText(name) && isText(value))
            commands.push_back({&kPutSetting, Parameters().text(name).text(value)});
        else
            messages_.error(fmt::format("{}: the setting {} is not a text in UTF-8, and is not saved",
                                        connection_.shown(), name.substr(0, 64)));
    }
    if (!isComplete_) commands.push_back({&kRemoveSetting, Parameters().text(store::kDerivedRowsMark)});
    return commands.empty() ? base::Result<void>() : connection_.changeAll(commands);
}

// The batch without chunks that are older than the row of another server.
base::Result<QueuedChunks> PostgresWriter::newestChunks(const store::SaveBatch& batch) {
    QueuedChunks chunks = batch.chunks;
    std::vector<std::int64_t> keys, versions;
    for (const ChunkRow& row : store::editedOf(chunks)) {
        keys.push_back(store::keyOf(row.pos));
        versions.push_back(chunks.at(row.pos).version);
    }
    if (keys.empty()) return chunks;
    const auto newer = TERRANE_TRY(connection_.run(kNewer, Parameters().numbers(keys).numbers(versions)));
    for (int row = 0; row < newer.count(); ++row) chunks.erase(store::posOf(newer.number(row, 0)));
    return chunks;
}

// Writes rows in key order, so that two writers cannot deadlock.
base::Result<void> PostgresWriter::writeChunks(const QueuedChunks& chunks) {
    std::vector<std::int64_t> keys, versions;
    for (const auto& [pos, chunk] : chunks) keys.push_back(store::keyOf(pos));
    TERRANE_TRY(quarantineDamaged(keys));
    keys.clear();
    std::vector<std::int16_t> origins;
    std::vector<store::Bytes> data;
    std::size_t bytes = 0;
    const auto put = [&]() -> base::Result<void> {
        auto done = connection_.change(
            kPutChunks, Parameters().numbers(keys).smallNumbers(origins).byteStrings(data).numbers(versions));
        keys.clear();
        versions.clear();
        origins.clear();
        data.clear();
        bytes = 0;
        return done;
    };
    for (const auto& [pos, chunk] : chunks) {
        const bool isEdited = chunk.provenance == Provenance::Edited;
        auto encoded = store::encodeChunk(*chunk.chunk, contents_.ids, store::checksumSeed(pos, isEdited));
        if (!encoded) {
            messages_.error(fmt::format("{}: {}: {}; it is not saved", connection_.shown(),
                                        store::nameOf(pos), encoded.error().message));
            isComplete_ = false;
            continue;
        }
        keys.push_back(store::keyOf(pos));
        versions.push_back(chunk.version);
        origins.push_back(isEdited ? 1 : 0);
        bytes += encoded->size();
        data.push_back(std::move(*encoded));
        if (bytes < kBytesAtOnce) continue;
        TERRANE_TRY(put());
    }
    return keys.empty() ? base::Result<void>() : put();
}

base::Result<void> PostgresWriter::writeDerived(std::span<const ChunkRow> rows) {
    QueuedChunks written;
    std::vector<std::int64_t> deleted;
    for (const ChunkRow& row : rows) {
        if (row.chunk)
            written.insert({row.pos, {row.chunk, Provenance::Edited}});
        else
            deleted.push_back(store::keyOf(row.pos));
    }
    if (auto done = writeChunks(written); !done || deleted.empty()) return done;
    return connection_.change(kDeleteChunks, Parameters().numbers(deleted));
}

base::Result<void> PostgresWriter::quarantineRow(ChunkPos pos, std::string_view reason) {
    isComplete_ = false;
    const std::string_view text = isText(reason) ? reason : "damaged";
    return connection_.change(kQuarantine, Parameters().number(store::keyOf(pos)).text(text));
}

base::Result<void> PostgresWriter::quarantine(const store::DamagedRow& row) {
    isComplete_ = false;
    const StoredRow there = readRow(connection_, row.pos);
    if (!there) return tl::unexpected(there.error());
    if (!*there || store::hashOfRow((*there)->data) != row.hash) return {};
    return quarantineRow(row.pos, row.reason);
}

namespace {

std::string problemOf(const StoredChunk& row, world::Heights heights) {
    if (!row.problem.empty()) return row.problem;
    const auto good = store::verifyChunk(row.data, heights, row.seed);
    return good ? std::string() : good.error().message;
}

// Why a row from readRows() is no valid chunk; empty: it is. readRows() leaves out long data, so such a row
// is read again.
base::Result<std::string> problemOf(Connection& connection, ChunkPos pos, const StoredChunk& row,
                                    world::Heights heights) {
    if (row.problem.empty()) return problemOf(row, heights);
    const StoredRow whole = readRow(connection, pos);
    if (!whole) return tl::unexpected(whole.error());
    return *whole ? problemOf(**whole, heights) : std::string();
}

}  // namespace

// Checks rows before they are overwritten: damaged ones are quarantined even if nobody tried to load them.
base::Result<void> PostgresWriter::quarantineDamaged(std::span<const std::int64_t> keys) {
    for (; !keys.empty(); keys = keys.subspan(std::min(kKeysAtOnce, keys.size()))) {
        const auto rows = TERRANE_TRY(readRows(connection_, keys.first(std::min(kKeysAtOnce, keys.size()))));
        for (const store::KeyedRow& row : rows) {
            const ChunkPos pos = store::posOf(row.key);
            const auto problem =
                TERRANE_TRY(problemOf(connection_, pos, row.row, contents_.identity.heights));
            if (problem.empty()) continue;
            messages_.warn(fmt::format("{}: {}: {}; its old data is kept in the table quarantine",
                                       connection_.shown(), store::nameOf(pos), problem));
            TERRANE_TRY(quarantineRow(pos, problem));
        }
    }
    return {};
}

}  // namespace terrane::store_postgres

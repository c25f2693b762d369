#include "terrane/store_postgres/world_database.h"

#include <algorithm>
#include <set>
#include <utility>

#include "terrane/base/log.h"
#include "terrane/store/chunks/chunk_key.h"
#include "terrane/store/derived_rows.h"
#include "terrane/store_postgres/schema.h"
#include "terrane/store_postgres/world_locks.h"

namespace terrane::store_postgres {
namespace {

using base::ErrorCode;
using store::Provenance;
using store::Regenerate;
using store::SavedName;
using store::WorldSharing;

constexpr const char* kBeginSnapshot = "BEGIN TRANSACTION ISOLATION LEVEL REPEATABLE READ READ ONLY";
constexpr Statement kCanWrite = {
    "SELECT has_table_privilege('chunks', 'INSERT') AND has_table_privilege('chunks', 'UPDATE') "
    "AND has_table_privilege('settings', 'INSERT'), current_setting('transaction_read_only') = 'on'"};
constexpr Statement kSetFormat = {"UPDATE terrane_format SET format = $1"};
constexpr Statement kSettings = {"SELECT name, value FROM settings"};
constexpr Statement kHistory = {"SELECT newest, newest - saved, openings FROM history"};
constexpr Statement kRaiseOpenings = {"UPDATE history SET openings = openings + 1 RETURNING openings"};
constexpr Statement kBlocks = {"SELECT id, name FROM blocks ORDER BY id"};
constexpr Statement kAddBlocks = {
    "INSERT INTO blocks (id, name) SELECT * FROM unnest($1::bigint[], $2::text[])"};
constexpr Statement kSchemaExists = {"SELECT count(*) FROM pg_namespace WHERE nspname = $1"};
constexpr Statement kDeleteGenerated = {"DELETE FROM chunks WHERE origin = 0 OR key >= $1"};
constexpr Statement kDeleteAllChunks = {"DELETE FROM chunks"};
// Finished jobs are deleted, so that the area can be requested again.
constexpr const char* kDeleteWork = "DELETE FROM jobs; DELETE FROM work_areas;";
constexpr Statement kDeleteQuarantine = {"DELETE FROM quarantine"};

base::Result<void> checkCanWrite(Connection& connection) {
    const auto rows = TERRANE_TRY(connection.run(kCanWrite));
    if (rows.number(0, 1) != 0)
        return base::fail(ErrorCode::Refused, "{}: the database is read-only, as a replica is",
                          connection.shown());
    if (rows.number(0, 0) != 0) return {};
    return base::fail(ErrorCode::Refused, "{}: this user may read the world, not write it",
                      connection.shown());
}

base::Result<void> addNames(Connection& connection, const std::vector<SavedName>& added) {
    std::vector<std::int64_t> numbers;
    std::vector<std::string> names;
    for (const SavedName& name : added) {
        numbers.push_back(name.id);
        names.push_back(name.name);
    }
    return connection.change(kAddBlocks, Parameters().numbers(numbers).texts(names));
}

// In one transaction, since a world without a seed would be damaged.
base::Result<void> createWorld(Connection& connection, const Address& address,
                               const store::SaveAccess& access) {
    TERRANE_TRY(migrateInTransaction(connection, address.schema, 0));
    std::vector<Command> commands{{&kSetFormat, Parameters().integer(formatFor(access.create->heights))}};
    for (const auto& [name, value] : store::metadataOf(*access.create))
        commands.push_back({&kPutSetting, Parameters().text(name).text(value)});
    TERRANE_TRY(connection.changeAll(commands));
    return addNames(connection, access.blockNames);
}

base::Result<void> makeCurrent(Connection& connection, const Address& address,
                               const store::SaveAccess& access, WorldContents& contents) {
    auto format = TERRANE_TRY(formatOf(connection));
    contents.format = std::max(format, newestFormat());
    if (format == 0) {
        if (!access.create) return base::fail(ErrorCode::NotFound, "{}: there is no world", address.shown);
        contents.isNew = true;
        contents.format = formatFor(access.create->heights);
        return doAlone(connection, address, [&] {
            return inTransaction(connection, [&] { return createWorld(connection, address, access); });
        });
    }
    if (format >= newestFormat()) return {};
    auto done = doAlone(connection, address, [&] { return migrate(connection, address.schema, format); });
    if (done) base::logInfo("{}: migrated from format {} to {}", address.shown, format, newestFormat());
    return done;
}

base::Result<store::Metadata> readMetadata(Connection& connection) {
    const auto rows = TERRANE_TRY(connection.run(kSettings));
    store::Metadata metadata;
    std::size_t bytes = 0;
    for (int row = 0; row < rows.count(); ++row) {
        bytes += rows.text(row, 0).size() + rows.text(row, 1).size();
        metadata.emplace(rows.text(row, 0), rows.text(row, 1));
    }
    if (bytes <= store::kMaxMetadataBytes && metadata.size() <= store::kMaxMetadata) return metadata;
    return base::fail(ErrorCode::Damaged, "{}: damaged: more than {} settings, or more than {} bytes of them",
                      connection.shown(), store::kMaxMetadata, store::kMaxMetadataBytes);
}

base::Result<std::vector<SavedName>> readBlockNames(Connection& connection) {
    const auto rows = TERRANE_TRY(connection.run(kBlocks));
    std::vector<SavedName> names;
    std::set<std::string_view> seen;
    for (int row = 0; row < rows.count(); ++row) {
        const std::int64_t id = rows.number(row, 0);
        const std::string_view name = rows.text(row, 1);
        if (id < 0 || id > 65535 || name.size() > store::kMaxNameBytes)
            return base::fail(ErrorCode::Damaged, "{}: damaged: the block {} has the id {}",
                              connection.shown(), name.substr(0, 64), id);
        if (!seen.insert(name).second || (!names.empty() && id == names.back().id))
            return base::fail(ErrorCode::Damaged, "{}: damaged: the block {} occurs twice",
                              connection.shown(), name);
        names.push_back({static_cast<world::BlockId>(id), std::string(name)});
    }
    return names;
}

base::Result<void> readContents(Connection& connection, const world::BlockRegistry& blocks,
                                WorldContents& contents) {
    TERRANE_TRY(checkColumns(connection));
    auto metadata = TERRANE_TRY(readMetadata(connection));
    auto identity = TERRANE_TRY(store::identityFrom(metadata, connection.shown()));
    TERRANE_TRY(
        store::requireFormat(contents.format, formatFor(identity.heights), identity, connection.shown()));
    const auto names = TERRANE_TRY(readBlockNames(connection));
    auto ids = store::BlockIdMap::make(blocks, names);
    if (!ids) return base::fail(ids.error().code, "{}: {}", connection.shown(), ids.error().message);
    contents.metadata = std::move(metadata);
    contents.identity = std::move(identity);
    contents.ids = std::move(*ids);
    return {};
}

void reportUnknown(const Connection& connection, const WorldContents& contents) {
    const std::vector<std::string>& names = contents.ids.unknown();
    if (names.empty()) return;
    base::logWarning("{}: {} block types are unknown here and shown as missing, the first is {}",
                     connection.shown(), names.size(), names.front());
}

// "terrane_backup_1", or the next unused number.
base::Result<std::string> freeSchema(Connection& connection, const Address& address) {
    // PostgreSQL truncates names to 63 bytes. Cut at a UTF-8 character boundary.
    std::size_t length = std::min<std::size_t>(address.schema.size(), 48);
    while (length < address.schema.size() && (address.schema[length] & 0xC0) == 0x80) --length;
    const std::string start = address.schema.substr(0, length);
    for (int number = 1;; ++number) {
        std::string name = fmt::format("{}_backup_{}", start, number);
        const auto found = TERRANE_TRY(connection.run(kSchemaExists, Parameters().text(name)));
        if (found.number(0, 0) == 0) return name;
    }
}

// SQL that copies settings, blocks and chunks into a separate world. Players and history are not copied.
std::string copySql(Connection& connection, const Address& address, const std::string& copy) {
    const std::string to = connection.quoted(copy), from = connection.quoted(address.schema);
    std::string sql = fmt::format("CREATE SCHEMA {0}; SET LOCAL search_path = {0};", to);
    for (const char* step : formatSteps()) sql += step;
    for (const char* table : {"terrane_format", "settings", "blocks"})
        sql += fmt::format("INSERT INTO {0}.{2} SELECT * FROM {1}.{2};", to, from, table);
    // Without versions: the copy has a new history.
    sql += fmt::format("INSERT INTO {0}.chunks SELECT key, origin, data FROM {1}.chunks;", to, from);
    sql += fmt::format(
        "INSERT INTO {0}.quarantine (key, reason, data) SELECT key, reason, data FROM "
        "{1}.quarantine ORDER BY number; SET LOCAL search_path = {1};",
        to, from);
    return sql;
}

// `copy`: empty for none.
base::Result<void> copyAndDelete(Connection& connection, const Address& address,
                                 const store::Regeneration& by, const std::string& copy) {
    if (!copy.empty()) TERRANE_TRY(connection.execute(copySql(connection, address, copy)));
    TERRANE_TRY(connection.execute(kDeleteWork));
    std::vector<Command> commands;
    if (by.chunks == Regenerate::All) {
        commands.push_back({&kDeleteAllChunks});
        commands.push_back({&kDeleteQuarantine});
    } else {
        commands.push_back({&kDeleteGenerated, Parameters().number(store::kFirstTileKey)});
    }
    commands.push_back({&kRemoveSetting, Parameters().text(store::kDerivedRowsMark)});
    commands.push_back(
        {&kPutSetting, Parameters().text("generator_version").text(std::to_string(by.generatorVersion))});
    return connection.changeAll(commands);
}

base::Result<void> regenerate(Connection& connection, const Address& address, const store::Regeneration& by) {
    const auto copy = TERRANE_TRY(by.keepsBackup ? freeSchema(connection, address) : std::string());
    TERRANE_TRY(inTransaction(connection, [&] { return copyAndDelete(connection, address, by, copy); }));
    base::logInfo("{}: regenerated{}{}{}", address.shown,
                  by.chunks == Regenerate::All ? "" : " except for chunks with edits",
                  by.keepsBackup ? "; the old world is the schema " : "", copy);
    return {};
}

base::Result<void> raiseOpenings(Connection& connection, WorldContents& contents) {
    const auto raised = TERRANE_TRY(connection.run(kRaiseOpenings));
    contents.openings = raised.number(0, 0);
    return {};
}

base::Result<void> regenerateIfAsked(Connection& connection, const Address& address,
                                     const world::BlockRegistry& blocks, const store::SaveAccess& access,
                                     WorldContents& contents) {
    if (contents.isNew || !access.decide) return {};
    const auto by = TERRANE_TRY(access.decide(contents.identity));
    if (by.chunks == Regenerate::None) return {};
    TERRANE_TRY(doAlone(connection, address, [&] { return regenerate(connection, address, by); }));
    TERRANE_TRY(raiseOpenings(connection, contents));
    return readContents(connection, blocks, contents);
}

// Edits of killed servers that are only in the history can only be saved by a server.
base::Result<void> readHistory(Connection& connection, WorldSharing sharing, WorldContents& contents) {
    const auto history = TERRANE_TRY(connection.run(kHistory));
    if (history.count() != 1)
        return base::fail(ErrorCode::Damaged, "{}: damaged: the table history does not have exactly one row",
                          connection.shown());
    contents.newestEdit = history.number(0, 0);
    contents.openings = history.number(0, 2);
    if (sharing != WorldSharing::Alone || history.number(0, 1) == 0) return {};
    return base::fail(ErrorCode::Incompatible,
                      "{}: a server was killed, and its last edits are in the history alone: start and stop "
                      "`terrane serve` on this world once",
                      connection.shown());
}

base::Result<void> openContents(Connection& connection, const Address& address,
                                const world::BlockRegistry& blocks, const store::SaveAccess& access,
                                WorldSharing sharing, WorldContents& contents) {
    TERRANE_TRY(makeCurrent(connection, address, access, contents));
    TERRANE_TRY(readContents(connection, blocks, contents));
    TERRANE_TRY(checkCanWrite(connection));
    TERRANE_TRY(readHistory(connection, sharing, contents));
    TERRANE_TRY(regenerateIfAsked(connection, address, blocks, access, contents));
    if (sharing == WorldSharing::Alone) TERRANE_TRY(raiseOpenings(connection, contents));
    const std::vector<SavedName>& added = contents.ids.added();
    if (added.empty()) return {};
    return doAlone(connection, address, [&] { return addNames(connection, added); });
}

base::Result<void> lockAndOpen(WorldConnection& opened, const Address& address,
                               const world::BlockRegistry& blocks, const store::SaveAccess& access,
                               WorldSharing sharing) {
    Connection& connection = opened.connection;
    TERRANE_TRY(waitForOpening(connection, address));
    TERRANE_TRY(takeSharedLocks(connection, address, sharing));
    auto done = openContents(connection, address, blocks, access, sharing, opened.contents);
    return done ? releaseLock(connection, address, WorldLock::Opening) : done;
}

}  // namespace

base::Result<WorldConnection> openToWrite(const Address& address, const world::BlockRegistry& blocks,
                                          const store::SaveAccess& access, WorldSharing sharing) {
    auto connection = TERRANE_TRY(Connection::open(address));
    WorldConnection opened{std::move(connection), {}};
    if (auto done = lockAndOpen(opened, address, blocks, access, sharing); !done) {
        releaseAllLocks(opened.connection);
        return tl::unexpected(done.error());
    }
    reportUnknown(opened.connection, opened.contents);
    return opened;
}

base::Result<WorldConnection> openToRead(const Address& address, const world::BlockRegistry& blocks,
                                         ReadAs readAs) {
    auto connection = TERRANE_TRY(Connection::open(address));
    if (readAs == ReadAs::Snapshot) TERRANE_TRY(connection.execute(kBeginSnapshot));
    const auto format = TERRANE_TRY(formatOf(connection));
    if (format == 0) return base::fail(ErrorCode::NotFound, "{}: there is no world", address.shown);
    if (format < newestFormat())
        return base::fail(ErrorCode::Incompatible,
                          "{}: in format {}; it is migrated to format {} when it is opened for writing",
                          address.shown, format, newestFormat());
    WorldConnection opened{std::move(connection), {}};
    opened.contents.format = format;
    TERRANE_TRY(readContents(opened.connection, blocks, opened.contents));
    reportUnknown(opened.connection, opened.contents);
    return opened;
}

base::Result<store::Metadata> readDatabaseMetadata(const Address& address) {
    auto connection = TERRANE_TRY(Connection::open(address));
    const auto format = TERRANE_TRY(formatOf(connection));
    if (format == 0) return base::fail(ErrorCode::NotFound, "{}: there is no world", address.shown);
    return readMetadata(connection);
}

base::Result<std::int64_t> readOpenings(Connection& connection) {
    const auto history = TERRANE_TRY(connection.run(kHistory));
    return history.count() == 1 ? history.number(0, 2) : -1;
}

base::Result<Connection> reconnect(const Address& address, WorldSharing sharing,
                                   const WorldContents& contents) {
    auto connection = TERRANE_TRY(Connection::open(address));
    TERRANE_TRY(takeSharedLocks(connection, address, sharing));
    const auto metadata = TERRANE_TRY(readMetadata(connection));
    const auto saved = TERRANE_TRY(store::identityFrom(metadata, address.shown));
    TERRANE_TRY(store::requireSame(saved, contents.identity, address.shown));
    // A generating program replaces no rows of others, who may play meanwhile.
    if (sharing == WorldSharing::Generating) return connection;
    const auto openings = TERRANE_TRY(readOpenings(connection));
    if (openings == contents.openings) return connection;
    return base::fail(ErrorCode::Incompatible,
                      "{}: another program wrote the world while the connection was lost; unsaved changes do "
                      "not overwrite it",
                      address.shown);
}

}  // namespace terrane::store_postgres

#include "terrane/store/sqlite/schema.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <set>
#include <unordered_set>

#include "terrane/store/chunks/chunk_codec.h"
#include "terrane/store/chunks/chunk_key.h"
#include "terrane/store/sqlite/chunk_reader.h"
#include "terrane/store/sqlite/metadata_table.h"

namespace terrane::store {

namespace {

using base::ErrorCode;

base::Result<void> writeMetadata(Database& database, const Metadata& metadata) {
    TERRANE_TRY(writeChecksum(database, 0));
    auto table = TERRANE_TRY(MetadataTable::make(database));
    for (const auto& [name, value] : metadata) TERRANE_TRY(table.put(name, value));
    return {};
}

// Checks a name of a block or setting.
base::Result<void> checkName(const Database& database, const Statement& row, int column) {
    const bool isText = row.type(column) == ColumnType::Text;  // text() changes the type
    const std::string_view name = row.text(column);
    if (isText && name.size() <= kMaxNameBytes) return {};
    return base::fail(ErrorCode::Damaged, "{}: damaged: the name {} is not a text of at most {} bytes",
                      database.path(), name.substr(0, 64), kMaxNameBytes);
}

// The migrations from the save's format to `current`.
base::Result<std::vector<Migration>> findWay(Database& database, std::span<const Migration> steps,
                                             std::int64_t current) {
    const auto version = TERRANE_TRY(database.queryNumber("PRAGMA user_version"));
    std::vector<Migration> way;
    for (std::int64_t at = *version; at < current; ++at) {
        const auto step =
            std::find_if(steps.begin(), steps.end(), [&](const Migration& m) { return m.from == at; });
        if (step == steps.end())
            return base::fail(ErrorCode::Incompatible, "{}: unknown format {}", database.path(), at);
        way.push_back(*step);
    }
    return way;
}

base::Result<void> runSteps(Database& database, const std::vector<Migration>& way, std::int64_t current) {
    auto transaction = TERRANE_TRY(Transaction::begin(database));
    for (const Migration& step : way) {
        TERRANE_TRY(database.execute(step.sql));
        if (!step.run) continue;
        TERRANE_TRY(step.run(database));
    }
    TERRANE_TRY(database.execute(fmt::format("PRAGMA user_version = {}", current)));
    return transaction.commit();
}

}  // namespace

std::span<const Migration> migrations() {
    // 1 to 2: keys include a level. Keys of level 0 are unchanged; a program of format 1 must not take the
    // others for damage. 2 to 3: checksums cover more.
    static constexpr Migration kSteps[] = {{1, ""}, {2, "", addChecksums}};
    return kSteps;
}

base::Result<SaveKind> classify(Database& database, Formats current) {
    const auto tables = TERRANE_TRY(database.queryNumber("SELECT count(*) FROM sqlite_schema"));
    const auto application = TERRANE_TRY(database.queryNumber("PRAGMA application_id"));
    if (tables == 0 && application == 0) return SaveKind::Empty;
    if (application != kApplicationId)
        return base::fail(ErrorCode::Incompatible, "{}: a SQLite file of another program, not a save",
                          database.path());
    const auto version = TERRANE_TRY(database.queryNumber("PRAGMA user_version"));
    if (version > current.last)
        return base::fail(ErrorCode::Incompatible,
                          "{}: in format {}, this program reads up to format {}: use a newer version",
                          database.path(), *version, current.last);
    return version >= current.first ? SaveKind::Current : SaveKind::Old;
}

base::Result<void> createTables(Database& database, const WorldIdentity& identity) {
    auto transaction = TERRANE_TRY(Transaction::begin(database));
    const std::string marks = fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {};",
                                          kApplicationId, formatFor(identity.heights));
    TERRANE_TRY(database.execute(std::string(kTables) + marks));
    TERRANE_TRY(writeMetadata(database, metadataOf(identity)));
    return transaction.commit();
}

base::Result<void> migrate(Database& database, std::span<const Migration> steps, std::int64_t current,
                           const std::filesystem::path& backup) {
    const auto way = TERRANE_TRY(findWay(database, steps, current));
    TERRANE_TRY(database.backUpTo(backup));
    auto migrated = runSteps(database, way, current);
    if (!migrated) {
        // The save is unchanged: remove the copy, or each attempt would leave another one.
        std::error_code ignored;
        std::filesystem::remove(backup, ignored);
    }
    return migrated;
}

base::Result<std::vector<SavedName>> readBlockNames(Database& database) {
    std::vector<SavedName> names;
    std::unordered_set<std::string> seen;
    const auto take = [&](const Statement& row) -> base::Result<void> {
        const std::int64_t id = row.number(0);
        TERRANE_TRY(checkName(database, row, 1));
        std::string name(row.text(1));
        if (id < 0 || id > 65535)
            return base::fail(ErrorCode::Damaged,
                              "{}: damaged: the block {} has the id {}, expected 0 to 65535", database.path(),
                              name, id);
        if (!names.empty() && id <= names.back().id)
            return base::fail(ErrorCode::Damaged, "{}: damaged: the ids of blocks are out of order at {}",
                              database.path(), id);
        if (!seen.insert(name).second)
            return base::fail(ErrorCode::Damaged, "{}: damaged: the block {} has two ids", database.path(),
                              name);
        names.push_back({static_cast<world::BlockId>(id), std::move(name)});
        return {};
    };
    TERRANE_TRY(forEachRow(database, "SELECT id, name FROM blocks ORDER BY id", take));
    return names;
}

base::Result<Metadata> readMetadata(Database& database) {
    Metadata metadata;
    std::size_t totalBytes = 0;
    const auto take = [&](const Statement& row) -> base::Result<void> {
        TERRANE_TRY(checkName(database, row, 0));
        std::string name(row.text(0));
        if (row.type(1) != ColumnType::Text)
            return base::fail(ErrorCode::Damaged, "{}: damaged: the setting {} is not a text",
                              database.path(), name);
        std::string value(row.text(1));
        totalBytes += name.size() + value.size();
        if (totalBytes > kMaxMetadataBytes || metadata.size() == kMaxMetadata)
            return base::fail(ErrorCode::Damaged,
                              "{}: damaged: more than {} settings, or more than {} bytes of them",
                              database.path(), kMaxMetadata, kMaxMetadataBytes);
        if (!metadata.emplace(std::move(name), std::move(value)).second)
            return base::fail(ErrorCode::Damaged, "{}: damaged: a setting occurs twice", database.path());
        return {};
    };
    TERRANE_TRY(forEachRow(database, "SELECT name, value FROM settings", take));
    return metadata;
}

const char* const kTables = R"(
CREATE TABLE settings (name TEXT PRIMARY KEY NOT NULL, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE blocks (id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE);
CREATE TABLE chunks (key INTEGER PRIMARY KEY, origin INTEGER NOT NULL, data BLOB NOT NULL);
CREATE TABLE quarantine (number INTEGER PRIMARY KEY, key INTEGER NOT NULL, reason TEXT NOT NULL, data BLOB NOT NULL);
)";

namespace {

char lower(char c) {
    return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

std::string lowered(std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(), lower);
    return result;
}

bool isNameCharacter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

bool isBlank(char c) {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f';
}

// The length of the token at the start: a name or number, a quoted text, or another single character.
std::size_t tokenLength(std::string_view sql) {
    constexpr std::string_view kOpening = "\"'`[", kClosing = "\"'`]";
    if (const std::size_t quote = kOpening.find(sql.front()); quote != std::string_view::npos) {
        const std::size_t end = sql.find(kClosing[quote], 1);
        return end == std::string_view::npos ? sql.size() : end + 1;
    }
    const auto end = std::ranges::find_if_not(sql, isNameCharacter);
    return std::max<std::size_t>(static_cast<std::size_t>(end - sql.begin()), 1);
}

// Removes unnecessary quotes of a name. Texts in '' are unchanged.
std::string normalizedToken(std::string_view token) {
    const char quote = token.front();
    const bool isQuotedName = quote == '"' || quote == '`' || quote == '[';
    if (isQuotedName && token.size() > 2) {
        const std::string_view name = token.substr(1, token.size() - 2);
        if (std::ranges::all_of(name, isNameCharacter)) return lowered(name);
    }
    return isQuotedName || quote == '\'' ? std::string(token) : lowered(token);
}

struct SchemaObject {
    std::string type, name, table, sql;
};

// As stored by SQLite: UNIQUE is an index without SQL.
const std::array<SchemaObject, 5>& expectedObjects() {
    static const std::array<SchemaObject, 5> objects = [] {
        std::array<SchemaObject, 5> made = {{{"table", "settings", "settings", ""},
                                             {"table", "blocks", "blocks", ""},
                                             {"table", "chunks", "chunks", ""},
                                             {"table", "quarantine", "quarantine", ""},
                                             {"index", "sqlite_autoindex_blocks_1", "blocks", ""}}};
        std::string_view rest = kTables;
        for (std::size_t k = 0; k < 4; ++k) {
            const std::size_t end = rest.find(';');
            made[k].sql = normalizedSql(rest.substr(0, end));
            rest.remove_prefix(end + 1);
        }
        return made;
    }();
    return objects;
}

// Name of an object in messages, shortened.
std::string titleOf(std::string_view type, std::string_view name) {
    constexpr std::size_t kMaxShown = 64;
    return fmt::format("the {} \"{}\"{}", type, name.substr(0, kMaxShown),
                       name.size() > kMaxShown ? " …" : "");
}

class SchemaComparison {
  public:
    explicit SchemaComparison(const std::string& path) : path_(path) {}

    base::Result<void> add(const Statement& row) {
        const std::string type = lowered(row.text(0)), name = lowered(row.text(1));
        const auto& all = expectedObjects();
        const auto found =
            std::ranges::find_if(all, [&](const auto& o) { return o.type == type && o.name == name; });
        if (found == all.end())
            return base::fail(ErrorCode::Damaged, "{}: damaged: it has {}, which does not belong in a save",
                              path_, titleOf(row.text(0), row.text(1)));
        const bool isNew = roots_.insert(row.number(3)).second && seen_.insert(name).second;
        if (!isNew || lowered(row.text(2)) != found->table || normalizedSql(row.text(4)) != found->sql)
            return base::fail(ErrorCode::Damaged, "{}: damaged: {} is not that of a save", path_,
                              titleOf(type, name));
        return {};
    }

    base::Result<void> finish() const {
        for (const SchemaObject& object : expectedObjects())
            if (!seen_.contains(object.name))
                return base::fail(ErrorCode::Damaged, "{}: damaged: {} is missing", path_,
                                  titleOf(object.type, object.name));
        return {};
    }

  private:
    const std::string& path_;
    std::set<std::string> seen_;
    std::set<std::int64_t> roots_;  // root pages, all different
};

}  // namespace

std::string normalizedSql(std::string_view sql) {
    std::string result;
    while (!sql.empty()) {
        if (isBlank(sql.front())) {
            sql.remove_prefix(1);
            continue;
        }
        const std::size_t length = tokenLength(sql);
        if (!result.empty()) result += ' ';
        result += normalizedToken(sql.substr(0, length));
        sql.remove_prefix(length);
    }
    return result;
}

base::Result<void> checkSchema(Database& database) {
    SchemaComparison comparison(database.path());
    const auto compared =
        forEachRow(database, "SELECT type, name, tbl_name, rootpage, sql FROM sqlite_schema",
                   [&](const Statement& row) { return comparison.add(row); });
    return compared ? comparison.finish() : compared;
}

namespace {

struct Row {
    std::int64_t key = 0;
    Bytes data;  // empty: unchanged
};

// The first row at or after a key, with its new checksum. A row with a wrong checksum keeps it, so it is
// damaged in format 3, too.
base::Result<std::optional<Row>> nextRow(Statement& select, std::int64_t from) {
    const ResetGuard reset(select);
    select.bind(1, from);
    const auto isThere = TERRANE_TRY(select.step());
    if (!isThere) return std::optional<Row>();
    Row row;
    row.key = select.number(0);
    const bool isWhole = rowProblem(select, 2, 1).empty() && world::isInWorld(posOf(row.key));
    const ByteView data = select.blob(2);
    if (isWhole && verifyChunk(data, {}, kLegacySeed)) {
        row.data.assign(data.begin(), data.end());
        sealChunk(row.data, checksumSeed(posOf(row.key), select.number(1) != 0));
    }
    return std::optional(std::move(row));
}

// Iterates by key, not by one statement over all rows, since rows change meanwhile.
base::Result<void> sealChunks(Database& database) {
    auto select = TERRANE_TRY(
        database.prepare("SELECT key, origin, data FROM chunks WHERE key >= ?1 ORDER BY key LIMIT 1"));
    auto update = TERRANE_TRY(database.prepare("UPDATE chunks SET data = ?2 WHERE key = ?1"));
    std::int64_t next = std::numeric_limits<std::int64_t>::min();
    while (true) {
        const auto row = TERRANE_TRY(nextRow(select, next));
        if (!row) return {};
        if (!row->data.empty()) {
            update.bind(1, row->key);
            update.bind(2, ByteView(row->data));
            TERRANE_TRY(update.run());
        }
        if (row->key == std::numeric_limits<std::int64_t>::max()) return {};
        next = row->key + 1;
    }
}

}  // namespace

base::Result<void> addChecksums(Database& database) {
    TERRANE_TRY(sealChunks(database));
    const auto metadata = TERRANE_TRY(readMetadata(database));
    const auto names = TERRANE_TRY(readBlockNames(database));
    return writeChecksum(database, metadataChecksum(metadata, names));
}

}  // namespace terrane::store

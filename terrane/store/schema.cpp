#include "terrane/store/schema.h"

#include <algorithm>
#include <unordered_set>

#include "terrane/store/format_3.h"
#include "terrane/store/metadata_table.h"
#include "terrane/store/schema_check.h"

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

base::Result<SaveKind> classify(Database& database, std::int64_t current) {
    const auto tables = TERRANE_TRY(database.queryNumber("SELECT count(*) FROM sqlite_schema"));
    const auto application = TERRANE_TRY(database.queryNumber("PRAGMA application_id"));
    if (tables == 0 && application == 0) return SaveKind::Empty;
    if (application != kApplicationId)
        return base::fail(ErrorCode::Incompatible, "{}: a SQLite file of another program, not a save",
                          database.path());
    const auto version = TERRANE_TRY(database.queryNumber("PRAGMA user_version"));
    if (version > current)
        return base::fail(ErrorCode::Incompatible,
                          "{}: in format {}, this program reads up to format {}: use a newer version",
                          database.path(), *version, current);
    return version == current ? SaveKind::Current : SaveKind::Old;
}

base::Result<void> createTables(Database& database, const WorldIdentity& identity) {
    auto transaction = TERRANE_TRY(Transaction::begin(database));
    const std::string marks =
        fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {};", kApplicationId, kFormatVersion);
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

}  // namespace terrane::store

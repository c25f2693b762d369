#include "terrane/store/schema.h"

#include <algorithm>
#include <charconv>
#include <unordered_set>

namespace terrane::store {
namespace {

constexpr const char* kTables = R"(
CREATE TABLE settings (name TEXT PRIMARY KEY NOT NULL, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE blocks (id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE);
CREATE TABLE chunks (key INTEGER PRIMARY KEY, origin INTEGER NOT NULL, data BLOB NOT NULL);
CREATE TABLE quarantine (number INTEGER PRIMARY KEY, key INTEGER NOT NULL, reason TEXT NOT NULL, data BLOB NOT NULL);
)";

constexpr const char *kSeed = "seed", *kGenerator = "generator", *kGeneratorVersion = "generator_version";

base::Result<void> writeIdentity(Database& database, const WorldIdentity& identity) {
    auto insert = database.prepare("INSERT INTO settings (name, value) VALUES (?1, ?2)");
    if (!insert) return tl::unexpected(insert.error());
    const std::pair<const char*, std::string> values[] = {
        {kSeed, std::to_string(identity.seed)},
        {kGenerator, identity.generator},
        {kGeneratorVersion, std::to_string(identity.generatorVersion)}};
    for (const auto& [name, value] : values) {
        insert->bind(1, std::string_view(name));
        insert->bind(2, std::string_view(value));
        if (auto done = insert->run(); !done) return done;
    }
    return {};
}

template <class T>
base::Result<T> numberSetting(const std::map<std::string, std::string>& settings, const std::string& name,
                              const std::string& path) {
    const auto found = settings.find(name);
    if (found == settings.end()) return base::fail("{}: damaged: the setting {} is missing", path, name);
    T value{};
    const char* end = found->second.data() + found->second.size();
    const auto [next, error] = std::from_chars(found->second.data(), end, value);
    if (error != std::errc() || next != end)
        return base::fail("{}: damaged: the setting {} is \"{}\", expected a number", path, name,
                          found->second);
    return value;
}

// The SQL of each step from the save's format to `current`.
base::Result<std::vector<const char*>> findWay(Database& database, std::span<const Migration> steps,
                                               std::int64_t current) {
    const auto version = database.queryNumber("PRAGMA user_version");
    if (!version) return tl::unexpected(version.error());
    std::vector<const char*> way;
    for (std::int64_t at = **version; at < current; ++at) {
        const auto step =
            std::find_if(steps.begin(), steps.end(), [&](const Migration& m) { return m.from == at; });
        if (step == steps.end()) return base::fail("{}: in format {}, which is unknown", database.path(), at);
        way.push_back(step->sql);
    }
    return way;
}

base::Result<void> runSteps(Database& database, const std::vector<const char*>& way, std::int64_t current) {
    auto transaction = Transaction::begin(database);
    if (!transaction) return tl::unexpected(transaction.error());
    for (const char* sql : way)
        if (auto done = database.execute(sql); !done) return done;
    if (auto done = database.execute(fmt::format("PRAGMA user_version = {}", current)); !done) return done;
    return transaction->commit();
}

}  // namespace

std::span<const Migration> migrations() {
    return {};
}

base::Result<SaveKind> classify(Database& database, std::int64_t current) {
    const auto tables = database.queryNumber("SELECT count(*) FROM sqlite_schema");
    if (!tables) return tl::unexpected(tables.error());
    const auto application = database.queryNumber("PRAGMA application_id");
    if (!application) return tl::unexpected(application.error());
    if (*tables == 0 && *application == 0) return SaveKind::Empty;
    if (*application != kApplicationId)
        return base::fail("{}: a SQLite file of another program, not a save", database.path());
    const auto version = database.queryNumber("PRAGMA user_version");
    if (!version) return tl::unexpected(version.error());
    if (*version > current)
        return base::fail("{}: in format {}, this program reads up to format {}: use a newer version",
                          database.path(), **version, current);
    return *version == current ? SaveKind::Current : SaveKind::Old;
}

base::Result<void> createTables(Database& database, const WorldIdentity& identity) {
    auto transaction = Transaction::begin(database);
    if (!transaction) return tl::unexpected(transaction.error());
    const std::string marks =
        fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {};", kApplicationId, kFormatVersion);
    if (auto made = database.execute(kTables + marks); !made) return made;
    if (auto written = writeIdentity(database, identity); !written) return written;
    return transaction->commit();
}

base::Result<void> migrate(Database& database, std::span<const Migration> steps, std::int64_t current,
                           const std::filesystem::path& backup) {
    const auto way = findWay(database, steps, current);
    if (!way) return tl::unexpected(way.error());
    if (auto copied = database.backUpTo(backup); !copied) return copied;
    auto migrated = runSteps(database, *way, current);
    if (!migrated) {
        // The save is as it was. Each further attempt would leave one more copy of it.
        std::error_code ignored;
        std::filesystem::remove(backup, ignored);
    }
    return migrated;
}

base::Result<std::vector<SavedName>> readBlockNames(Database& database) {
    auto select = database.prepare("SELECT id, name FROM blocks ORDER BY id");
    if (!select) return tl::unexpected(select.error());
    std::vector<SavedName> names;
    std::unordered_set<std::string> seen;
    while (true) {
        const auto row = select->step();
        if (!row) return tl::unexpected(row.error());
        if (!*row) return names;
        const std::int64_t id = select->number(0);
        std::string name(select->text(1));
        if (id < 0 || id > 65535)
            return base::fail("{}: damaged: the block {} has the id {}, expected 0 to 65535", database.path(),
                              name, id);
        if (!seen.insert(name).second)
            return base::fail("{}: damaged: the block {} has two ids", database.path(), name);
        names.push_back({static_cast<world::BlockId>(id), std::move(name)});
    }
}

base::Result<std::map<std::string, std::string>> readSettings(Database& database) {
    auto select = database.prepare("SELECT name, value FROM settings");
    if (!select) return tl::unexpected(select.error());
    std::map<std::string, std::string> settings;
    while (true) {
        const auto row = select->step();
        if (!row) return tl::unexpected(row.error());
        if (!*row) return settings;
        settings.emplace(select->text(0), select->text(1));
    }
}

bool isIdentitySetting(std::string_view name) {
    return name == kSeed || name == kGenerator || name == kGeneratorVersion;
}

base::Result<WorldIdentity> identityFrom(const std::map<std::string, std::string>& settings,
                                         const std::string& path) {
    const auto seed = numberSetting<std::uint64_t>(settings, kSeed, path);
    if (!seed) return tl::unexpected(seed.error());
    const auto version = numberSetting<int>(settings, kGeneratorVersion, path);
    if (!version) return tl::unexpected(version.error());
    const auto generator = settings.find(kGenerator);
    if (generator == settings.end()) return base::fail("{}: damaged: the setting generator is missing", path);
    return WorldIdentity{*seed, generator->second, *version};
}

}  // namespace terrane::store

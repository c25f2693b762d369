#include "terrane/store/schema_check.h"

#include <algorithm>
#include <array>
#include <set>

namespace terrane::store {

const char* const kTables = R"(
CREATE TABLE settings (name TEXT PRIMARY KEY NOT NULL, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE blocks (id INTEGER PRIMARY KEY, name TEXT NOT NULL UNIQUE);
CREATE TABLE chunks (key INTEGER PRIMARY KEY, origin INTEGER NOT NULL, data BLOB NOT NULL);
CREATE TABLE quarantine (number INTEGER PRIMARY KEY, key INTEGER NOT NULL, reason TEXT NOT NULL, data BLOB NOT NULL);
)";

namespace {

using base::ErrorCode;

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

}  // namespace terrane::store

#include "terrane/store/saves/server_file.h"

#include <fmt/format.h>

#include <string>
#include <system_error>

namespace terrane::store {
namespace {

base::Result<std::int64_t> numberOr0(Database& database, const std::string& sql) {
    const auto number = TERRANE_TRY(database.queryNumber(sql));
    return number.value_or(0);
}

}  // namespace

std::filesystem::path serverFilePath(const std::filesystem::path& world) {
    std::filesystem::path path = world;
    return path.replace_extension(".server.sqlite");
}

base::Result<HistoryEnds> historyEnds(Database& serverFile) {
    HistoryEnds ends;
    ends.newest = TERRANE_TRY(numberOr0(serverFile, "SELECT max(number) FROM edits"));
    ends.saved = TERRANE_TRY(
        numberOr0(serverFile, fmt::format("SELECT value FROM state WHERE name = '{}'", kSavedEdit)));
    return ends;
}

base::Result<HistoryEnds> readHistoryEnds(const std::filesystem::path& serverFile) {
    auto database = TERRANE_TRY(Database::open(serverFile, OpenMode::ReadOnly));
    return historyEnds(database);
}

base::Result<void> requireSavedHistory(const std::filesystem::path& world) {
    const std::filesystem::path serverFile = serverFilePath(world);
    std::error_code ignored;
    if (!std::filesystem::exists(serverFile, ignored)) return {};
    const auto ends = readHistoryEnds(serverFile);
    if (!ends || ends->saved >= ends->newest) return {};
    return base::fail(base::ErrorCode::Incompatible,
                      "{}: a server was killed, and its last edits are in the history alone: start and stop "
                      "`terrane serve` on this world once",
                      world.string());
}

}  // namespace terrane::store

#include "terrane/store/world_files.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <system_error>

#include "terrane/store/companion_files.h"
#include "terrane/store/sqlite.h"

namespace terrane::store {
namespace {

using base::ErrorCode;
namespace fs = std::filesystem;

// Beside a world: what a server knows of its players, and the map's cache. Both belong to this world alone.
constexpr std::array kDatabasesBeside{".server.sqlite", ".map.sqlite"};
// A server's key and settings, which stay when the world is deleted.
constexpr std::array kFilesBeside{".server.pem", ".server.toml"};

fs::path withEnding(const fs::path& save, const char* ending) {
    return fs::path(save).replace_extension(ending);
}

base::Result<void> move(const fs::path& from, const fs::path& to) {
    std::error_code error;
    fs::rename(from, to, error);
    if (!error) return {};
    return base::fail(ErrorCode::Io, "{}: cannot be renamed: {}", from.string(), error.message());
}

base::Result<void> checkAbsent(const fs::path& file) {
    if (!isPresent(file)) return {};
    return base::fail(ErrorCode::BadInput, "{}: left by another world, delete it first", file.string());
}

}  // namespace

bool belongsToAWorld(const fs::path& path) {
    const std::string name = path.filename().string();
    return std::ranges::any_of(kDatabasesBeside, [&](std::string_view ending) {
        return name.ends_with(ending) &&
               isPresent(path.parent_path() / (name.substr(0, name.size() - ending.size()) + ".sqlite"));
    });
}

base::Result<void> checkFree(const fs::path& path) {
    if (isPresent(path))
        return base::fail(ErrorCode::BadInput, "there is a world \"{}\" already", path.stem().string());
    for (const char* ending : {"-wal", "-journal"}) TERRANE_TRY(checkAbsent(beside(path, ending)));
    for (const char* ending : kDatabasesBeside) TERRANE_TRY(checkAbsent(withEnding(path, ending)));
    return {};
}

std::vector<fs::path> databasesOf(const fs::path& world) {
    std::vector<fs::path> databases{world};
    for (const char* ending : kDatabasesBeside)
        if (isPresent(withEnding(world, ending))) databases.push_back(withEnding(world, ending));
    return databases;
}

base::Result<std::vector<FileLock>> lockAll(const std::vector<fs::path>& files) {
    std::vector<FileLock> locks;
    for (const fs::path& file : files) {
        auto lock = TERRANE_TRY(FileLock::acquire(file, FileLock::Kind::Exclusive));
        locks.push_back(std::move(lock));
    }
    return locks;
}

base::Result<void> endLog(const fs::path& path) {
    TERRANE_TRY(checkCompanions(path));
    if (!hasLog(path) && !hasJournal(path)) return {};
    auto database = TERRANE_TRY(Database::open(path, OpenMode::ReadWrite));
    TERRANE_TRY(database.execute("PRAGMA wal_checkpoint(TRUNCATE)"));
    if (!hasLog(path)) return {};
    return base::fail(ErrorCode::Busy, "{}: its log is in use", path.string());
}

base::Result<Moves> movesOf(const fs::path& from, const fs::path& to) {
    Moves moves{{from, to}};
    for (const char* ending : kDatabasesBeside)
        if (isPresent(withEnding(from, ending)))
            moves.emplace_back(withEnding(from, ending), withEnding(to, ending));
    for (const char* ending : kFilesBeside) {
        if (!isPresent(withEnding(from, ending))) continue;
        TERRANE_TRY(checkAbsent(withEnding(to, ending)));
        moves.emplace_back(withEnding(from, ending), withEnding(to, ending));
    }
    return moves;
}

base::Result<void> moveAll(const Moves& moves) {
    for (std::size_t k = 0; k < moves.size(); ++k) {
        auto moved = move(moves[k].first, moves[k].second);
        if (moved) continue;
        std::error_code ignored;
        while (k-- > 0) fs::rename(moves[k].second, moves[k].first, ignored);
        return moved;
    }
    return {};
}

base::Result<void> removeFile(const fs::path& file) {
    std::error_code error;
    fs::remove(file, error);
    if (error) return base::fail(ErrorCode::Io, "{}: cannot be deleted: {}", file.string(), error.message());
    return {};
}

// Its file goes last: a log without its database would be applied to the next one of that name.
base::Result<void> removeDatabase(const fs::path& file) {
    for (const char* ending : {"-wal", "-shm", "-journal", ""}) TERRANE_TRY(removeFile(beside(file, ending)));
    return {};
}

}  // namespace terrane::store

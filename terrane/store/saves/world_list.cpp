#include "terrane/store/saves/world_list.h"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <system_error>

#include "terrane/base/log.h"
#include "terrane/store/saves/save_file.h"
#include "terrane/store/saves/save_path.h"
#include "terrane/store/sqlite/sqlite.h"

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
    for (const char* ending : {"-wal", "-journal"}) TERRANE_TRY(checkAbsent(companionPath(path, ending)));
    for (const char* ending : kDatabasesBeside) TERRANE_TRY(checkAbsent(withEnding(path, ending)));
    return {};
}

std::vector<fs::path> databasesOf(const fs::path& world) {
    std::vector<fs::path> databases{world};
    for (const char* ending : kDatabasesBeside)
        if (isPresent(withEnding(world, ending))) databases.push_back(withEnding(world, ending));
    return databases;
}

std::vector<fs::path> filesOf(const fs::path& world) {
    std::vector<fs::path> files, databases{world};
    for (const char* ending : kDatabasesBeside) databases.push_back(withEnding(world, ending));
    for (const fs::path& database : databases)
        for (const char* ending : {"", "-wal", "-shm", "-journal", "-lock"})
            files.push_back(companionPath(database, ending));
    for (const char* ending : kFilesBeside) files.push_back(withEnding(world, ending));
    return files;
}

base::Result<std::vector<FileLock>> lockAll(const std::vector<fs::path>& files) {
    std::vector<FileLock> locks;
    for (const fs::path& file : files) {
        auto lock = TERRANE_TRY(FileLock::acquire(file, FileLock::Kind::Exclusive));
        locks.push_back(std::move(lock));
    }
    return locks;
}

base::Result<void> checkpointLog(const fs::path& path) {
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
    for (const char* ending : {"-wal", "-shm", "-journal", ""})
        TERRANE_TRY(removeFile(companionPath(file, ending)));
    return {};
}

namespace {

constexpr std::string_view kSaveEnding = ".sqlite";

fs::file_time_type lastWritten(const fs::path& save) {
    fs::file_time_type last = fs::file_time_type::min();
    for (const char* ending : {"", "-wal"}) {
        std::error_code error;
        const auto time = fs::last_write_time(companionPath(save, ending), error);
        if (!error) last = std::max(last, time);
    }
    return last;
}

// The error without the path, which the entry has.
std::string reasonOf(const base::Error& error, const fs::path& path) {
    const std::string prefix = path.string() + ": ";
    return error.message.starts_with(prefix) ? error.message.substr(prefix.size()) : error.message;
}

WorldEntry entryOf(const fs::path& path, fs::file_time_type lastPlayed, const world::BlockRegistry& blocks) {
    WorldEntry entry;
    entry.name = path.stem().string();
    entry.path = path;
    entry.sizeBytes = bytesOnDisk({WorldLocation::Kind::File, path.string()});
    entry.lastPlayed = lastPlayed;
    auto file = openToRead(path, blocks);
    if (!file) {
        entry.problem = reasonOf(file.error(), path);
        return entry;
    }
    entry.identity = std::move(file->identity);
    entry.metadata = std::move(file->metadata);
    entry.inUse = std::move(file->inUse);
    return entry;
}

// The regular file of a world; links are neither renamed nor deleted.
base::Result<fs::path> ownFile(const fs::path& folder, std::string_view name) {
    TERRANE_TRY(checkSaveName(name));
    fs::path path = worldFile(folder, name);
    std::error_code ignored;
    const fs::file_status status = fs::symlink_status(path, ignored);
    if (!fs::exists(status) || belongsToAWorld(path))
        return base::fail(ErrorCode::NotFound, "there is no world \"{}\"", name);
    if (!fs::is_regular_file(status))
        return base::fail(ErrorCode::Incompatible, "{}: a link, or not a regular file; it is not opened",
                          path.string());
    return path;
}

// `former`: the world's name until now; empty for a world of its own.
base::Result<fs::path> newFile(const fs::path& folder, std::string_view name, std::string_view former) {
    TERRANE_TRY(checkNewWorld(folder, name, former));
    return worldFile(folder, name);
}

void moveThumbnail(const fs::path& from, const fs::path& to) {
    std::error_code ignored;  // a missing thumbnail is harmless
    fs::rename(thumbnailOf(from), thumbnailOf(to), ignored);
}

}  // namespace

base::Result<void> checkWorldName(std::string_view name) {
    TERRANE_TRY(checkNewName(name));
    if (name.ends_with(kSaveEnding) || name.back() == '.')
        return base::fail(ErrorCode::BadInput,
                          "{:?}: the name of a world ends with neither \".sqlite\" nor a dot", name);
    if (name.ends_with(".server") || name.ends_with(".map"))
        return base::fail(ErrorCode::BadInput,
                          "{:?}: the name of a world ends with neither \".server\" nor \".map\"", name);
    return {};
}

base::Result<void> checkNewWorld(const fs::path& folder, std::string_view name, std::string_view former) {
    TERRANE_TRY(checkWorldName(name));
    TERRANE_TRY(checkFree(worldFile(folder, name)));
    if (const std::string like = saveLike(folder, name, former); !like.empty())
        return base::fail(ErrorCode::BadInput, "\"{}\" looks like the name of the world \"{}\"", name, like);
    return {};
}

fs::path worldFile(const fs::path& folder, std::string_view name) {
    return folder / (std::string(name) + std::string(kSaveEnding));
}

fs::path thumbnailOf(const fs::path& save) {
    return fs::path(save).replace_extension(".png");
}

std::string unusedWorldName(const fs::path& folder, std::string_view name) {
    constexpr std::size_t kRoom = 88;  // of 100 bytes, the rest for a number
    std::size_t bytes = std::min(name.size(), kRoom);
    if (bytes < name.size())  // at a UTF-8 character boundary
        while (bytes > 0 && (static_cast<unsigned char>(name[bytes]) & 0xC0) == 0x80) --bytes;
    while (bytes > 0 && name[bytes - 1] == ' ') --bytes;
    const std::string stem(name.substr(0, bytes));
    for (int number = 1;; ++number) {
        std::string unused = number == 1 ? stem : fmt::format("{} {}", stem, number);
        if (checkFree(worldFile(folder, unused)) && saveLike(folder, unused).empty()) return unused;
    }
}

std::vector<WorldEntry> listWorlds(const fs::path& folder, const world::BlockRegistry& blocks) {
    struct Candidate {
        fs::file_time_type lastPlayed;
        fs::path path;
    };
    std::vector<Candidate> candidates;
    std::error_code error;
    fs::directory_iterator at(folder, fs::directory_options::skip_permission_denied, error);
    for (; !error && at != fs::directory_iterator(); at.increment(error)) {
        const fs::path& path = at->path();
        std::error_code ignored;
        if (path.extension() != kSaveEnding || belongsToAWorld(path) || at->is_directory(ignored)) continue;
        if (checkSaveName(path.stem().string())) candidates.push_back({lastWritten(path), path});
    }
    std::ranges::sort(candidates, [](const Candidate& a, const Candidate& b) {
        return a.lastPlayed != b.lastPlayed ? a.lastPlayed > b.lastPlayed : a.path < b.path;
    });
    if (candidates.size() > kMaxListedWorlds) {
        base::logWarning("{}: {} worlds; the {} that were played last are listed", folder.string(),
                         candidates.size(), kMaxListedWorlds);
        candidates.resize(kMaxListedWorlds);
    }
    std::vector<WorldEntry> worlds;
    for (const Candidate& candidate : candidates)
        worlds.push_back(entryOf(candidate.path, candidate.lastPlayed, blocks));
    return worlds;
}

base::Result<void> renameWorld(const fs::path& folder, std::string_view name, std::string_view newName) {
    const auto from = TERRANE_TRY(ownFile(folder, name));
    if (name == newName) return {};
    const auto to = TERRANE_TRY(newFile(folder, newName, name));
    const auto moves = TERRANE_TRY(movesOf(from, to));
    if (const std::string lost = lostLog(from); !lost.empty()) base::logWarning("{}", lost);
    const auto locks = TERRANE_TRY(lockAll(databasesOf(from)));
    const auto newLock = TERRANE_TRY(FileLock::acquire(to, FileLock::Kind::Exclusive));
    for (const fs::path& database : databasesOf(from)) TERRANE_TRY(checkpointLog(database));
    TERRANE_TRY(moveAll(moves));
    moveThumbnail(from, to);
    return {};
}

base::Result<void> deleteWorld(const fs::path& folder, std::string_view name) {
    const auto path = TERRANE_TRY(ownFile(folder, name));
    std::vector<fs::path> databases = databasesOf(path);
    const auto locks = TERRANE_TRY(lockAll(databases));
    TERRANE_TRY(removeFile(thumbnailOf(path)));
    // The world itself goes last.
    for (; !databases.empty(); databases.pop_back()) TERRANE_TRY(removeDatabase(databases.back()));
    return {};
}

base::Result<void> copySave(const fs::path& folder, const SaveCopy& copy, const world::BlockRegistry& blocks,
                            const CopyProgress& progress) {
    TERRANE_TRY(checkSaveName(copy.name));
    const fs::path from = worldFile(folder, copy.name);
    const auto to = TERRANE_TRY(newFile(folder, copy.newName, {}));
    const auto lock = TERRANE_TRY(FileLock::acquire(to, FileLock::Kind::Exclusive));
    auto source = TERRANE_TRY(openToRead(from, blocks));
    // Under another name until it is complete, so that no list shows a partial copy.
    const fs::path part = companionPath(to, ".part");
    std::error_code ignored;
    fs::remove(part, ignored);
    TERRANE_TRY(source.database.backUpTo(part, progress));
    if (auto moved = moveAll({{part, to}}); !moved) {
        fs::remove(part, ignored);
        return moved;
    }
    fs::copy_file(thumbnailOf(from), thumbnailOf(to), ignored);
    return {};
}

}  // namespace terrane::store

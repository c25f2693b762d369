#include "terrane/store/saves/backup_files.h"

#include <algorithm>
#include <system_error>
#include <utility>
#include <vector>

#include "terrane/base/platform.h"
#include "terrane/store/saves/save_file.h"
#include "terrane/store/saves/world_list.h"

namespace terrane::store {
namespace {

using base::ErrorCode;
namespace fs = std::filesystem;
namespace platform = base::platform;

fs::path folderOf(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

// Without links, dots and double slashes, whether the file exists or not.
fs::path plainPath(const fs::path& path) {
    std::error_code error;
    const fs::path absolute = fs::absolute(path, error);
    const fs::path canonical = fs::weakly_canonical(absolute, error);
    return error ? absolute.lexically_normal() : canonical;
}

base::Result<void> checkBackupName(const fs::path& target) {
    const std::string stem = target.stem().string();
    const bool isBeside = stem.ends_with(".server") || stem.ends_with(".map");
    if (target.extension() == ".sqlite" && !isBeside) return {};
    return base::fail(ErrorCode::BadInput, "{}: the file of a backup is NAME.sqlite, not {}", target.string(),
                      isBeside ? stem.substr(stem.rfind('.') + 1) + ".sqlite" : "another kind");
}

// The world's own file would be found as one that exists; its other files may be missing.
base::Result<void> checkIsOther(const fs::path& target, const fs::path& world) {
    if (world.empty()) return {};
    std::vector<fs::path> own;
    for (const fs::path& file : filesOf(world)) own.push_back(plainPath(file));
    for (const fs::path& file : filesOf(target))
        if (std::ranges::count(own, plainPath(file)) > 0)
            return base::fail(ErrorCode::BadInput, "{}: is a file of the world itself", file.string());
    return {};
}

void removePart(const fs::path& folder, const fs::path& target) {
    std::error_code ignored;
    for (const fs::path& file : filesOf(folder / target.filename())) fs::remove(file, ignored);
    fs::remove(folder, ignored);  // not if it has other files
}

}  // namespace

base::Result<void> checkBackup(const fs::path& target, const fs::path& world) {
    TERRANE_TRY(checkBackupName(target));
    std::error_code ignored;
    const fs::path folder = folderOf(target);
    if (!fs::is_directory(folder, ignored))
        return base::fail(ErrorCode::NotFound, "{}: there is no folder {}", target.string(), folder.string());
    TERRANE_TRY(checkIsOther(target, world));
    for (const fs::path& file : filesOf(target))
        if (file != companionPath(target, "-lock") && isPresent(file))
            return base::fail(ErrorCode::BadInput, "{}: exists; a backup replaces no file", file.string());
    if (platform::isWritableFolder(folder)) return {};
    return base::fail(ErrorCode::Io, "{}: nothing can be written in the folder {}", target.string(),
                      folder.string());
}

base::Result<BackupFiles> BackupFiles::create(const fs::path& target, const fs::path& world) {
    TERRANE_TRY(checkBackup(target, world));
    auto lock = TERRANE_TRY(FileLock::acquire(target, FileLock::Kind::Exclusive));
    fs::path folder = companionPath(target, ".part");
    // Of a backup that was killed, or somebody's own: it may even hold the world. Nothing there is deleted.
    if (isPresent(folder))
        return base::fail(ErrorCode::BadInput,
                          "{}: exists; if it is of a backup that was interrupted, delete it first",
                          folder.string());
    std::error_code error;
    fs::create_directory(folder, error);
    if (error) return base::fail(ErrorCode::Io, "{}: cannot be made: {}", folder.string(), error.message());
    return BackupFiles(target, std::move(folder), std::move(lock));
}

BackupFiles::~BackupFiles() {
    if (!folder_.empty()) removePart(folder_, target_);
}

BackupFiles::BackupFiles(BackupFiles&& other) noexcept
    : target_(std::move(other.target_)),
      folder_(std::exchange(other.folder_, fs::path())),
      lock_(std::exchange(other.lock_, std::nullopt)) {}

base::Result<void> BackupFiles::copyServerFiles(const fs::path& files) {
    for (const char* ending : {".server.pem", ".server.toml"}) {
        const fs::path from = files.string() + ending;
        std::error_code error;
        if (!fs::exists(from, error)) continue;
        fs::copy_file(from, save().replace_extension(ending), error);
        if (error)
            return base::fail(ErrorCode::Io, "{}: cannot be copied: {}", from.string(), error.message());
    }
    return {};
}

// The world's file comes last: without it the others are no world.
base::Result<void> BackupFiles::finish() {
    Moves moves;
    std::vector<fs::path> from = filesOf(save()), to = filesOf(target_);
    for (std::size_t k = from.size(); k-- > 0;)
        if (isPresent(from[k])) moves.emplace_back(from[k], to[k]);
    for (const auto& [part, place] : moves) {
        if (const int error = platform::flushFile(part); error != 0)
            return base::fail(ErrorCode::Io, "{}: cannot be written: {}", part.string(),
                              base::systemReason(error));
        if (isPresent(place))
            return base::fail(ErrorCode::BadInput, "{}: exists; a backup replaces no file", place.string());
    }
    TERRANE_TRY(moveAll(moves));
    (void)platform::flushFolder(folderOf(target_));
    return {};
}

}  // namespace terrane::store

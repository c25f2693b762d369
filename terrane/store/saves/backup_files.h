// The files of a backup: a world with its server's file, key and settings. They are written in a folder
// beside their place, FILE.part, and moved when all are complete. One thread at a time may use it.
#pragma once

#include <filesystem>
#include <optional>

#include "terrane/base/result.h"
#include "terrane/store/saves/file_lock.h"

namespace terrane::store {

// The reason why a backup of a world cannot have this file: its name, a folder that is missing or cannot be
// written, files that exist, or files that the world may have. `world`: its file; empty for a database.
[[nodiscard]] base::Result<void> checkBackup(const std::filesystem::path& target,
                                             const std::filesystem::path& world);

class BackupFiles {
  public:
    // Creates the folder, which may not exist: a killed program leaves one. See checkBackup(). Busy if
    // another backup writes the same file.
    [[nodiscard]] static base::Result<BackupFiles> create(const std::filesystem::path& target,
                                                          const std::filesystem::path& world);
    ~BackupFiles();  // deletes the folder with its files
    BackupFiles(BackupFiles&& other) noexcept;
    BackupFiles& operator=(BackupFiles&&) = delete;

    const std::filesystem::path& target() const { return target_; }
    // The world's file in the folder; others are beside it, as beside any world.
    std::filesystem::path save() const { return folder_ / target_.filename(); }
    // Copies a server's key and settings that exist: "a/home" has a/home.server.pem.
    [[nodiscard]] base::Result<void> copyServerFiles(const std::filesystem::path& files);
    // Waits until the files are on disk and moves all of them to their places, or none.
    [[nodiscard]] base::Result<void> finish();

  private:
    BackupFiles(std::filesystem::path target, std::filesystem::path folder, FileLock lock)
        : target_(std::move(target)), folder_(std::move(folder)), lock_(std::move(lock)) {}

    std::filesystem::path target_, folder_;  // no folder: moved from
    std::optional<FileLock> lock_;
};

}  // namespace terrane::store

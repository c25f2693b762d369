// Checks that the files of an open save are still at their paths: data written into a deleted or replaced
// file is lost. Used by the writing connection, on its thread.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <optional>

#include "terrane/base/result.h"

namespace terrane::store {

struct FileIdentity {
    dev_t device = 0;
    ino_t inode = 0;

    bool operator==(const FileIdentity&) const = default;
};

// No value if there is no such file.
std::optional<FileIdentity> identityOf(const std::filesystem::path& path);

// The identities of the save and its log at construction.
class OpenFiles {
  public:
    // `path`: an open save whose log exists.
    explicit OpenFiles(const std::filesystem::path& path);

    // NotFound, with advice, if a file was deleted, moved or replaced. Succeeds again once it is back.
    [[nodiscard]] base::Result<void> check() const;

  private:
    std::filesystem::path save_, log_;
    std::optional<FileIdentity> saveIdentity_, logIdentity_;
};

}  // namespace terrane::store

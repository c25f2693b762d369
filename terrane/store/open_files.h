// Whether the files of an open save are still the ones that its names lead to: what is written into a file
// that was deleted or replaced is lost. Used by the connection that writes, on its thread.
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

// Nothing where no file has this name.
std::optional<FileIdentity> identityOf(const std::filesystem::path& path);

// The save and its log, as they were when this was made.
class OpenFiles {
  public:
    // `path`: of a save that is open, whose log exists.
    explicit OpenFiles(const std::filesystem::path& path);

    // NotFound, with what to do, where a file was deleted, moved or replaced. Good again once it is back.
    [[nodiscard]] base::Result<void> check() const;

  private:
    std::filesystem::path save_, log_;
    std::optional<FileIdentity> saveIdentity_, logIdentity_;
};

}  // namespace terrane::store

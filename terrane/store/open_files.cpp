#include "terrane/store/open_files.h"

#include <sys/stat.h>

namespace terrane::store {
namespace {

base::Result<void> checkSame(const std::filesystem::path& path, const std::optional<FileIdentity>& opened) {
    const auto now = identityOf(path);
    if (now == opened) return {};
    return base::fail(base::ErrorCode::NotFound,
                      "{}: {} while it was open; nothing is written until the file that was open is back",
                      path.string(), now ? "replaced" : "deleted or moved");
}

}  // namespace

std::optional<FileIdentity> identityOf(const std::filesystem::path& path) {
    struct stat found {};
    if (::stat(path.c_str(), &found) != 0) return std::nullopt;
    return FileIdentity{found.st_dev, found.st_ino};
}

OpenFiles::OpenFiles(const std::filesystem::path& path)
    : save_(path),
      log_(path.string() + "-wal"),
      saveIdentity_(identityOf(save_)),
      logIdentity_(identityOf(log_)) {}

base::Result<void> OpenFiles::check() const {
    TERRANE_TRY(checkSame(save_, saveIdentity_));
    return checkSame(log_, logIdentity_);
}

}  // namespace terrane::store

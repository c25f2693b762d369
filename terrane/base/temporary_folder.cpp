#include "terrane/base/temporary_folder.h"

#include <cerrno>
#include <cstdlib>
#include <string>
#include <system_error>

namespace terrane::base {

Result<TemporaryFolder> TemporaryFolder::make(const std::filesystem::path& parent, std::string_view prefix) {
    std::string path = parent / (std::string(prefix) + "XXXXXX");
    if (::mkdtemp(path.data())) return TemporaryFolder(path);
    return fail("{}: no folder can be made in it: {}", parent.string(), systemReason(errno));
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    if (!path_.empty()) std::filesystem::remove_all(path_, ignored);
}

}  // namespace terrane::base

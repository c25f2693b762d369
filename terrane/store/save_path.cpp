#include "terrane/store/save_path.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>

namespace terrane::store {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxNameBytes = 100;  // file systems take 255, some of it for endings

std::string environment(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

base::Result<void> checkName(std::string_view name) {
    const auto isForbidden = [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return c == '/' || c == '\\' || byte < 0x20 || byte == 0x7F;
    };
    if (name.empty()) return base::fail(base::ErrorCode::BadInput, "\"\": the name of a save is empty");
    if (name.size() > kMaxNameBytes)
        return base::fail(base::ErrorCode::BadInput,
                          "{:?}: the name of a save has {} bytes, expected at most {}", name, name.size(),
                          kMaxNameBytes);
    if (std::any_of(name.begin(), name.end(), isForbidden))
        return base::fail(base::ErrorCode::BadInput,
                          "{:?}: the name of a save has neither slashes nor control characters", name);
    if (name.front() == '.' || name.front() == ' ')
        return base::fail(base::ErrorCode::BadInput,
                          "{:?}: the name of a save begins with neither a dot nor a space", name);
    return {};
}

}  // namespace

SavePlaces savePlaces() {
    std::error_code ignored;
    return {fs::read_symlink("/proc/self/exe", ignored), environment("XDG_DATA_HOME"), environment("HOME")};
}

base::Result<fs::path> savePath(std::string_view name, const SavePlaces& places) {
    if (auto good = checkName(name); !good) return tl::unexpected(good.error());
    const std::string file = std::string(name) + ".sqlite";
    std::error_code ignored;
    if (fs::exists(places.program.parent_path() / "CMakeCache.txt", ignored)) return fs::path("save") / file;
    // The specification has relative values ignored.
    if (fs::path(places.xdgDataHome).is_absolute()) return fs::path(places.xdgDataHome) / "terrane" / file;
    if (!places.home.empty()) return fs::path(places.home) / ".local/share/terrane" / file;
    return base::fail(base::ErrorCode::NotFound,
                      "{:?}: no place for saves: neither XDG_DATA_HOME nor HOME is set", name);
}

}  // namespace terrane::store

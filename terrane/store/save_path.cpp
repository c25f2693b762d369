#include "terrane/store/save_path.h"

#include <algorithm>
#include <cstdlib>
#include <system_error>

namespace terrane::store {
namespace {

namespace fs = std::filesystem;

std::string environment(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

}  // namespace

base::Result<void> checkSaveName(std::string_view name) {
    const auto isForbidden = [](char c) {
        const auto byte = static_cast<unsigned char>(c);
        return c == '/' || c == '\\' || byte < 0x20 || byte == 0x7F;
    };
    if (name.empty()) return base::fail(base::ErrorCode::BadInput, "\"\": the name of a save is empty");
    if (name.size() > kMaxSaveName)
        return base::fail(base::ErrorCode::BadInput,
                          "{:?}: the name of a save has {} bytes, expected at most {}", name, name.size(),
                          kMaxSaveName);
    if (std::any_of(name.begin(), name.end(), isForbidden))
        return base::fail(base::ErrorCode::BadInput,
                          "{:?}: the name of a save has neither slashes nor control characters", name);
    if (name.front() == '.' || name.front() == ' ')
        return base::fail(base::ErrorCode::BadInput,
                          "{:?}: the name of a save begins with neither a dot nor a space", name);
    return {};
}

SavePlaces savePlaces() {
    return {.xdgDataHome = environment("XDG_DATA_HOME"), .home = environment("HOME")};
}

base::Result<fs::path> dataFolder(const SavePlaces& places) {
    // The XDG specification says to ignore relative paths.
    if (fs::path(places.xdgDataHome).is_absolute()) return fs::path(places.xdgDataHome) / "terrane";
    if (fs::path(places.home).is_absolute()) return fs::path(places.home) / ".local/share/terrane";
    return base::fail(base::ErrorCode::NotFound,
                      "no folder for worlds: neither XDG_DATA_HOME nor HOME names an absolute path");
}

base::Result<fs::path> savePath(std::string_view name, const SavePlaces& places) {
    TERRANE_TRY(checkSaveName(name));
    const auto folder = dataFolder(places);
    if (!folder) return base::fail(folder.error().code, "{:?}: {}", name, folder.error().message);
    const std::string file = std::string(name) + ".sqlite";
    std::error_code ignored;
    const bool isFormer = !fs::exists(*folder / file, ignored) && fs::exists(places.former / file, ignored);
    return isFormer ? places.former / file : *folder / file;
}

}  // namespace terrane::store

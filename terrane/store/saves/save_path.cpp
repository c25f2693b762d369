#include "terrane/store/saves/save_path.h"

#include <algorithm>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "terrane/base/names.h"
#include "terrane/base/platform.h"

namespace terrane::store {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSchemeEnd = "://";

// Whether the text looks like a database URL, even a misspelled one: it may hold a password and must not
// become a file name.
bool isMeantAsDatabase(std::string_view text) {
    constexpr std::string_view kStart = "postgres";
    const auto isSame = [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; };
    return std::ranges::equal(text.substr(0, kStart.size()), kStart, isSame) &&
           text.find_first_of(":@") != std::string_view::npos;
}

}  // namespace

WorldLocation worldLocation(std::string text) {
    using Kind = WorldLocation::Kind;
    const bool isUrl = text.find(kSchemeEnd) != std::string::npos || isMeantAsDatabase(text);
    const bool isFile = fs::path(text).has_parent_path() || text.ends_with(".sqlite");
    return {isUrl ? Kind::Url : isFile ? Kind::File : Kind::Name, std::move(text)};
}

namespace {

// Files of a server, its lock and its log are named by the world's file. A symbolic link is not another world
// beside which they are missing.
std::filesystem::path behindLinks(const std::filesystem::path& path) {
    std::error_code error;
    if (!std::filesystem::is_symlink(path, error)) return path;
    std::filesystem::path target = std::filesystem::canonical(path, error);
    return error ? path : target;
}

}  // namespace

base::Result<std::filesystem::path> fileOf(const WorldLocation& location) {
    switch (location.kind) {
        case WorldLocation::Kind::Name:
            return behindLinks(TERRANE_TRY(savePath(location.text, saveEnvironment())));
        case WorldLocation::Kind::File:
            return behindLinks(location.text);
        case WorldLocation::Kind::Url:
            break;
    }
    // The rest of a URL may hold a password.
    const std::string scheme = location.text.substr(0, location.text.find_first_of(":/@"));
    return base::fail(
        base::ErrorCode::Unsupported,
        "{}…: no URL of a world; a database is postgresql://host/database, where the build has them", scheme);
}

std::uintmax_t bytesOnDisk(const WorldLocation& location) {
    const auto path = fileOf(location);
    std::uintmax_t bytes = 0;
    for (const char* ending : {"", "-wal"}) {
        std::error_code error;
        const std::uintmax_t size = path ? std::filesystem::file_size(path->string() + ending, error) : 0;
        if (!error) bytes += size;
    }
    return bytes;
}

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
    if (!base::platform::canBeFileName(name))
        return base::fail(base::ErrorCode::BadInput, "{:?}: the system has no files with such a name", name);
    if (name.front() == '.' || name.front() == ' ')
        return base::fail(base::ErrorCode::BadInput,
                          "{:?}: the name of a save begins with neither a dot nor a space", name);
    return {};
}

SaveEnvironment saveEnvironment() {
    return {.data = base::platform::userFolder(base::platform::UserFolder::Data)};
}

base::Result<fs::path> dataFolder(const SaveEnvironment& places) {
    if (!places.data.empty()) return places.data / "terrane";
    return base::fail(base::ErrorCode::NotFound, "no folder for worlds: set {} to an absolute path",
                      base::platform::dataFolderVariables());
}

base::Result<void> checkNewName(std::string_view name) {
    TERRANE_TRY(checkSaveName(name));
    const auto checked = base::checkName(name, kMaxSaveName);
    if (!checked) return base::fail(checked.error().code, "{:?}: {}", name, checked.error().message);
    if (*checked != name)
        return base::fail(base::ErrorCode::BadInput, "{:?}: a name is in Unicode's normal form NFC", name);
    return {};
}

std::string saveLike(const fs::path& folder, std::string_view name, std::string_view former) {
    std::vector<std::string> names;
    std::error_code error;
    fs::directory_iterator at(folder, fs::directory_options::skip_permission_denied, error);
    for (; !error && at != fs::directory_iterator(); at.increment(error))
        if (at->path().extension() == ".sqlite") names.push_back(at->path().stem().string());
    std::erase_if(names, [&](const std::string& other) { return other == name || other == former; });
    std::ranges::sort(names);
    return base::nameLike(name, names);
}

base::Result<fs::path> savePath(std::string_view typed, const SaveEnvironment& places) {
    TERRANE_TRY(checkSaveName(typed));
    const auto folder = dataFolder(places);
    if (!folder) return base::fail(folder.error().code, "{:?}: {}", typed, folder.error().message);
    const std::string name = base::normalizedName(typed);
    for (const std::string& one : {std::string(typed), name}) {
        const std::string file = one + ".sqlite";
        std::error_code ignored;
        if (fs::exists(*folder / file, ignored)) return *folder / file;
        if (fs::exists(places.legacyFolder / file, ignored)) return places.legacyFolder / file;
    }
    TERRANE_TRY(checkNewName(name));
    if (const std::string like = saveLike(*folder, name); !like.empty())
        return base::fail(
            base::ErrorCode::BadInput,
            "{:?}: there is no such world, and a new one cannot have a name that looks like {:?}", typed,
            like);
    return *folder / (name + ".sqlite");
}

}  // namespace terrane::store

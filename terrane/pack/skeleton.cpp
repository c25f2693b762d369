#include "terrane/pack/skeleton.h"

#include <string>
#include <system_error>

#include "terrane/base/files.h"
#include "terrane/content/built_in.h"
#include "terrane/pack/pack.h"

namespace terrane::pack {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kFolder = "skeleton/", kNamePlace = "PACK_NAME";
constexpr const char* kSubfolders[] = {"textures", "generators", "languages"};

std::string withName(std::string_view text, const std::string& name) {
    std::string result;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t found = text.find(kNamePlace, at);
        result += text.substr(at, found - at);
        if (found == text.npos) break;
        result += name;
        at = found + kNamePlace.size();
    }
    return result;
}

}  // namespace

base::Result<void> writeSkeleton(const fs::path& folder) {
    const std::string name = folder.filename().string();
    if (!isPackName(name))
        return base::fail(base::ErrorCode::BadInput,
                          "{}: a pack's name has 1 to {} characters of a-z, 0-9 and _", folder.string(),
                          kMaxPackName);
    std::error_code error;
    if (fs::exists(fs::symlink_status(folder, error)))
        return base::fail(base::ErrorCode::BadInput, "{}: exists already", folder.string());
    for (const char* inside : kSubfolders) {
        fs::create_directories(folder / inside, error);
        if (error) return base::fail("{}: cannot be made: {}", (folder / inside).string(), error.message());
    }
    for (const content::BuiltInFile& file : content::builtInFiles()) {
        if (!file.path.starts_with(kFolder)) continue;
        const fs::path path = folder / file.path.substr(kFolder.size());
        const bool isText = path.extension() != ".png";
        TERRANE_TRY(base::writeFile(path, isText ? withName(file.data, name) : std::string(file.data)));
    }
    return {};
}

}  // namespace terrane::pack

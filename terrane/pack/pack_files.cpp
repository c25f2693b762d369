#include "terrane/pack/pack_files.h"

#include <algorithm>
#include <system_error>

#include "terrane/base/files.h"
#include "terrane/pack/zip_file.h"

namespace terrane::pack {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxListedPacks = 1000;

base::Result<void> addFile(PackFiles& files, std::size_t& bytes, const fs::path& file, std::string path) {
    if (files.size() == kMaxFiles)
        return base::fail(base::ErrorCode::BadInput, "{}: more than {} files", file.parent_path().string(),
                          kMaxFiles);
    auto data = TERRANE_TRY(base::readFile(file, kMaxPackBytes - bytes));
    bytes += data.size();
    files.emplace(std::move(path), std::move(data));
    return {};
}

// Adds the files of one folder of a pack; `inside`: its path in the pack, "" or "textures/".
base::Result<void> addFolder(PackFiles& files, std::size_t& bytes, const fs::path& folder,
                             const std::string& inside) {
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        const std::string path = inside + it->path().filename().string();
        if (!isPackPath(path)) continue;
        TERRANE_TRY(addFile(files, bytes, it->path(), path));
    }
    if (error == std::errc::no_such_file_or_directory && !inside.empty()) return {};
    if (error)
        return base::fail("{}: cannot be read as a content pack: {}", folder.string(), error.message());
    return {};
}

base::Result<Pack> readFolder(const fs::path& folder) {
    PackFiles files;
    std::size_t bytes = 0;
    for (const char* inside : {"", "textures/", "generators/", "languages/"})
        TERRANE_TRY(addFolder(files, bytes, folder / inside, inside));
    return makePack(std::move(files), folder.string());
}

}  // namespace

base::Result<Pack> readPack(const fs::path& path) {
    std::error_code ignored;
    if (fs::is_directory(path, ignored)) return readFolder(path);
    auto files = TERRANE_TRY(readZip(path));
    return makePack(std::move(files), path.string());
}

base::Result<fs::path> findPack(std::string_view nameOrPath, std::span<const fs::path> folders) {
    std::error_code ignored;
    const fs::path given(nameOrPath);
    if (nameOrPath.find('/') != std::string_view::npos || nameOrPath.ends_with(".zip") ||
        !isPackName(nameOrPath)) {
        if (fs::exists(given, ignored)) return given;
        return base::fail(base::ErrorCode::NotFound, "there is no content pack \"{}\"", nameOrPath);
    }
    if (folders.empty())
        return base::fail(
            base::ErrorCode::NotFound,
            "there is no content pack \"{}\", as there is no folder of packs: set XDG_DATA_HOME or HOME",
            nameOrPath);
    std::string looked;
    for (const fs::path& folder : folders) {
        for (const std::string& name : {std::string(nameOrPath), std::string(nameOrPath) + ".zip"})
            if (fs::exists(folder / name, ignored)) return folder / name;
        looked += (looked.empty() ? "" : ", ") + folder.string();
    }
    return base::fail(base::ErrorCode::NotFound,
                      "there is no content pack \"{}\" in {}; a path has a slash: ./{}", nameOrPath, looked,
                      nameOrPath);
}

std::vector<fs::path> packsIn(const fs::path& folder) {
    std::vector<fs::path> packs;
    std::error_code error;
    std::size_t seen = 0;
    for (fs::directory_iterator it(folder, error), end; !error && it != end && seen < kMaxListedPacks;
         it.increment(error), ++seen) {
        const fs::path& path = it->path();
        const bool isPack = path.extension() == ".zip" || fs::exists(path / "pack.toml", error);
        if (isPack) packs.push_back(path);
    }
    std::ranges::sort(packs);
    return packs;
}

}  // namespace terrane::pack

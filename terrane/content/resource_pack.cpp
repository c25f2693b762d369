#include "terrane/content/resource_pack.h"

#include <algorithm>
#include <bit>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <system_error>
#include <vector>

#include "terrane/base/image.h"
#include "terrane/base/log.h"
#include "terrane/content/built_in.h"

namespace terrane::content {
namespace {

namespace fs = std::filesystem;

using Images = std::map<std::string, base::Image, std::less<>>;  // by the name of the texture

// A texture's name by its file: "stone", "isles:glow_rock".
struct TextureFile {
    std::string name;
    fs::path path;
};

void addPngFiles(std::vector<TextureFile>& files, const fs::path& folder, const std::string& prefix,
                 std::error_code& error) {
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        const fs::path& path = it->path();
        if (path.extension() == ".png") files.push_back({prefix + path.stem().string(), path});
    }
}

// `packs`: names of content packs, each with a folder of its own.
base::Result<std::vector<TextureFile>> pngFilesIn(const fs::path& folder,
                                                  const std::set<std::string>& packs) {
    std::vector<TextureFile> files;
    std::error_code error, ignored;
    addPngFiles(files, folder, {}, error);
    for (const std::string& pack : packs)
        if (!error && fs::is_directory(folder / pack, ignored))
            addPngFiles(files, folder / pack, pack + ":", error);
    if (error)
        return base::fail("{}: cannot be read as a resource pack: {}", folder.string(), error.message());
    std::ranges::sort(files, {}, &TextureFile::path);  // the order of a directory is unspecified
    return files;
}

base::Result<base::Image> readTexture(const fs::path& file) {
    auto image = TERRANE_TRY(base::readPng(file, std::int64_t{kMaxTextureSide} * kMaxTextureSide));
    TERRANE_TRY(checkTexture(image, file.string()));
    return image;
}

base::Result<Images> readPack(const fs::path& folder, std::span<const std::string> names) {
    std::set<std::string> packs;
    for (const std::string& name : names)
        if (const auto colon = name.find(':'); colon != name.npos) packs.insert(name.substr(0, colon));
    const auto files = TERRANE_TRY(pngFilesIn(folder, packs));
    Images images;
    std::vector<base::Error> errors;
    for (const auto& [name, file] : files) {
        if (std::ranges::find(names, name) == names.end()) {
            base::logWarning("{}: not used, since no texture has this name (see terrane blocks --json)",
                             file.string());
            continue;
        }
        auto image = readTexture(file);
        if (image) {
            images[name] = std::move(*image);
        } else {
            errors.push_back(image.error());
        }
    }
    if (errors.empty()) return images;
    for (std::size_t k = 0; k + 1 < errors.size(); ++k) base::logError("{}", errors[k].message);
    return tl::unexpected(errors.back());
}

}  // namespace

base::Result<void> checkTexture(const base::Image& image, const std::string& where) {
    if (image.width == image.height && std::has_single_bit(static_cast<unsigned>(image.width)) &&
        image.width <= kMaxTextureSide)
        return {};
    return base::fail(
        base::ErrorCode::BadInput,
        "{}: {} × {} pixels; a texture is square, its side a power of two from 1 to {} (there are no strips "
        "of frames)",
        where, image.width, image.height, kMaxTextureSide);
}

base::Result<world::TextureSource> loadTextures(const std::string& folder, const world::BlockRegistry& blocks,
                                                const world::TextureSource& otherwise) {
    if (folder.empty()) return otherwise;
    auto images = TERRANE_TRY(readPack(folder, blocks.textures()));
    for (const std::string& name : blocks.textures()) {
        if (images.contains(name)) continue;
        auto image = TERRANE_TRY(otherwise(name));
        images[name] = std::move(image);
    }
    const auto all = std::make_shared<const Images>(std::move(images));
    return [all](std::string_view name) -> base::Result<base::Image> {
        const auto found = all->find(name);
        if (found == all->end()) return base::fail("texture \"{}\": there is none", name);
        return found->second;
    };
}

}  // namespace terrane::content

#include "terrane/content/resource_pack.h"

#include <algorithm>
#include <bit>
#include <filesystem>
#include <map>
#include <memory>
#include <system_error>
#include <vector>

#include "terrane/base/image.h"
#include "terrane/base/log.h"
#include "terrane/content/built_in.h"

namespace terrane::content {
namespace {

namespace fs = std::filesystem;

using Images = std::map<std::string, base::Image, std::less<>>;  // by the name of the texture

base::Result<std::vector<fs::path>> pngFilesIn(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        if (it->path().extension() == ".png") files.push_back(it->path());
    }
    if (error)
        return base::fail("{}: cannot be read as a resource pack: {}", folder.string(), error.message());
    std::ranges::sort(files);  // the system gives them in any order
    return files;
}

base::Result<base::Image> readTexture(const fs::path& file) {
    auto image = base::readPng(file, std::int64_t{kMaxTextureSide} * kMaxTextureSide);
    if (!image) return image;
    if (image->width != image->height || !std::has_single_bit(static_cast<unsigned>(image->width)) ||
        image->width > kMaxTextureSide) {
        return base::fail(
            "{}: {} × {} pixels; a texture is square, its side a power of two from 1 to {} (there are no "
            "strips "
            "of frames)",
            file.string(), image->width, image->height, kMaxTextureSide);
    }
    return image;
}

base::Result<Images> readPack(const fs::path& folder, std::span<const std::string> names) {
    const auto files = pngFilesIn(folder);
    if (!files) return tl::unexpected(files.error());
    Images images;
    std::vector<base::Error> errors;
    for (const fs::path& file : *files) {
        const std::string name = file.stem().string();
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

base::Result<world::TextureSource> loadTextures(const std::string& folder,
                                                const world::BlockRegistry& blocks) {
    const world::TextureSource builtIn = builtInTextures();
    if (folder.empty()) return builtIn;
    auto images = readPack(folder, blocks.textures());
    if (!images) return tl::unexpected(images.error());
    for (const std::string& name : blocks.textures()) {
        if (images->contains(name)) continue;
        auto image = builtIn(name);
        if (!image) return tl::unexpected(image.error());
        (*images)[name] = std::move(*image);
    }
    const auto all = std::make_shared<const Images>(std::move(*images));
    return [all](std::string_view name) -> base::Result<base::Image> {
        const auto found = all->find(name);
        if (found == all->end()) return base::fail("texture \"{}\": there is none", name);
        return found->second;
    };
}

}  // namespace terrane::content

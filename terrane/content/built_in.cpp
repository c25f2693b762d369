#include "terrane/content/built_in.h"

#include <optional>

#include "terrane/base/embedded.h"
#include "terrane/content/content_files_internal.h"

namespace terrane::embedded {
std::span<const base::EmbeddedFile> content();
}  // namespace terrane::embedded

namespace terrane::content {

std::optional<std::string_view> findContent(std::string_view path) {
    for (const base::EmbeddedFile& file : embedded::content()) {
        if (file.path == path) return file.data;
    }
    return std::nullopt;
}

std::vector<BuiltInFile> builtInFiles() {
    std::vector<BuiltInFile> files;
    for (const base::EmbeddedFile& file : embedded::content()) files.push_back({file.path, file.data});
    return files;
}

base::Result<world::BlockRegistry> loadBlocks(const world::BehaviorTable& behaviors) {
    const auto text = findContent("blocks.toml");
    if (!text) return base::fail("blocks.toml: not in the program");
    return world::BlockRegistry::parse(*text, "blocks.toml", behaviors);
}

world::TextureSource builtInTextures() {
    return [](std::string_view name) -> base::Result<base::Image> {
        const std::string path = fmt::format("textures/{}.png", name);
        const auto data = findContent(path);
        if (!data) return base::fail("{}: not in the program", path);
        return base::decodePng(*data, path);
    };
}

}  // namespace terrane::content

#include "terrane/content/built_in.h"

#include <array>
#include <optional>
#include <utility>

#include "terrane/base/files.h"
#include "terrane/content/content_files_internal.h"
#include "terrane/world/blocks/block_parser.h"
#include "terrane/world/items/item_table.h"

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
    const auto text = findContent("blocks.toml"), itemText = findContent("items.toml");
    if (!text || !itemText) return base::fail("blocks.toml or items.toml: not in the program");
    auto file = TERRANE_TRY(world::parseBlocks(*text, "blocks.toml", behaviors));
    const auto items = TERRANE_TRY(world::parseItems(*itemText, "items.toml"));
    auto blocks = TERRANE_TRY(
        world::BlockRegistry::fromDescriptions(std::move(file.blocks), "blocks.toml", std::span(&items, 1)));
    TERRANE_TRY(world::checkItemNames(blocks));
    return blocks;
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

namespace terrane::content {

namespace {

const std::array kScenes = {
    Scene{"ocean", {{992, 1092, 89}, 163, -3}, 0.36f},
    Scene{"desert", {{1318, -790, 112}, 318, -6}, 0.36f},
    Scene{"landscape", {{-1048, -108, 122}, 136, -6}, 0.62f},
    Scene{"cave", {{-109, 280, 88}, 90, -58}, 0.50f},
};

}  // namespace

std::span<const Scene> scenes() {
    return kScenes;
}

const Scene* findScene(std::string_view name) {
    for (const Scene& scene : kScenes) {
        if (scene.name == name) return &scene;
    }
    return nullptr;
}

}  // namespace terrane::content

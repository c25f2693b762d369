// The block types and items that come with the program, for tests that need no OpenGL and so link no embedded
// content.
#pragma once

#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "terrane/base/files.h"
#include "terrane/world/blocks/block_parser.h"
#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/items/item_table.h"

namespace terrane {

inline const world::BlockRegistry& contentBlocks() {
    static const world::BlockRegistry registry = [] {
        const auto text = base::readFile(TERRANE_SOURCE_DIR "/assets/blocks.toml");
        const auto itemText = base::readFile(TERRANE_SOURCE_DIR "/assets/items.toml");
        if (!text || !itemText) throw std::runtime_error("no assets/blocks.toml or items.toml");
        auto blocks = world::parseBlocks(*text, "blocks.toml");
        const auto items = world::parseItems(*itemText, "items.toml");
        if (!blocks) throw std::runtime_error(blocks.error().message);
        if (!items) throw std::runtime_error(items.error().message);
        auto made = world::BlockRegistry::fromDescriptions(std::move(blocks->blocks), "blocks.toml",
                                                           std::span(&*items, 1));
        if (!made) throw std::runtime_error(made.error().message);
        return *std::move(made);
    }();
    return registry;
}

inline world::BlockId contentBlock(std::string_view name) {
    const world::BlockType* type = contentBlocks().find(name);
    if (!type) throw std::runtime_error("no block " + std::string(name));
    return type->id;
}

}  // namespace terrane

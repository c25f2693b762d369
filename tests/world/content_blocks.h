// The block types that come with the program, for tests that need no OpenGL and so link no embedded content.
#pragma once

#include <stdexcept>
#include <string_view>

#include "terrane/base/files.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane {

inline const world::BlockRegistry& contentBlocks() {
    static const world::BlockRegistry registry = [] {
        const auto text = base::readFile(TERRANE_SOURCE_DIR "/assets/blocks.toml");
        if (!text) throw std::runtime_error(text.error().message);
        auto parsed = world::BlockRegistry::parse(*text, "blocks.toml");
        if (!parsed) throw std::runtime_error(parsed.error().message);
        return *std::move(parsed);
    }();
    return registry;
}

inline world::BlockId contentBlock(std::string_view name) {
    const world::BlockType* type = contentBlocks().find(name);
    if (!type) throw std::runtime_error("no block " + std::string(name));
    return type->id;
}

}  // namespace terrane

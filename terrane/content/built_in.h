// Block types and textures that are compiled into the program; for shaders see gpu/built_in_shaders.h.
#pragma once

#include <string_view>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/world/block_registry.h"
#include "terrane/world/texture_source.h"

namespace terrane::content {

// `behaviors`: all behaviors that blocks may name, including the built-in ones.
base::Result<world::BlockRegistry> loadBlocks(
    const world::BehaviorTable& behaviors = world::builtInBehaviors());
world::TextureSource builtInTextures();

// The compiled-in files: "pack.toml", "blocks.toml", "textures/NAME.png", "languages/CODE.toml",
// "skeleton/…".
struct BuiltInFile {
    std::string_view path, data;  // live as long as the program
};
std::vector<BuiltInFile> builtInFiles();

}  // namespace terrane::content

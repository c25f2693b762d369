// The block types and textures that are compiled into the program; for shaders see gpu/shader_loader.h.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/world/blocks/block_model.h"
#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/pose.h"

namespace terrane::content {

// Loads the built-in block types and items. `behaviors` holds all behaviors that blocks may name, including
// the built-in ones.
base::Result<world::BlockRegistry> loadBlocks(
    const world::BehaviorTable& behaviors = world::builtInBehaviors());
world::TextureSource builtInTextures();

// The compiled-in files: "pack.toml", "blocks.toml", "items.toml", "textures/NAME.png",
// "languages/CODE.toml", "skeleton/…".
struct BuiltInFile {
    std::string_view path, data;  // live as long as the program
};
std::vector<BuiltInFile> builtInFiles();

// The reference scenes: fixed places in the overworld of seed 1, for measurements and images.
struct Scene {
    std::string_view name;
    world::Pose pose;
    float timeDay;
};

constexpr const char* kSceneGenerator = "overworld";

std::span<const Scene> scenes();
const Scene* findScene(std::string_view name);  // null if there is none

}  // namespace terrane::content

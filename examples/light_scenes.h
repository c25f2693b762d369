// Small worlds that show what light does. Used by light_images.cpp.
#pragma once

#include <string_view>
#include <vector>

#include "terrane/render/camera.h"
#include "terrane/world/block_registry.h"
#include "terrane/world/world.h"

namespace terrane::examples {

struct LightScene {
    const char* name;
    void (*build)(world::World& world, const world::BlockRegistry& blocks);
    render::Camera camera;
    float timeDay;
};

// Worlds reach this many chunks from the middle one.
constexpr int kSceneRadius = 3;

// Four lamps in a cave, a glass house at dusk; a corner that light must not pass, a lamp on open ground from
// above.
const std::vector<LightScene>& lightScenes();

// Blocks at so many random places of open ground, the first ones lamps of four colors, the others stone. One
// lamp stands in the middle.
struct LampCount {
    int lamps, places;
};
void buildLamps(world::World& world, const world::BlockRegistry& blocks, LampCount count);

}  // namespace terrane::examples

// Small worlds that demonstrate light. Used by light_images.cpp.
#pragma once

#include <string_view>
#include <vector>

#include "terrane/render/frame/camera.h"
#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/world.h"

namespace terrane::examples {

struct LightScene {
    const char* name;
    void (*build)(world::World& world, const world::BlockRegistry& blocks);
    render::Camera camera;
    float timeDay;
};

// Chunks from the middle chunk to the border of a world.
constexpr int kSceneRadius = 3;

// Four lamps in a cave, a glass house at dusk, a corner that light must not pass, and a lamp on open ground
// seen from above.
const std::vector<LightScene>& lightScenes();

// Sets blocks at `places` random positions on open ground: `lamps` of them are lamps of four colors, the rest
// stone. The first lamp stands in the middle.
struct LampCount {
    int lamps, places;
};
void buildLamps(world::World& world, const world::BlockRegistry& blocks, LampCount count);

}  // namespace terrane::examples

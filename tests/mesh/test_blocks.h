// Block types for the tests of the mesher.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "terrane/world/blocks/block_registry.h"
#include "tests/world/test_shapes.h"

namespace terrane::mesh {

// Every shape, alpha mode and animation, one- and two-sided, with and without inner faces.
inline const std::string kTestBlocks = world::kTestShapes + R"(
[[block]]
name = "stone"
shape = "cube"
texture = "stone"
[[block]]
name = "log"
shape = "cube"
textures = { top = "log_top", bottom = "log_top", side = "log_side" }
[[block]]
name = "ore"
shape = "cube"
texture = "ore"
alpha = "glow"
[[block]]
name = "leaves"
shape = "cube"
texture = "leaves"
alpha = "test"
two_sided = true
animation = "whole_waves"
inner_faces = true
opacity = 3
[[block]]
name = "grate"
shape = "cube"
texture = "grate"
alpha = "test"
inner_faces = true
opacity = 3
[[block]]
name = "lattice"
shape = "cube"
textures = { top = "lattice_top", bottom = "lattice", side = "lattice" }
alpha = "test_glow"
two_sided = { top = true, bottom = false, side = true }
inner_faces = true
opacity = 3
[[block]]
name = "hedge"
shape = "cube"
texture = "hedge"
alpha = "test"
animation = "top_waves"
opacity = 3
[[block]]
name = "glass"
shape = "cube"
texture = "glass"
alpha = "blend"
two_sided = true
opacity = 3
[[block]]
name = "water"
shape = "liquid"
texture = "water"
alpha = "blend"
animation = "liquid_surface"
opacity = 1
[[block]]
name = "lava"
shape = "liquid"
texture = "lava"
alpha = "glow"
inner_faces = true
opacity = 15
[[block]]
name = "tuft"
shape = "cross"
texture = "tuft"
alpha = "test"
two_sided = true
animation = "top_waves"
opacity = 3
[[block]]
name = "blade"
shape = "cross"
texture = "blade"
alpha = "test"
opacity = 3
[[block]]
name = "wheat"
shape = "hash"
texture = "wheat"
growth = ["wheat_0", "wheat_1"]
alpha = "test"
two_sided = true
animation = "top_waves"
opacity = 4
[[block]]
name = "fence"
shape = "hash"
texture = "fence"
alpha = "unused"
opacity = 4
[[block]]
name = "cactus"
shape = "inset"
textures = { top = "cactus_top", bottom = "cactus_bottom", side = "cactus_side" }
alpha = { side = "test" }
two_sided = { side = true }
opacity = 11
[[block]]
name = "pillar"
shape = "inset"
texture = "pillar"
inner_faces = true
opacity = 11
[[block]]
name = "oak_stairs"
shape = "stairs"
textures = { top = "oak_top", bottom = "oak_bottom", side = "oak" }
opacity = 15
[[block]]
name = "post"
shape = "post"
texture = "oak"
opacity = 0
[[block]]
name = "gate"
shape = "door"
texture = "grate"
alpha = "test"
two_sided = true
opacity = 0
[[block]]
name = "ice_stairs"
shape = "stairs"
texture = "glass"
alpha = "blend"
opacity = 3
[[block]]
name = "roof"
shape = "roof"
textures = { top = "oak_top", bottom = "oak_bottom", side = "oak" }
opacity = 11
[[block]]
name = "net"
shape = "net"
texture = "grate"
alpha = "test"
opacity = 0
[[block]]
name = "poster"
shape = "poster"
texture = "oak"
opacity = 0
)";

inline const world::BlockRegistry& testBlocks() {
    static const world::BlockRegistry registry = [] {
        auto parsed = world::BlockRegistry::parse(kTestBlocks, "test blocks");
        if (!parsed) throw std::runtime_error(parsed.error().message);
        return std::move(*parsed);
    }();
    return registry;
}

inline world::BlockId idOf(std::string_view name) {
    const world::BlockType* type = testBlocks().find(name);
    if (!type) throw std::runtime_error("no such test block");
    return type->id;
}

}  // namespace terrane::mesh

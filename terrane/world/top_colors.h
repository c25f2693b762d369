// The mean color of each kind of block seen from above, for maps and for light that the ground reflects. Any
// thread.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/world/block_registry.h"
#include "terrane/world/texture_source.h"

namespace terrane::world {

// The color of a block's top face.
struct TopColor {
    glm::vec3 mean{0.0f};  // sRGB, 0…255
    bool tinted = false;
};
using TopColors = std::vector<TopColor>;  // by block id

// Blocks without a shape are black. Fails if a texture cannot be read; the message names it.
base::Result<TopColors> topColors(const BlockRegistry& blocks, const TextureSource& textures);

}  // namespace terrane::world

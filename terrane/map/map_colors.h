// The colors of blocks on a map: means of their top faces and, for blocks several pixels wide, 4×4 texels.
// Plain values; any thread.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/map/surface.h"
#include "terrane/world/block_registry.h"
#include "terrane/world/texture_source.h"

namespace terrane::map {

constexpr int kTexels = 4;  // along each side of a block

struct BlockColor {
    glm::vec3 mean{0};                                  // sRGB, 0…1
    std::array<glm::vec3, kTexels * kTexels> texels{};  // the same, divided by the mean
    bool isTinted = false;
    SurfaceKind kind = SurfaceKind::Ground;
    glm::vec3 emission{0};  // 0…1
    float reach = 0;        // distance to which it shines, blocks
};
using MapColors = std::vector<BlockColor>;  // by block id

// The color of a liquid with ground under it: deeper is darker and shows less of the ground.
glm::vec3 throughLiquid(const glm::vec3& liquid, const glm::vec3& ground, float depthBlocks);
// The same for a block; a glowing liquid hides its ground. `liquid`: the block's color, tinted.
glm::vec3 colorOfLiquid(const BlockColor& block, const glm::vec3& liquid, const glm::vec3& ground,
                        float depthBlocks);

// Fails if a texture cannot be read; the message names it.
[[nodiscard]] base::Result<MapColors> mapColors(const world::BlockRegistry& blocks,
                                                const world::TextureSource& textures);

}  // namespace terrane::map

// A yard with figures on the flat world: a wall, glass, a torch; lit as in the program.
#pragma once

#include <cmath>

#include "terrane/light/light_area.h"
#include "terrane/world/character.h"
#include "terrane/world/pose.h"
#include "tests/golden/golden_fixture.h"

namespace terrane::golden {

// Uploads the chunks of flatWorld(radius) without the outermost ring, with their light.
inline void showLit(render::Renderer& renderer, const world::World& world, int radius) {
    light::LightArea area{2 * radius + 1, 2 * radius + 1, {}};
    std::vector<world::ChunkPtr> chunks;
    for (int y = -radius; y <= radius; ++y)
        for (int x = -radius; x <= radius; ++x) chunks.push_back(world.maybeChunkAt({x, y}));
    for (const world::ChunkPtr& chunk : chunks) area.chunks.push_back(chunk.get());
    const light::LightTable table(contentBlocks());
    const std::vector<light::ChunkLight> lights = light::lightArea(area, table);
    for (const auto& [pos, mesh] : meshWorld(world)) {
        renderer.setChunk(pos, mesh);
        renderer.setLight(pos,
                          lights[static_cast<std::size_t>(pos.x + radius + area.chunksX * (pos.y + radius))]);
    }
}

inline void fillBlocks(world::World& world, world::BlockPos min, world::BlockPos max,
                       std::string_view block) {
    for (int z = min.z; z <= max.z; ++z)
        for (int y = min.y; y <= max.y; ++y)
            for (int x = min.x; x <= max.x; ++x) world::putBlock(world, {x, y, z}, contentBlock(block));
}

// A figure on the ground of the flat world that looks along `yaw`.
inline world::Figure figureAt(double x, double y, float yaw, std::uint32_t look) {
    return {.eyes = {x, y, kGalleryZ + world::kEyeHeight}, .yaw = yaw, .bodyYaw = yaw, .look = look};
}

}  // namespace terrane::golden

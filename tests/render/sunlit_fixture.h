// Worlds of stone under a sun of any direction, for tests of shadows: only direct light and a little ambient
// light, without air.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "tests/golden/scenes.h"
#include "tests/render/renderer_fixture.h"

namespace terrane::render {

// Unit length; degrees. Azimuth 0 is +x, 90 is +y.
inline glm::vec3 towardSun(float azimuth, float elevation) {
    const float a = azimuth / 57.29578f, e = elevation / 57.29578f;
    return {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
}

inline world::Environment sunAt(glm::vec3 direction, float strength = 0.9f) {
    world::Environment e = world::environmentAt(0.5f);
    e.lightDirection = glm::normalize(direction);
    e.lightColor = glm::vec3(strength);
    e.ambientColor = glm::vec3(0.1f);
    return e;
}

// Blocks from `min` to `max`, both included.
struct BlockBox {
    world::BlockPos min, max;
};

// Air, and stone where boxes are; in order, so that a box of air makes a room.
struct StoneBox {
    BlockBox box;
    bool isAir = false;
};

// The chunks from `first` to `last`, both included, and a ring of air around them.
inline world::World stoneWorld(world::ChunkPos first, world::ChunkPos last, std::span<const StoneBox> boxes,
                               world::Heights heights = {}) {
    constexpr int kBlocks = world::kChunkSize;
    const world::BlockId stone = contentBlock("stone");
    world::World world(heights);
    for (int cy = first.y - 1; cy <= last.y + 1; ++cy) {
        for (int cx = first.x - 1; cx <= last.x + 1; ++cx) {
            auto chunk = std::make_shared<world::Chunk>(heights);
            for (const StoneBox& b : boxes) {
                const int x0 = std::max(b.box.min.x, kBlocks * cx),
                          x1 = std::min(b.box.max.x, kBlocks * cx + kBlocks - 1);
                const int y0 = std::max(b.box.min.y, kBlocks * cy),
                          y1 = std::min(b.box.max.y, kBlocks * cy + kBlocks - 1);
                for (int z = b.box.min.z; z <= b.box.max.z; ++z)
                    for (int y = y0; y <= y1; ++y)
                        for (int x = x0; x <= x1; ++x)
                            chunk->setBlock(world::blockIndex(x - kBlocks * cx, y - kBlocks * cy, z),
                                            b.isAir ? world::kAir : stone);
            }
            world.insert({cx, cy}, std::move(chunk));
        }
    }
    return world;
}

class SunlitTest : public RendererTest {
  protected:
    static constexpr glm::ivec2 kSunlitSize{160, 90};

    void configure(ShadowReach reach, bool isSoft = false, int texels = 2048, glm::ivec2 size = kSunlitSize) {
        RenderOptions o = plainOptions(1);
        o.shadows = reach;
        o.shadowSize = texels;
        o.softShadows = isSoft;
        o.occlusionCulling = o.distanceFog = false;
        ASSERT_TRUE(renderer_->configure(size, o));
    }
    void show(const world::World& world) {
        renderer_->clearChunks();
        for (const auto& [pos, mesh] : golden::meshWorld(world)) renderer_->setChunk(pos, mesh);
    }
    base::Image drawUnder(const Camera& camera, const world::Environment& sun) {
        return draw({camera, sun, 1e5f, 0, View::Color});
    }
};

// Steps of 255 by which a is brighter than b, by pixel: the largest of three colors.
inline std::vector<int> stepsBrighter(const base::Image& a, const base::Image& b) {
    std::vector<int> steps;
    for (std::size_t k = 0; k < a.rgba.size(); k += 4) {
        int most = -255;
        for (std::size_t c = 0; c < 3; ++c) most = std::max(most, int{a.rgba[k + c]} - int{b.rgba[k + c]});
        steps.push_back(most);
    }
    return steps;
}

inline int pixelsAbove(const std::vector<int>& steps, int most) {
    return static_cast<int>(std::ranges::count_if(steps, [most](int s) { return s > most; }));
}

}  // namespace terrane::render

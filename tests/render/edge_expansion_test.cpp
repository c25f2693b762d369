// No view from inside closed terrain shows a pixel of what is behind it, though the merged quads' corners lie
// on each other's edges. Filling the holes instead of covering the cracks leaves few.
#include <algorithm>
#include <cmath>
#include <map>

#include "terrane/mesh/chunk_mesher.h"
#include "terrane/shared/hash.h"
#include "tests/render/renderer_fixture.h"

namespace terrane::render {
namespace {

constexpr int kViews = 120;
constexpr glm::ivec2 kImage{320, 180};
constexpr int kHollow = 3;  // chunks around the middle one that are hollow; the ring around them is solid

float unitHash(int x, int y, unsigned seed) {
    return static_cast<float>(shared::hash2(static_cast<unsigned>(x), static_cast<unsigned>(y), seed) >> 8) /
           16777216.0f;
}

// Hills of some blocks, steps of single blocks on them.
float bumps(int x, int y, unsigned seed) {
    const float fx = static_cast<float>(x), fy = static_cast<float>(y), phase = static_cast<float>(seed);
    return 6 * std::sin(fx / 11 + phase) + 5 * std::cos(fy / 9 + phase) + 3 * std::sin((fx + fy) / 5) +
           1.5f * unitHash(x / 3, y / 3, seed);
}

int floorAt(int x, int y) {
    return 90 + static_cast<int>(bumps(x, y, 1));
}
int ceilingAt(int x, int y) {
    return 128 + static_cast<int>(bumps(x, y, 2));
}

// A hollow with a bumpy floor, ceiling and walls in endless ground of three types.
world::BlockId blockAt(int x, int y, int z) {
    const int wall = 16 * kHollow + 12;
    const int wallX = wall - static_cast<int>(3 * unitHash(y / 2, z / 2, 3));
    const int wallY = wall - static_cast<int>(3 * unitHash(x / 2, z / 2, 4));
    const bool isHollow =
        std::abs(x - 8) < wallX && std::abs(y - 8) < wallY && z > floorAt(x, y) && z < ceilingAt(x, y);
    if (isHollow) return world::kAir;
    const unsigned kind = shared::hash3(static_cast<unsigned>(x >> 2), static_cast<unsigned>(y >> 2),
                                        static_cast<unsigned>(z >> 2), 5) %
                          6;
    return contentBlock(kind == 0 ? "dirt" : kind == 1 ? "sand" : "stone");
}

world::Chunk makeChunk(int chunkX, int chunkY) {
    world::Chunk chunk;
    std::array<world::BlockId, world::kBlocksPerSection> values;
    for (int number = 0; number < world::kSectionsPerChunk; ++number) {
        for (int i = 0; i < world::kBlocksPerSection; ++i) {
            const int x = 16 * chunkX + (i & 15), y = 16 * chunkY + (i >> 4 & 15);
            values[static_cast<std::size_t>(i)] = blockAt(x, y, 16 * number + (i >> 8));
        }
        chunk.setSection(number, world::Section::fromValues(values));
    }
    return chunk;
}

class EdgeExpansion : public RendererTest {
  protected:
    void SetUp() override {
        RendererTest::SetUp();
        if (renderer_) loadHollow();
    }

    void loadHollow() {
        std::map<world::ChunkPos, world::Chunk> chunks;
        constexpr int kAll = kHollow + 2;
        for (int y = -kAll; y <= kAll; ++y) {
            for (int x = -kAll; x <= kAll; ++x) chunks.emplace(world::ChunkPos{x, y}, makeChunk(x, y));
        }
        mesh::MeshScratch scratch;
        for (const auto& [pos, chunk] : chunks) {
            if (world::chunkDistance(pos, {}) == kAll) continue;
            const mesh::MeshInput input{&chunk,
                                        {&chunks.at({pos.x - 1, pos.y}), &chunks.at({pos.x + 1, pos.y}),
                                         &chunks.at({pos.x, pos.y - 1}), &chunks.at({pos.x, pos.y + 1})},
                                        &contentBlocks(),
                                        {}};
            renderer_->setChunk(pos, meshChunk(input, scratch));
        }
    }

    // A place in the hollow, looking anywhere.
    static Camera cameraOf(int view) {
        const auto random = [&](unsigned k) { return unitHash(view, static_cast<int>(k), 9); };
        Camera camera;
        camera.position = {16 * (6 * random(0) - 2.5), 16 * (6 * random(1) - 2.5), 0};
        const int x = static_cast<int>(std::floor(camera.position.x)),
                  y = static_cast<int>(std::floor(camera.position.y));
        const float low = static_cast<float>(floorAt(x, y)) + 1.3f,
                    high = static_cast<float>(ceilingAt(x, y)) - 0.3f;
        camera.position.z = low + (high - low) * random(2);
        camera.yaw = 360 * random(3);
        camera.pitch = 120 * random(4) - 60;
        return camera;
    }

    // Pixels of which at least one sample shows what is behind the terrain: in the view of depth that is
    // black, and all terrain is nearly white with a fog this far away.
    std::size_t backgroundPixels(int samples, TJunctions tJunctions) {
        RenderOptions options = plainOptions(samples);
        options.tJunctions = tJunctions;
        EXPECT_TRUE(renderer_->configure(kImage, options));
        std::size_t count = 0;
        for (int view = 0; view < kViews; ++view) {
            renderer_->draw({cameraOf(view), world::environmentAt(0.5f), 4000, 0, View::Depth});
            const base::Image image = renderer_->readImage();
            for (std::size_t k = 0; k < image.rgba.size(); k += 4) count += image.rgba[k] < 195;
        }
        return count;
    }

    bool isDrawn(std::string_view pass) const {
        return std::ranges::any_of(renderer_->passTimes(),
                                   [&](const gpu::GpuTiming& time) { return time.name == pass; });
    }
};

TEST_F(EdgeExpansion, NoViewShowsTheBackground) {
    EXPECT_EQ(backgroundPixels(1, TJunctions::Covered), 0u);
    EXPECT_EQ(backgroundPixels(4, TJunctions::Covered), 0u);
}

// The test above would find them. A hole of several samples is not filled.
TEST_F(EdgeExpansion, WithoutItCracksAreSeenAndFillingClosesMost) {
    for (const int samples : {1, 4}) {
        const std::size_t open = backgroundPixels(samples, TJunctions::Open);
        EXPECT_GT(open, 100u);
        EXPECT_FALSE(isDrawn("fill holes")) << "costs nothing when it is off";
        EXPECT_LT(backgroundPixels(samples, TJunctions::Filled), open / 10) << samples << " samples";
        EXPECT_TRUE(isDrawn("fill holes"));
    }
}

}  // namespace
}  // namespace terrane::render

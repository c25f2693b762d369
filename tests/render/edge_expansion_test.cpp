// No view from inside closed terrain shows a pixel of the background, though the corners of merged quads lie
// on each other's edges. Filling the holes instead of covering the cracks leaves few.
#include <algorithm>
#include <cmath>
#include <map>

#include "terrane/mesh/chunk_mesher.h"
#include "terrane/render/frame/edge_expansion.h"
#include "terrane/shared/hash.h"
#include "tests/gpu/scratch_folder.h"
#include "tests/render/renderer_fixture.h"
#include "tests/support/default_heights.h"
#include "tests/support/depth.h"

namespace terrane::render {
namespace {

const int kViews = atDepth(40, 120);
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
    std::size_t backgroundPixels(int samples, TJunctions tJunctions, int views = kViews) {
        RenderOptions options = plainOptions(samples);
        options.tJunctions = tJunctions;
        EXPECT_TRUE(renderer_->configure(kImage, options));
        std::size_t count = 0;
        for (int view = 0; view < views; ++view) {
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

// The test above would find the cracks. A hole of several samples is not filled.
TEST_F(EdgeExpansion, WithoutItCracksAreSeenAndFillingClosesMost) {
    for (const int samples : {1, 4}) {
        const std::size_t open = backgroundPixels(samples, TJunctions::Open);
        EXPECT_GT(open, static_cast<std::size_t>(kViews)) << "more than one pixel a view";
        EXPECT_FALSE(isDrawn("fill holes")) << "costs nothing when it is off";
        EXPECT_LT(backgroundPixels(samples, TJunctions::Filled), open / 10) << samples << " samples";
        EXPECT_TRUE(isDrawn("fill holes"));
    }
}

constexpr std::string_view kExpansionShader = "terrane/render/frame/edge_expansion.glsl";

// The coarsest rasterizer that OpenGL allows, made of another one: corners lie on a grid of 1/16 pixel.
constexpr int kCoarsestBits = 4;
constexpr std::string_view kCoarseGrid = R"(
vec4 expandEdges(vec4 corner, vec4 neighborU, vec4 neighborV, vec2 viewport, float growth, float growsV) {
    vec4 moved = expandEdgesExactly(corner, neighborU, neighborV, viewport, growth, growsV);
    if (moved.w <= 0.0) return moved;
    vec2 steps = 16.0 * 0.5 * viewport;
    moved.xy = ROUND(moved.xy / moved.w * steps) / steps * moved.w;
    return moved;
}
)";

class EdgeExpansionOnCoarseGrid : public EdgeExpansion {
  protected:
    // `rounding`: floor or round, as the rasterizer moves corners. `toldBits`: its subpixel bits as reported.
    void makeRenderer(const std::string& rounding, int toldBits) {
        std::string shader = contentShaders().find(kExpansionShader).value();
        constexpr std::string_view kName = "vec4 expandEdges(";
        const std::size_t at = shader.find(kName);
        ASSERT_NE(at, std::string::npos);
        shader.replace(at, kName.size(), "vec4 expandEdgesExactly(");
        folder_.write(kExpansionShader,
                      "#define ROUND " + rounding + "\n" + shader + std::string(kCoarseGrid));
        gpu::DeviceInfo device = gpu::queryDevice();
        device.subpixelBits = toldBits;
        auto made = Renderer::create(shaders_, contentBlocks(), contentTexture, device);
        ASSERT_TRUE(made) << made.error().message;
        own_ = std::move(*made);
        renderer_ = &*own_;
        loadHollow();
    }

    const gpu::ScratchFolder folder_;
    const gpu::ShaderLoader shaders_ = gpu::builtInShaders(folder_.path());
    std::optional<Renderer> own_;
};

TEST_F(EdgeExpansionOnCoarseGrid, NoViewShowsTheBackground) {
    constexpr int kFewViews = 24;
    for (const char* rounding : {"floor", "round"}) {
        makeRenderer(rounding, kCoarsestBits);
        EXPECT_EQ(backgroundPixels(1, TJunctions::Covered, kFewViews), 0u) << rounding;
        EXPECT_EQ(backgroundPixels(4, TJunctions::Covered, kFewViews), 0u) << rounding;
    }
    makeRenderer("round", 8);
    EXPECT_GT(backgroundPixels(4, TJunctions::Covered, kFewViews), 100u)
        << "the grid is as coarse as it says";
}

TEST(EdgeExpansionPixels, CoverWhatTheGridAndArithmeticMove) {
    constexpr float kHalfDiagonal = 0.70710678f;  // of a step
    for (const int side : {64, 1280, 16384}) {
        for (const int bits : {4, 8, 13}) {
            const float grid = std::ldexp(1.0f, -bits), arithmetic = 1e-5f * static_cast<float>(side);
            for (const glm::ivec2 size : {glm::ivec2(side, 16), glm::ivec2(16, side)}) {
                EXPECT_GE(edgeExpansion(bits, size), kHalfDiagonal * (grid + arithmetic));
                EXPECT_LE(edgeExpansion(bits, size), 1.5f * (grid + arithmetic)) << "silhouettes stay";
            }
        }
    }
}

}  // namespace
}  // namespace terrane::render

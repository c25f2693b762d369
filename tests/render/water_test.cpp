// Water's rectangles hold all of it, it mirrors what stands behind, and glitters toward the sun.
#include <cmath>
#include <random>

#include "terrane/mesh/chunk_mesher.h"
#include "terrane/render/cull/screen_rect.h"
#include "tests/golden/scenes.h"
#include "tests/render/renderer_fixture.h"

namespace terrane::render {
namespace {

constexpr int kFloor = 92, kSurface = 100;  // blocks of stone and of the water's surface

template <class BlockAt>
mesh::ChunkMesh meshOf(BlockAt blockAt) {
    world::Chunk chunk;
    for (int x = 0; x < world::kChunkSize; ++x)
        for (int y = 0; y < world::kChunkSize; ++y)
            for (int z = kFloor; z <= kSurface + 20; ++z)
                chunk.setBlock(world::blockIndex(x, y, z), contentBlock(blockAt(x, y, z)));
    return mesh::meshAlone(chunk, contentBlocks());
}

const char* lakeAt(int, int, int z) {
    return z == kFloor ? "stone" : z <= kSurface ? "water" : "air";
}

bool isIn(const std::vector<ScreenRect>& rects, glm::ivec2 pixel) {
    return std::ranges::any_of(rects, [&](const ScreenRect& r) {
        return pixel.x >= r.min.x && pixel.x < r.max.x && pixel.y >= r.min.y && pixel.y < r.max.y;
    });
}

TEST(ScreenGrid, HoldsWhatCoversItWithoutOverlap) {
    std::mt19937 random(7);
    for (const glm::ivec2 size : {glm::ivec2{1, 1}, {33, 18}, {96, 64}, {1280, 720}}) {
        ScreenGrid grid(size);
        EXPECT_TRUE(grid.rects().empty());
        std::vector<ScreenRect> covered;
        for (int k = 0; k < 3; ++k) {
            const auto upTo = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
            const glm::ivec2 min{upTo(size.x), upTo(size.y)};
            covered.push_back({min, min + 1 + glm::ivec2(upTo(size.x - min.x), upTo(size.y - min.y))});
            grid.cover(covered.back());
        }
        const std::vector<ScreenRect> rects = grid.rects();
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) {
                if (isIn(covered, {x, y})) {
                    ASSERT_TRUE(isIn(rects, {x, y})) << size.x << ": " << x << ' ' << y;
                }
            }
        int pixels = 0;
        std::vector<int> hits(static_cast<std::size_t>(size.x * size.y));
        for (const ScreenRect& r : rects)
            for (int y = r.min.y; y < r.max.y; ++y)
                for (int x = r.min.x; x < r.max.x; ++x)
                    pixels += ++hits[static_cast<std::size_t>(y * size.x + x)] > 1;
        EXPECT_EQ(pixels, 0) << "overlap";
        grid.cover({{0, 0}, size});
        EXPECT_EQ(grid.isFull(), size.x >= ScreenGrid::kColumns) << "cells of small images have no pixels";
        EXPECT_EQ(grid.rects(), (std::vector{ScreenRect{{0, 0}, size}}));
    }
}

TEST(ScreenRect, HoldsAllPointsOfTheBox) {
    std::mt19937 random(3);
    std::uniform_real_distribution<float> share(0, 1), place(-30, 30), angle(-180, 180);
    int seen = 0;
    for (int k = 0; k < 300; ++k) {
        const Camera camera{.position = {8, 8, 100}, .yaw = angle(random), .pitch = angle(random) / 2};
        const glm::mat4 toClip = viewMatrices(camera, 1.5f).viewProjection;
        const glm::vec3 min(place(random), place(random), 100 + place(random));
        const glm::vec3 extent(20 * share(random), 20 * share(random), 6 * share(random));
        const ScreenRect rect = screenRectOf(min, min + extent, toClip, kImageSize);
        for (int n = 0; n < 50; ++n) {
            const glm::vec3 in(share(random), share(random), share(random));
            const glm::vec4 clip = toClip * glm::vec4(min + in * extent, 1);
            if (clip.w < kNearPlane || std::max(std::abs(clip.x), std::abs(clip.y)) >= clip.w) continue;
            const glm::ivec2 pixel((0.5f + 0.5f * glm::vec2(clip) / clip.w) * glm::vec2(kImageSize));
            ASSERT_TRUE(isIn({rect}, pixel)) << k;
            ++seen;
        }
    }
    EXPECT_GT(seen, 500);
}

class Water : public RendererTest {
  protected:
    void configure(int samples, render::Water water, int singleLayer = 0) {
        RenderOptions options = plainOptions(samples);
        options.water = water;
        options.singleTransparencyLayer = singleLayer;
        const auto configured = renderer_->configure(kImageSize, options);
        ASSERT_TRUE(configured) << configured.error().message;
    }
    void setLake() {
        for (int x = -2; x <= 2; ++x)
            for (int y = -1; y <= 1; ++y) ASSERT_TRUE(renderer_->setChunk({x, y}, meshOf(lakeAt)));
    }
};

// A single layer is drawn without rectangles, over the whole screen, before a gray background.
TEST_F(Water, RectanglesHoldEveryPixelOfIt) {
    configure(1, render::Water::Plain, 1);
    std::size_t outside = 0, seen = 0;
    for (const Camera& camera : {Camera{.position = {-20, 8, 104}, .yaw = 0, .pitch = -20},
                                 Camera{.position = {8.5, 8, 101.2}, .yaw = 30, .pitch = -40},
                                 Camera{.position = {3, 4, 120}, .yaw = 200, .pitch = -89},
                                 Camera{.position = {-60, 40, 110}, .yaw = -30, .pitch = 5}}) {
        ASSERT_TRUE(renderer_->setChunk({1, 0}, meshOf(lakeAt)));
        MeshSectionTable table;
        table.set({1, 0}, renderer_->meshSectionsOf({1, 0}));
        const auto rects =
            table.blendedRects(cameraChunk(camera), viewMatrices(camera, 1.5f).viewProjection, kImageSize);
        const base::Image with = draw(noon(camera));
        for (int y = 0; y < kImageSize.y; ++y)
            for (int x = 0; x < kImageSize.x; ++x) {
                const Color color = pixel(with, x, y);
                if (std::abs(color[0] - color[1]) + std::abs(color[2] - color[1]) < 8) continue;
                const glm::ivec2 at{x, kImageSize.y - 1 - y};
                ASSERT_TRUE(isIn(rects, at)) << x << ' ' << y;
                outside += !isIn({{{40, 20}, {60, 40}}}, at);
                ++seen;
            }
        renderer_->removeChunk({1, 0});
    }
    EXPECT_GT(seen, 500u);
    EXPECT_GT(outside, 100u) << "a smaller rectangle would be seen here";
}

TEST_F(Water, MirrorsATowerBehindIt) {
    setLake();
    const FrameInput input = noon({{-30, 8, 103}, 0, -4});
    const auto tower =
        meshOf([](int x, int y, int z) { return x == 0 && y > 4 && y < 12 ? "lamp_red" : lakeAt(x, y, z); });
    // Change of red minus blue in the water below the foot of the tower due to the tower.
    const auto redness = [&](int samples, render::Water water) {
        configure(samples, water);
        const auto sum = [&] {
            const base::Image image = draw(input);
            int red = 0;
            for (int y = kImageSize.y / 2 + 2; y < kImageSize.y / 2 + 8; ++y)
                red += pixel(image, kImageSize.x / 2, y)[0] - pixel(image, kImageSize.x / 2, y)[2];
            return red;
        };
        EXPECT_TRUE(renderer_->setChunk({2, 0}, meshOf(lakeAt)));
        const int before = sum();
        EXPECT_TRUE(renderer_->setChunk({2, 0}, tower));
        return sum() - before;
    };
    for (const int samples : {1, 4}) {
        EXPECT_GT(redness(samples, render::Water::Full), 60) << samples;
        EXPECT_LT(std::abs(redness(samples, render::Water::Plain)), 20) << samples;
    }
}

// Waves do not tear pieces off a reflection: what is mirrored hangs together with its foot at the shore.
TEST_F(Water, ReflectionsStayInOnePiece) {
    constexpr glm::ivec2 kWideSize{320, 180};
    RenderOptions options = plainOptions(1);
    options.water = render::Water::Full;
    ASSERT_TRUE(renderer_->configure(kWideSize, options));
    // A sea 20 deep; battlements at its eastern end.
    const int radius = 6, east = world::kChunkSize * radius - 1;
    const auto seaWith = [&](bool hasShore) {
        world::World world = golden::emptyWorld(radius);
        for (int x = -world::kChunkSize * radius; x <= east + world::kChunkSize; ++x)
            for (int y = -world::kChunkSize * radius; y <= east + world::kChunkSize; ++y)
                for (int z = kSurface - 20; z <= kSurface; ++z)
                    world::putBlock(world, {x, y, z}, contentBlock(z < kSurface - 18 ? "stone" : "water"));
        if (!hasShore) return golden::meshWorld(world);
        for (int y = 0; y < 16; ++y)
            for (int z = kSurface; z < kSurface + (y / 4 % 2 == 0 ? 12 : 5); ++z)
                world::putBlock(world, {east, y, z}, contentBlock("lamp_red"));
        return golden::meshWorld(world);
    };
    const auto drawn = [&](bool hasShore) {
        for (const auto& [pos, mesh] : seaWith(hasShore)) EXPECT_TRUE(renderer_->setChunk(pos, mesh));
        std::vector<base::Image> images;
        for (const float seconds : {0.0f, 1.7f, 3.4f, 5.1f}) {
            FrameInput input = noon({{-30, 8, 114}, 0, -8, 18});
            input.timeSeconds = seconds;
            images.push_back(draw(input));
        }
        return images;
    };
    const std::vector<base::Image> without = drawn(false), with = drawn(true);
    int mirrored = 0, torn = 0;
    for (std::size_t k = 0; k < with.size(); ++k) {
        const auto isRed = [&](int x, int y) {
            const auto reddened = [&](const base::Image& image) {
                const std::size_t at = 4 * static_cast<std::size_t>(y * kWideSize.x + x);
                return image.rgba[at] - image.rgba[at + 2];
            };
            return reddened(with[k]) > reddened(without[k]) + 8;
        };
        for (int y = kWideSize.y / 2; y < kWideSize.y; ++y)
            for (int x = 1; x + 1 < kWideSize.x; ++x) {
                if (!isRed(x, y)) continue;
                ++mirrored;
                torn += !isRed(x - 1, y - 1) && !isRed(x, y - 1) && !isRed(x + 1, y - 1);
            }
    }
    EXPECT_GT(mirrored, 1000);
    EXPECT_LE(torn, mirrored / 200) << mirrored;
}

TEST_F(Water, GlittersTowardTheSun) {
    setLake();
    const world::Environment e = world::environmentAt(0.3f);
    const float toSun = std::atan2(e.lightDirection.y, e.lightDirection.x) * 57.29578f;
    for (const render::Water water : {render::Water::Plain, render::Water::Full}) {
        configure(1, water);
        const auto brightest = [&](float yaw) {
            const base::Image image = draw({{{8, 8, 104}, yaw, -35}, e, 256, 0, View::Color});
            int most = 0;
            for (int y = 0; y < kImageSize.y; ++y)
                for (int x = 0; x < kImageSize.x; ++x) most = std::max(most, pixel(image, x, y)[0]);
            return most;
        };
        EXPECT_GT(brightest(toSun), brightest(toSun + 180) + 60);
    }
}

// Change of a still scene when the camera moves by a hundredth of a block.
TEST_F(Water, DoesNotFlickerWhenTheCameraMovesALittle) {
    setLake();
    configure(4, render::Water::Full);
    const auto drawnAt = [&](double x) { return draw(noon({{x, 8, 103}, 20, -12})); };
    const base::Image before = drawnAt(-30), after = drawnAt(-29.99);
    double sum = 0;
    for (std::size_t k = 0; k < before.rgba.size(); ++k)
        sum += std::abs(int{before.rgba[k]} - int{after.rgba[k]});
    EXPECT_LT(sum / static_cast<double>(before.rgba.size()), 1.0);
}

}  // namespace
}  // namespace terrane::render

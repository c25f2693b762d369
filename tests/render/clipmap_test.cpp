#include "terrane/render/land/clipmap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>
#include <stdexcept>
#include <tuple>

namespace terrane::render {
namespace {

constexpr double kFar = 1e9;
constexpr double kEdge = 2147483648.0;

world::ChunkPos chunkAt(const glm::dvec3& position) {
    return cameraChunk({.position = position});
}

void fill(Clipmap& clipmap, world::ChunkPos camera) {
    for (const world::ChunkPos tile : clipmap.missing(camera, kFar, SIZE_MAX)) clipmap.set(tile);
    EXPECT_TRUE(clipmap.missing(camera, kFar, SIZE_MAX).empty());
}

TEST(Clipmap, HasEverySecondLevel) {
    for (int level = 0; level < 16; ++level) {
        const bool expected = level == 2 || level == 4 || level == 6 || level == 8 || level == 10;
        EXPECT_EQ(Clipmap(kTintClipmap).isTile({0, 0, static_cast<std::uint8_t>(level)}), expected) << level;
    }
}

TEST(Clipmap, AFullOneReachesSevenTiles) {
    Clipmap clipmap(kTintClipmap);
    for (const glm::dvec3 position :
         {glm::dvec3(0), {31.5, -20.25, 90}, {-kEdge, -kEdge, 0}, {kEdge - 1, 5e8, 0}}) {
        fill(clipmap, chunkAt(position));
        const shared::TintFrame frame = tintFrame(clipmap, {.position = position});
        for (int level = 0; level < 5; ++level)
            EXPECT_EQ(frame.levels[level].w, static_cast<float>(7 * 16 * std::pow(4, level + 1))) << level;
    }
}

TEST(Clipmap, AMissingTileEndsWhatIsComplete) {
    Clipmap clipmap(kTintClipmap);
    EXPECT_EQ(tintFrame(clipmap, {}).levels[0].w, 0.0f);
    fill(clipmap, {0, 0});
    clipmap.set({2 + 16, 0, 2});  // in place of the tile 128 to 192 blocks away along x
    const shared::TintFrame frame = tintFrame(clipmap, {.position = {10, 20, 0}});
    EXPECT_EQ(frame.levels[0].w, 128 - 10 - 4) << "up to a texel before it";
    EXPECT_EQ(frame.levels[1].w, 7 * 256);
    clipmap.set({16, 0, 2});
    EXPECT_EQ(tintFrame(clipmap, {.position = {10, 20, 0}}).levels[0].w, 0.0f) << "the camera's own tile";
}

TEST(Clipmap, ACameraThatMovesOnNeedsARowOfTiles) {
    Clipmap clipmap(kTintClipmap);
    fill(clipmap, {0, 0});
    EXPECT_TRUE(clipmap.missing({1, -2}, kFar, SIZE_MAX).empty()) << "less than half a tile";
    const auto row = clipmap.missing({2, 0}, kFar, SIZE_MAX);
    ASSERT_EQ(row.size(), 16u);
    for (const world::ChunkPos tile : row) EXPECT_EQ(std::tuple(tile.x, tile.level), std::tuple(8, 2));
}

TEST(Clipmap, NearAndFineTilesComeFirst) {
    const Clipmap clipmap(kTintClipmap);
    const auto tiles = clipmap.missing({0, 0}, kFar, 30);
    ASSERT_EQ(tiles.size(), 30u);
    for (std::size_t k = 0; k < 20; ++k) {
        EXPECT_EQ(tiles[k].level, 2 + k / 4 * 2);
        EXPECT_TRUE(tiles[k].x >= -1 && tiles[k].x <= 0 && tiles[k].y >= -1 && tiles[k].y <= 0);
    }
    EXPECT_EQ(tiles[20].level, 2);
}

TEST(Clipmap, LevelsBeyondTheViewAreNotAskedFor) {
    const Clipmap clipmap(kTintClipmap);
    const auto levels = [&](double reach) {
        std::set<int> found;
        for (const world::ChunkPos tile : clipmap.missing({0, 0}, reach, SIZE_MAX)) found.insert(tile.level);
        return found.size();
    };
    EXPECT_EQ(levels(16 * 8), 1u);
    EXPECT_EQ(levels(0.75 * 448 + 1), 2u);
    EXPECT_EQ(levels(65536), 5u);
}

// Reference for the texels of the clipmap's textures: each has the place of its column in the world, x and y.
// A table by level and texel.
class SlowTextures {
  public:
    void set(world::ChunkPos tile) {
        const ClipmapPlace place = Clipmap(kTintClipmap).placeOf(tile);
        for (int k = 0; k < 256; ++k)
            texels_[{place.level, place.texel.x + k % 16, place.texel.y + k / 16}] = {
                std::int64_t{tile.x} * 16 + k % 16, std::int64_t{tile.y} * 16 + k / 16};
    }
    std::pair<std::int64_t, std::int64_t> at(int level, double u, double v) const {
        const auto texel = [](double t) { return static_cast<int>(std::floor((t - std::floor(t)) * 256)); };
        return texels_.at({level, texel(u), texel(v)});
    }

  private:
    std::map<std::tuple<int, int, int>, std::pair<std::int64_t, std::int64_t>> texels_;
};

// For any earlier camera, and with some tiles still missing: every place within the reach of a level shows
// its column, found as in the shader.
TEST(Clipmap, RandomFlightsShowTheRightColumns) {
    std::mt19937 random(3);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    Clipmap clipmap(kTintClipmap);
    SlowTextures textures;
    glm::dvec3 camera(0);
    int compared = 0;
    for (int step = 0; step < 60; ++step) {
        if (step % 20 == 19) {
            const double ends[] = {-kEdge, kEdge - 1, 0, between(-1e9, 1e9)};
            camera = {ends[random() % 4], ends[random() % 4], 0};
        }
        const double stride = std::ldexp(1.0, static_cast<int>(random() % 14));
        for (int axis : {0, 1})
            camera[axis] = std::clamp(camera[axis] + between(-stride, stride), -kEdge, kEdge - 1);
        for (const world::ChunkPos tile :
             clipmap.missing(chunkAt(camera), kFar, random() % 3 == 0 ? 40 : 2000)) {
            clipmap.set(tile);
            textures.set(tile);
        }
        const shared::TintFrame frame = tintFrame(clipmap, {.position = camera});
        const world::ChunkPos chunk = chunkAt(camera);
        for (int level = 0; level < 5; ++level) {
            const glm::vec4 l = frame.levels[level];
            const double texel = std::pow(4, level + 1);
            for (int k = 0; k < 20 && l.w > 0; ++k) {
                // In the middle half of a texel: floats are not exact at its edges.
                const auto column = [&](double at) { return std::floor((at + between(-l.w, l.w)) / texel); };
                const glm::dvec2 columns(column(camera.x), column(camera.y));
                const glm::dvec2 place =
                    (columns + glm::dvec2(between(0.25, 0.75), between(0.25, 0.75))) * texel;
                const auto u = l.x + static_cast<float>(place.x - 16.0 * chunk.x) * l.z;
                const auto v = l.y + static_cast<float>(place.y - 16.0 * chunk.y) * l.z;
                ASSERT_EQ(textures.at(level, u, v), std::pair(static_cast<std::int64_t>(columns.x),
                                                              static_cast<std::int64_t>(columns.y)))
                    << "step " << step << ", level " << level;
                ++compared;
            }
        }
    }
    EXPECT_GT(compared, 2000);
}

TEST(Clipmap, HasNoPlaceForATileOfAnotherLevel) {
    const Clipmap clipmap({.levels = 2, .firstLevel = 2, .levelStep = 2, .order = TileOrder::NearFirst});
    EXPECT_NO_THROW(clipmap.placeOf({0, 0, 4}));
    for (const int level : {0, 3, 6})
        EXPECT_THROW(clipmap.placeOf({0, 0, static_cast<std::uint8_t>(level)}), std::invalid_argument)
            << level;
}

}  // namespace
}  // namespace terrane::render

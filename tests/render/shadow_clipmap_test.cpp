#include "terrane/render/shadow/shadow_clipmap.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

namespace terrane::render {
namespace {

const glm::vec3 kLight = glm::normalize(glm::vec3(-0.5f, 0.3f, 0.8f));
constexpr std::size_t kAllTiles = ShadowClipmap::kAllTiles;
constexpr int kSide = static_cast<int>(shared::kShadowTiles);

int tilesOf(const std::vector<ShadowTiles>& tiles) {
    int count = 0;
    for (const ShadowTiles& t : tiles) {
        count += t.size.x * t.size.y;
        EXPECT_LE(t.slot().x + t.size.x, kSide) << "no rectangle wraps around";
        EXPECT_LE(t.slot().y + t.size.y, kSide);
    }
    return count;
}

TEST(ShadowClipmap, OnlyWhatComesIntoReachIsDrawn) {
    ShadowClipmap clipmap(3);
    Camera camera{.position = {500, 500, 100}};
    EXPECT_EQ(tilesOf(clipmap.update(camera, kLight, kAllTiles)), 3 * kSide * kSide);
    camera.yaw = 90;
    EXPECT_EQ(tilesOf(clipmap.update(camera, kLight, kAllTiles)), 0) << "it turns";
    int drawn = 0;
    for (int step = 0; step < 290; ++step) {
        camera.position.x += 0.1;
        drawn += tilesOf(clipmap.update(camera, kLight, kAllTiles));
    }
    EXPECT_GT(drawn, 0);
    EXPECT_LE(drawn, 5 * kSide)
        << "29 blocks are two tiles along a diagonal at most, and one of another cascade";
}

TEST(ShadowClipmap, AllIsDrawnWithinTheLimitNearTilesFirst) {
    ShadowClipmap clipmap(3);
    const Camera camera{.position = {500, 500, 100}};
    EXPECT_GE(clipmap.update(camera, kLight, 5).size(), 1u);
    const float firstReach = 1 / clipmap.frame(camera, 1024).reach[0];
    int drawn = 5;
    for (int frame = 0; frame < 60; ++frame) {
        const int tiles = tilesOf(clipmap.update(camera, kLight, 5));
        EXPECT_LE(tiles, 5);
        drawn += tiles;
    }
    EXPECT_EQ(drawn, 3 * kSide * kSide);
    EXPECT_LT(firstReach, 0.5f / clipmap.frame(camera, 1024).reach[0]);
    EXPECT_EQ(clipmap.frame(camera, 1024).toMap[0], [&] {
        ShadowClipmap other(3);
        other.update(camera, kLight, kAllTiles);
        return other.frame(camera, 1024).toMap[0];
    }());
}

// Until the new map is whole shaders read the old one.
TEST(ShadowClipmap, NoMapMixesTwoDirections) {
    ShadowClipmap clipmap(2);
    const Camera camera{.position = {500, 500, 100}};
    clipmap.update(camera, kLight, kAllTiles);
    const shared::ShadowFrame before = clipmap.frame(camera, 1024);
    const glm::vec3 later = glm::normalize(kLight + glm::vec3(0.05f, 0, 0));
    for (int frame = 0; frame < 15; ++frame) {
        for (const ShadowTiles& tiles : clipmap.update(camera, later, 4))
            EXPECT_NE(tiles.layer, static_cast<int>(before.layers[0])) << frame;
        EXPECT_EQ(clipmap.frame(camera, 1024).layers[0], before.layers[0]) << frame;
    }
    clipmap.update(camera, later, 4);
    EXPECT_NE(clipmap.frame(camera, 1024).layers[0], before.layers[0]);
    EXPECT_NE(clipmap.frame(camera, 1024).toMap[0], before.toMap[0]);
    EXPECT_EQ(clipmap.frame(camera, 1024).toMap[3], before.toMap[3]) << "the other cascade follows";
}

TEST(ShadowClipmap, ChangesAreDrawnWhereTheyCast) {
    ShadowClipmap clipmap(1);
    const Camera camera{.position = {500, 500, 100}};
    clipmap.update(camera, {0, 0, 1}, kAllTiles);
    clipmap.markChanged({{31, 31}, 90, 100});
    const int drawn = tilesOf(clipmap.update(camera, {0, 0, 1}, kAllTiles));
    EXPECT_GE(drawn, 1);
    EXPECT_LE(drawn, 9) << "16 blocks touch at most three tiles of 14.5 along a side";
    clipmap.markChanged({{51, 31}, 90, 100});
    EXPECT_EQ(tilesOf(clipmap.update(camera, {0, 0, 1}, kAllTiles)), 0) << "too far away";
}

}  // namespace
}  // namespace terrane::render

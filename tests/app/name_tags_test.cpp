#include "apps/terrane/window/hud/name_tags.h"

#include <gtest/gtest.h>

#include "tests/world/content_blocks.h"
#include "tests/world/put_block.h"

namespace terrane::app {
namespace {

constexpr Screen kScreen{640, 360};

class NameTags : public testing::Test {
  protected:
    NameTags() {
        for (int y = -1; y <= 1; ++y)
            for (int x = -1; x <= 4; ++x) world_.insert({x, y}, std::make_shared<world::Chunk>());
    }

    std::vector<ShownName> shown(const std::vector<NameTag>& names) {
        names_ = names;
        return shownNames(kScreen, camera_, names_, {world_, contentBlocks()});
    }
    // A wall 5 blocks in front of the camera.
    void wallOf(std::string_view block) {
        for (int z = 95; z < 106; ++z)
            for (int y = -8; y < 8; ++y) world::putBlock(world_, {5, y, z}, contentBlock(block));
    }

    world::World world_;
    render::Camera camera_{.position = {0.5, 0.5, 100}, .yaw = 0, .pitch = 0};
    std::vector<NameTag> names_;
};

TEST_F(NameTags, StandOverTheHead) {
    const auto names = shown({{"Ada", {10.5, 0.5, 100}}});
    ASSERT_EQ(names.size(), 1u);
    EXPECT_EQ(names[0].tag->name, "Ada");
    EXPECT_NEAR(names[0].at.x, 320, 0.01);
    EXPECT_LT(names[0].at.y, 175);
    EXPECT_GT(names[0].at.y, 150);
}

TEST_F(NameTags, AreNotShownBehindOrBesideTheCameraOrFarAway) {
    EXPECT_TRUE(shown({{"behind", {-9.5, 0.5, 100}}}).empty());
    EXPECT_TRUE(shown({{"beside", {1.5, 20.5, 100}}}).empty());
    EXPECT_TRUE(shown({{"far", {49, 0.5, 100}}}).empty());
    EXPECT_TRUE(shown({{"here", camera_.position}}).empty());
    EXPECT_EQ(shown({{"near", {48, 0.5, 100}}}).size(), 1u);
}

TEST_F(NameTags, GetSmallerAndFainterWithDistance) {
    const auto names = shown({{"near", {4, 0, 100}}, {"farther", {25, 1, 100}}, {"farthest", {45, 2, 100}}});
    ASSERT_EQ(names.size(), 3u);
    EXPECT_EQ(names[0].tag->name, "farthest") << "the nearest is drawn over the others";
    EXPECT_EQ(names[2].tag->name, "near");
    EXPECT_EQ(names[2].size, 1);
    EXPECT_EQ(names[2].alpha, 1);
    EXPECT_LT(names[1].size, 1);
    EXPECT_LT(names[0].size, names[1].size);
    EXPECT_GT(names[0].size, 0.55f);
    EXPECT_EQ(names[1].alpha, 1);
    EXPECT_LT(names[0].alpha, 0.5f);
}

TEST_F(NameTags, WallsHideThem) {
    for (const char* block : {"stone", "oak_leaves"}) {
        wallOf(block);
        EXPECT_TRUE(shown({{"behind the wall", {10.5, 0.5, 100}}}).empty()) << block;
    }
    EXPECT_EQ(shown({{"before the wall", {4.5, 0.5, 100}}}).size(), 1u);
}

TEST_F(NameTags, GlassWaterAndPlantsDoNot) {
    for (const char* block : {"glass", "cyan_glass", "water", "tall_grass"}) {
        wallOf(block);
        EXPECT_EQ(shown({{"behind", {10.5, 0.5, 100}}}).size(), 1u) << block;
    }
}

TEST_F(NameTags, TheNearestOfManyAreShown) {
    std::vector<NameTag> crowd;
    for (std::size_t k = 0; k < 2 * kMostNames; ++k)
        crowd.push_back({std::to_string(k), {40 - 0.25 * static_cast<double>(k), 0.5, 100}});
    const auto names = shown(crowd);
    ASSERT_EQ(names.size(), kMostNames);
    EXPECT_EQ(names.back().tag->name, std::to_string(2 * kMostNames - 1));
    EXPECT_EQ(names.front().tag->name, std::to_string(kMostNames));
}

}  // namespace
}  // namespace terrane::app

#include "terrane/game/sounds.h"

#include <gtest/gtest.h>

#include <memory>

#include "tests/world/content_blocks.h"
#include "tests/world/put_block.h"

namespace terrane::game {
namespace {

// Air over 3×3 chunks.
class AmbienceTest : public testing::Test {
  protected:
    AmbienceTest() {
        for (int n = 0; n < 9; ++n) world_.insert({n % 3 - 1, n / 3 - 1}, std::make_shared<world::Chunk>());
    }
    void fill(world::BlockPos from, world::BlockPos to, std::string_view name) {
        for (int z = from.z; z <= to.z; ++z)
            for (int y = from.y; y <= to.y; ++y)
                for (int x = from.x; x <= to.x; ++x) world::putBlock(world_, {x, y, z}, contentBlock(name));
    }
    Ambience at(const glm::dvec3& ears, int seaLevel = 80) const {
        return ambienceAt(world_, contentBlocks(), ears, seaLevel);
    }

    world::World world_;
};

TEST_F(AmbienceTest, WindGrowsWithHeight) {
    const float valley = at({8, 8, 60}).wind, hill = at({8, 8, 120}).wind, peak = at({8, 8, 210}).wind;
    EXPECT_GT(valley, 0);
    EXPECT_GT(hill, 1.5f * valley);
    EXPECT_GT(peak, hill);
    EXPECT_FLOAT_EQ(peak, 1);
    EXPECT_EQ(at({8, 8, 20}, 40).wind, valley) << "above the sea, wherever that is";
}

TEST_F(AmbienceTest, NoWindUnderARoof) {
    fill({-8, -8, 124}, {24, 24, 124}, "stone");
    EXPECT_EQ(at({8, 8, 120}).wind, 0);
    EXPECT_GT(at({8, 8, 126}).wind, 0);
    fill({8, -8, 124}, {24, 24, 124}, "air");
    const float half = at({8, 8, 120}).wind;
    EXPECT_GT(half, 0);
    EXPECT_LT(half, at({8, 8, 126}).wind);
}

TEST_F(AmbienceTest, WaterIsHeardNearItsSurface) {
    EXPECT_EQ(at({8, 8, 72}).water, 0);
    fill({12, -16, 60}, {30, 30, 69}, "water");
    const Ambience shore = at({8, 8, 72});
    EXPECT_GT(shore.water, 0);
    ASSERT_TRUE(shore.waterAt);
    EXPECT_GE(shore.waterAt->x, 12);
    EXPECT_NEAR(shore.waterAt->z, 70, 1e-9);
    EXPECT_LT(at({2, 8, 72}).water, shore.water) << "less of it";
    EXPECT_EQ(at({-2, 8, 72}).water, 0);
    EXPECT_EQ(at({8, 8, 90}).water, 0) << "far above";
}

TEST_F(AmbienceTest, CoveredWaterIsNotHeard) {
    fill({4, 4, 60}, {12, 12, 69}, "water");
    fill({4, 4, 70}, {12, 12, 70}, "stone");
    EXPECT_EQ(at({8, 8, 72}).water, 0);
}

TEST_F(AmbienceTest, FallsAreLouderThanStreams) {
    fill({10, 4, 69}, {12, 12, 69}, "water");
    for (int y = 4; y <= 12; ++y)
        for (int x = 10; x <= 12; ++x) world::putState(world_, {x, y, 69}, 3);
    const float stream = at({2, 8, 72}).water;
    ASSERT_GT(stream, 0);
    fill({10, 8, 70}, {10, 8, 90}, "white_water");
    EXPECT_GT(at({2, 8, 72}).water, stream);
    EXPECT_GT(at({2, 8, 84}).water, 0) << "along its whole height";
}

TEST_F(AmbienceTest, StreamsAreLouderThanLakes) {
    fill({10, 4, 69}, {12, 12, 69}, "water");
    const float lake = at({8, 8, 72}).water;
    for (int y = 4; y <= 12; ++y)
        for (int x = 10; x <= 12; ++x) world::putState(world_, {x, y, 69}, 3);
    EXPECT_GT(at({8, 8, 72}).water, 2 * lake);
}

TEST_F(AmbienceTest, UnderWaterThereIsNoWind) {
    fill({-8, -8, 150}, {24, 24, 200}, "water");
    const Ambience deep = at({8, 8, 180});
    EXPECT_EQ(deep.wind, 0);
    EXPECT_GT(deep.water, 0);
    EXPECT_FALSE(deep.waterAt);
}

}  // namespace
}  // namespace terrane::game

#include "terrane/gen/language/voxel_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <tuple>
#include <vector>

#include "tests/gen/stamp_fixture.h"

namespace terrane::gen {
namespace {

ShapeVoxel voxel(int x, int y, int z, int block = 0) {
    return {static_cast<std::int8_t>(x), static_cast<std::int8_t>(y), static_cast<std::int8_t>(z),
            static_cast<std::uint8_t>(block)};
}

// A post of wood with a square crown of leaves, 2 · half + 1 blocks wide and high.
VoxelShape lollipop(int height, int half) {
    VoxelShape shape = {"lollipop", {{"stone", 1}, {"dirt", 0}}, {}};
    for (int z = 0; z <= height; ++z) shape.voxels.push_back(voxel(0, 0, z));
    for (int z = height - half; z <= height + half; ++z) {
        for (int y = -half; y <= half; ++y) {
            for (int x = -half; x <= half; ++x) {
                if (x != 0 || y != 0 || z > height) shape.voxels.push_back(voxel(x, y, z, 1));
            }
        }
    }
    return shape;
}

TEST(VoxelShape, StatisticsAreTheAreaFromAboveAndTheHighestVoxel) {
    const ShapeStatistics statistics = statisticsOf(lollipop(7, 2));
    EXPECT_EQ(statistics.cover, 25);
    EXPECT_EQ(statistics.height, 9);
    EXPECT_EQ(statisticsOf({"pit", {{"stone", 0}}, {voxel(0, 0, -2)}}).height, 0);
}

TEST(VoxelShape, OfLevel0IsTheShapeItself) {
    const VoxelShape shape = randomShape(3, 5, 100);
    EXPECT_EQ(coarsened(shape, 0).voxels, shape.voxels);
}

// As blocks are: one of two blocks before the middle of a column, one behind it.
TEST(VoxelShape, TheFootStandsBehindTheMiddleOfItsColumn) {
    VoxelShape shape = {"slab", {{"stone", 1}}, {}};
    for (int x = -1; x <= 2; ++x) {
        for (int y = -1; y <= 0; ++y) shape.voxels.push_back(voxel(x, y, 0));
    }
    EXPECT_EQ(coarsened(shape, 1).voxels, (std::vector<ShapeVoxel>{voxel(0, 0, 0), voxel(1, 0, 0)}));
}

TEST(VoxelShape, CoarsenedKeepsItsAreaAndItsHeight) {
    for (int half = 2; half <= 8; ++half) {
        const VoxelShape shape = lollipop(12, half);
        const ShapeStatistics statistics = statisticsOf(shape);
        for (int level = 1; level <= 3; ++level) {
            const int area = 1 << (2 * level);
            const ShapeStatistics coarse = statisticsOf(coarsened(shape, level));
            EXPECT_LE(std::abs(coarse.cover * area - statistics.cover), area)
                << half << " at level " << level;
            EXPECT_EQ(coarse.height, statistics.height) << half << " at level " << level;
        }
    }
}

TEST(VoxelShape, CoarsenedHoldsNoPlaceTwiceAndStaysInBounds) {
    for (std::uint32_t seed = 0; seed < 8; ++seed) {
        for (int level = 1; level <= 5; ++level) {
            const VoxelShape coarse = coarsened(randomShape(seed, 16, 600), level);
            std::set<std::tuple<int, int, int>> seen;
            for (const ShapeVoxel& v : coarse.voxels) {
                EXPECT_TRUE(seen.insert({v.x, v.y, v.z}).second);
                EXPECT_LE(std::max(std::abs(v.x), std::abs(v.y)), (16 >> level) + 1);
            }
            EXPECT_FALSE(coarse.voxels.empty());
        }
    }
}

TEST(VoxelShape, WoodStandsBelowTheCrownUpToColumnsOfTwoBlocks) {
    for (int level = 1; level <= 3; ++level) {
        const VoxelShape coarse = coarsened(lollipop(10, 3), level);
        for (int z = 0; z <= 6; ++z) {
            const auto here = std::find_if(coarse.voxels.begin(), coarse.voxels.end(),
                                           [&](ShapeVoxel v) { return v.x == 0 && v.y == 0 && v.z == z; });
            ASSERT_NE(here, coarse.voxels.end()) << "level " << level << ", z " << z;
            EXPECT_EQ(here->block, level == 1 ? 0 : 1);
        }
    }
}

}  // namespace
}  // namespace terrane::gen

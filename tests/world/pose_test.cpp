#include "terrane/world/pose.h"

#include <gtest/gtest.h>

namespace terrane::world {
namespace {

TEST(BlockOf, IsTheBlockThatAPositionLiesIn) {
    EXPECT_EQ(blockOf({0.0, 0.999, 70.5}), (BlockPos{0, 0, 70}));
    EXPECT_EQ(blockOf({-0.001, -1.0, -1.5}), (BlockPos{-1, -1, -2}));
    EXPECT_EQ(blockOf({2147483647.5, -2147483648.0, 255.0}), (BlockPos{2147483647, -2147483647 - 1, 255}));
}

}  // namespace
}  // namespace terrane::world

#include "terrane/world/pose.h"

#include <gtest/gtest.h>

#include <limits>

namespace terrane::world {
namespace {

TEST(BlockOf, IsTheBlockThatAPositionLiesIn) {
    EXPECT_EQ(blockOf({0.0, 0.999, 70.5}), (BlockPos{0, 0, 70}));
    EXPECT_EQ(blockOf({-0.001, -1.0, -1.5}), (BlockPos{-1, -1, -2}));
    EXPECT_EQ(blockOf({2147483647.5, -2147483648.0, 255.0}), (BlockPos{2147483647, -2147483647 - 1, 255}));
}

// Players of other programs and files of saves may be anywhere.
TEST(BlockOf, OfPositionsBeyondTheWorldIsTheNearestNumber) {
    constexpr std::int32_t kLow = std::numeric_limits<std::int32_t>::min(),
                           kHigh = std::numeric_limits<std::int32_t>::max();
    EXPECT_EQ(blockOf({2147483648.0, -2147483648.5, 1e300}), (BlockPos{kHigh, kLow, kHigh}));
    EXPECT_EQ(blockOf({-1e300, 1e10, -1e300}), (BlockPos{kLow, kHigh, kLow}));
    EXPECT_FALSE(isInWorld(chunkOf(glm::dvec3(2147483648.0, 0, 0))));
    EXPECT_FALSE(isInWorld(chunkOf(glm::dvec3(0, -2147483648.5, 0))));
    EXPECT_FALSE(isInWorld(chunkOf(glm::dvec3(1e300, 0, 0))));
    EXPECT_FALSE(isInWorld(chunkOf(glm::dvec3(-1e300, 0, 0))));
}

}  // namespace
}  // namespace terrane::world

#include "terrane/net/wire/client_message.h"

#include <gtest/gtest.h>

#include "terrane/stream/tile_table.h"

namespace terrane::net {
namespace {

TEST(ViewRange, OneChunkMoreThanTheViewDistance) {
    const View view{{5, -7}, 4, 0};
    for (int distance = 0; distance < 10; ++distance) {
        EXPECT_EQ(isInView(view, {5 + distance, -7}), distance <= 5) << distance;
        EXPECT_EQ(isInView(view, {5, -7 - distance}, 1), distance <= 6) << distance;
    }
    EXPECT_EQ(topLevelOf(view), 0) << "no horizon, no tiles";
}

TEST(ViewRange, TilesAreSeenFromThreeToThirtyThreeAndToTheHorizon) {
    const View view{{0, 0}, 4, 128};
    ASSERT_GE(topLevelOf(view), 3);
    for (std::uint8_t level = 1; level <= 3; ++level) {
        const int last = std::min(33, (128 >> level) + 1);
        for (int distance = 0; distance < 80; ++distance) {
            EXPECT_EQ(isInView(view, {distance, 0, level}), distance >= 3 && distance <= last)
                << int{level} << ' ' << distance;
            EXPECT_EQ(isInView(view, {0, distance, level}, 1), distance >= 2 && distance <= last + 1)
                << int{level} << ' ' << distance;
        }
    }
}

TEST(ViewRange, AServerLimitsTheView) {
    const View served = servedView({{1, 2}, 200, 65535}, 32);
    EXPECT_EQ(served.center, (world::ChunkPos{1, 2}));
    EXPECT_EQ(served.viewDistance, 32);
    EXPECT_EQ(served.horizon, stream::kMaxHorizon);
    EXPECT_EQ(servedView({{}, 8, 64}, 32).viewDistance, 8);
    EXPECT_EQ(servedView({{}, 8, 64}, 32).horizon, 64);
}

}  // namespace
}  // namespace terrane::net

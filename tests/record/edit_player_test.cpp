#include "apps/terrane/record/edit_player.h"

#include <gtest/gtest.h>

#include <set>

namespace terrane::app {
namespace {

constexpr EditCue kBox{.time = 0, .seconds = 4, .low = {-1, 5, 70}, .high = {1, 6, 73}, .block = 1};

TEST(EditPlayer, ABoxIsBuiltFromBelow) {
    std::set<world::BlockPos> seen;
    int z = kBox.low.z;
    for (std::int64_t n = 0; n < kBox.count(); ++n) {
        const world::BlockPos pos = blockOf(kBox, n);
        EXPECT_GE(pos.z, z);
        z = pos.z;
        EXPECT_TRUE(seen.insert(pos).second) << n;
        EXPECT_TRUE(pos.x >= -1 && pos.x <= 1 && pos.y >= 5 && pos.y <= 6 && pos.z <= 73) << n;
    }
    EXPECT_EQ(seen.size(), 24u);
}

TEST(EditPlayer, BlocksComeOneAfterTheOther) {
    EXPECT_EQ(blocksDone(kBox, -0.1), 0);
    EXPECT_EQ(blocksDone(kBox, 0), 0);
    EXPECT_EQ(blocksDone(kBox, 1), 6);
    EXPECT_EQ(blocksDone(kBox, 3.99), 23);
    EXPECT_EQ(blocksDone(kBox, 4), 24);
    EXPECT_EQ(blocksDone(kBox, 100), 24);
}

TEST(EditPlayer, WithoutTimeAllComeAtOnce) {
    EditCue edit = kBox;
    edit.seconds = 0;
    EXPECT_EQ(blocksDone(edit, -0.01), 0);
    EXPECT_EQ(blocksDone(edit, 0), 24);
}

}  // namespace
}  // namespace terrane::app

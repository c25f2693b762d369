#include "apps/terrane/record/recorder.h"

#include <gtest/gtest.h>

namespace terrane::app {
namespace {

const EditCue kBox{.time = 0, .seconds = 4, .box = {{-1, 5, 70}, {1, 6, 73}}, .block = 1};

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

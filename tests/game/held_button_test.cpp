#include "terrane/game/block_interaction.h"

#include <gtest/gtest.h>

namespace terrane::game {
namespace {

int actions(HeldButton& button, int frames, double seconds) {
    int count = 0;
    for (int k = 0; k < frames; ++k) count += button.acts(seconds) ? 1 : 0;
    return count;
}

TEST(HeldButton, ActsAtOnceAndAgainAfterAPause) {
    HeldButton button;
    EXPECT_FALSE(button.acts(1));
    button.press();
    EXPECT_TRUE(button.acts(0.01));
    EXPECT_FALSE(button.acts(HeldButton::kFirstPause - 0.01));
    EXPECT_TRUE(button.acts(0.02));
    EXPECT_FALSE(button.acts(HeldButton::kPause - 0.01));
    EXPECT_TRUE(button.acts(0.02));
    button.release();
    EXPECT_EQ(actions(button, 10, 1), 0);
}

TEST(HeldButton, APressWithinAFrameActsOnce) {
    HeldButton button;
    button.press();
    button.release();
    EXPECT_FALSE(button.isDown());
    EXPECT_EQ(actions(button, 10, 1), 1);
}

TEST(HeldButton, ALongFrameActsOnce) {
    HeldButton button;
    button.press();
    EXPECT_EQ(actions(button, 1, 100), 1);
    EXPECT_EQ(actions(button, 3, 100), 3);
}

TEST(HeldButton, WhatIsCancelledDoesNotAct) {
    HeldButton button;
    button.press();
    button.cancel();
    EXPECT_FALSE(button.isDown());
    EXPECT_EQ(actions(button, 10, 1), 0);
}

}  // namespace
}  // namespace terrane::game

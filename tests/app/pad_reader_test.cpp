#include "apps/terrane/window/input.h"

#include <gtest/gtest.h>

namespace terrane::app {
namespace {

TEST(PadReader, TellsWhatHappenedSinceTheFrameBefore) {
    PadReader pad;
    EXPECT_FALSE(pad.isPressed(&Gamepad::north));
    pad.read(Gamepad{.north = true});
    EXPECT_TRUE(pad.isPressed(&Gamepad::north));
    EXPECT_FALSE(pad.isPressed(&Gamepad::south));
    pad.read(Gamepad{.north = true});
    EXPECT_FALSE(pad.isPressed(&Gamepad::north)) << "it is held";
    EXPECT_FALSE(pad.isReleased(&Gamepad::north));
    pad.read(Gamepad{});
    EXPECT_TRUE(pad.isReleased(&Gamepad::north));
}

TEST(PadReader, APadThatIsPulledOutLetsGo) {
    PadReader pad;
    game::HeldButton held;
    pad.read(Gamepad{.leftX = 1, .rightTrigger = true});
    pad.drive(held, &Gamepad::rightTrigger);
    EXPECT_TRUE(held.isDown());
    pad.read(std::nullopt);
    pad.drive(held, &Gamepad::rightTrigger);
    EXPECT_FALSE(held.isDown());
    EXPECT_EQ(pad.now().leftX, 0);
}

TEST(PadReader, AHeldMouseButtonStaysHeld) {
    PadReader pad;
    game::HeldButton held;
    held.press();
    for (int frame = 0; frame < 3; ++frame) {
        pad.read(Gamepad{});
        pad.drive(held, &Gamepad::rightTrigger);
    }
    EXPECT_TRUE(held.isDown());
}

}  // namespace
}  // namespace terrane::app

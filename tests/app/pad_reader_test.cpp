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
    pad.read(Gamepad{});
}

TEST(PadReader, APadThatIsUnpluggedLetsGo) {
    PadReader pad;
    pad.read(Gamepad{.leftX = 1, .rightTrigger = true});
    EXPECT_TRUE(pad.isDown(PadButton::RightTrigger));
    EXPECT_TRUE(pad.isAnyDown());
    pad.read(std::nullopt);
    EXPECT_FALSE(pad.isDown(PadButton::RightTrigger));
    EXPECT_FALSE(pad.isAnyDown());
    EXPECT_EQ(pad.pressed(), std::nullopt);
    EXPECT_EQ(pad.now().leftX, 0);
}

TEST(DoublePress, IsTwoPressesWithinAShortTime) {
    DoublePress keys;
    EXPECT_FALSE(keys.press(1));
    EXPECT_TRUE(keys.press(0.99 + DoublePress::kWithin));
    EXPECT_FALSE(keys.press(1.4)) << "the third one begins anew";
    EXPECT_TRUE(keys.press(1.4)) << "both in one frame";
    EXPECT_FALSE(keys.press(2));
    EXPECT_FALSE(keys.press(2.01 + DoublePress::kWithin)) << "too late";
    EXPECT_TRUE(keys.press(2.5));
}

TEST(UnknownPads, EachIsToldOnce) {
    UnknownPads pads;
    const UnknownPads::Joystick known{"03", "Pad", true}, wheel{"07", "Wheel", false};
    EXPECT_TRUE(pads.take({}, "db.txt").empty());
    const std::vector<UnknownPads::Joystick> both = {known, wheel};
    const auto lines = pads.take(both, "db.txt");
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_EQ(lines[0],
              "Wheel (joystick 07) is not used: its buttons are not known; add its line of SDL's "
              "gamecontrollerdb.txt to db.txt and start again");
    EXPECT_TRUE(pads.take(both, "db.txt").empty());
    EXPECT_TRUE(pads.take({}, "db.txt").empty()) << "unplugged";
    EXPECT_TRUE(pads.take(both, "db.txt").empty()) << "and plugged in again";
}

}  // namespace
}  // namespace terrane::app

// A new player's first minutes: a world from the title, a house, a pond, undo, quit and continue.
#include <algorithm>

#include "tests/window/window_fixture.h"

namespace terrane::app {
namespace {

// The house is in the air, above the terrain of every generator: a floor of two layers, and a wall at the
// back.
constexpr int kFloor = 231, kEyes = 235;
constexpr world::BlockPos kStairs{3, 3, kFloor + 1}, kDoor{5, 3, kFloor + 1}, kTorch{7, 3, kFloor + 1},
    kLamp{3, 6, kFloor + 1}, kPond{7, 6, kFloor}, kMistake{5, 6, kFloor + 1};

class FirstMinutesTest : public WindowTest {
  protected:
    static void go(Program& program, const world::Pose& pose) {
        program.game().player.placeAt(pose, program.game().settings.movement);
        program.frames(2);
    }
    static void lookDownOn(Program& program, world::BlockPos pos) {
        go(program, {{pos.x + 0.5, pos.y + 0.5, kEyes}, 90, -89});
    }
    static void fill(Program& program, world::BlockPos from, world::BlockPos to, Key slot) {
        for (const auto& [corner, button] : {std::pair(from, MouseButton::Left), {to, MouseButton::Right}}) {
            go(program, {{corner.x + 0.5, corner.y + 0.5, corner.z + 0.5}, 90, -20});
            program.tap(button, {.shift = true});
        }
        program.press(slot);
        program.press(Key::G);
        program.until("the box is filled", [&] { return program.blockAt(to) != "air"; });
    }
    static void build(Program& program, world::BlockPos pos, const std::string& name) {
        lookDownOn(program, pos);
        program.tap(MouseButton::Right);
        program.until(name, [&] { return program.blockAt(pos) == name; });
    }
    // Takes a block from the palette into the hand.
    static void take(Program& program, const std::string& search, const std::string& name) {
        program.press(Key::Tab);
        program.widget("##search");
        program.type(search);
        program.press(Key::Enter);
        EXPECT_EQ(program.session().blocks().type(program.game().interaction.block()).name, name);
    }

    void expectAllIsThere(const std::string& world) const {
        const auto there = [&](world::BlockPos pos) { return savedBlock(world, pos); };
        EXPECT_EQ(there({1, 1, kFloor - 1}), "stone_bricks");
        EXPECT_EQ(there({10, 10, kFloor}), "stone_bricks");
        EXPECT_EQ(there({1, 10, kFloor + 1}), "glass");
        EXPECT_EQ(there({10, 10, kFloor + 3}), "glass");
        EXPECT_EQ(there(kStairs), "oak_stairs");
        EXPECT_EQ(there(kDoor), "oak_door");
        EXPECT_EQ(there({kDoor.x, kDoor.y, kDoor.z + 1}), "oak_door_top");
        EXPECT_EQ(there(kTorch), "torch");
        EXPECT_EQ(there(kLamp), "lamp_white");
        EXPECT_EQ(there(kPond), "water");
        EXPECT_EQ(there(kMistake), "air");
    }
};

TEST_F(FirstMinutesTest, AHouseAndAPond) {
    {
        Program program = start();
        program.click("New world");
        program.click("Create");
        program.untilDrawn();
        program.tap(MouseButton::Left);  // captures the mouse
        program.press(Key::M);           // flight
        program.press(Key::M);           // through everything
        program.press(Key::B);
        fill(program, {1, 1, kFloor - 1}, {10, 10, kFloor}, Key::Digit3);       // a floor of stone bricks
        fill(program, {1, 10, kFloor + 1}, {10, 10, kFloor + 3}, Key::Digit4);  // a wall of glass
        program.press(Key::B);
        program.press(Key::Digit5);
        build(program, kStairs, "oak_stairs");
        program.press(Key::Digit7);
        build(program, kDoor, "oak_door");
        program.press(Key::Digit8);
        build(program, kTorch, "torch");
        take(program, "white lamp", "lamp_white");
        build(program, kLamp, "lamp_white");
        lookDownOn(program, kPond);
        program.tap(MouseButton::Left);
        program.until("a hole", [&] { return program.blockAt(kPond) == "air"; });
        take(program, "water", "water");
        build(program, kPond, "water");
        program.press(Key::Digit2);
        build(program, kMistake, "cobble");
        program.press(Key::Z, {.control = true});
        program.until("the mistake is undone", [&] { return program.blockAt(kMistake) == "air"; });
        expectGood(program.quit());
        expectAllIsThere("World");
    }
    Program program = start();
    program.click("Continue World");
    program.untilDrawn();
    EXPECT_EQ(program.blockAt(kLamp), "lamp_white");
    expectGood(program.quit());
    expectAllIsThere("World");
}

// Whether the hint is shown; it may not be on the crosshair.
bool isHintShown(Program& program) {
    program.frames(3);  // until it has its size
    if (!program.isShown("overlay", "hint")) return false;
    const Widget& hint = program.widget("overlay", "hint");
    const glm::vec2 middle = glm::vec2(program.window().size()) / 2.0f;
    constexpr float kCrosshair = 8;
    EXPECT_TRUE(hint.max.x < middle.x - kCrosshair || hint.max.y < middle.y - kCrosshair)
        << hint.max.x << "," << hint.max.y;
    EXPECT_GE(hint.min.x, 0);
    EXPECT_GT(hint.max.x, hint.min.x + 50);
    return true;
}

TEST_F(FirstMinutesTest, AHintIsShownOnTheFirstStartOnly) {
    showsHint_ = true;
    {
        Program program = start({"--text-size", "1.5"});
        program.click("New world");
        program.click("Create");
        program.untilDrawn();
        EXPECT_TRUE(isHintShown(program));
        EXPECT_LE(program.game().notices.helpSeconds, 0) << "the list of keys is long";
        program.press(Key::F1);
        EXPECT_GT(program.game().notices.helpSeconds, 0);
        EXPECT_FALSE(isHintShown(program));
        program.press(Key::F1);
        EXPECT_TRUE(isHintShown(program));
        program.game().notices.hintSeconds = OffscreenWindow::kFrameSeconds;
        EXPECT_FALSE(isHintShown(program));
        expectGood(program.quit());
    }
    EXPECT_EQ(std::ranges::count(settingsLines(), "hint-seen = 'true'"), 1);
    Program program = start();
    program.click("Continue World");
    program.untilDrawn();
    EXPECT_FALSE(isHintShown(program));
    EXPECT_LE(program.game().notices.helpSeconds, 0);
    expectGood(program.quit());
}

}  // namespace
}  // namespace terrane::app

// A survival world in the window: items, crafting, chests, and what a save keeps of them.
#include "terrane/game/items.h"
#include "tests/window/window_fixture.h"

namespace terrane::app {
namespace {

class ItemsTest : public WindowTest {
  protected:
    // A world below which the player looks at the ground.
    Program survive(const std::string& items) {
        makeWorld("home", {{"camera", "8.5 8.5 85 0 -89"},
                           {"movement", "noclip"},
                           {"mode", "survival"},
                           {"items", "world" + items}});
        return play("home");
    }
    static void takeMouse(Program& program) {
        program.untilDrawn();
        program.tap(MouseButton::Left);
        program.until("the mouse is taken", [&] { return program.game().input.isCaptured; });
    }
    static world::Inventory slots(Program& program) {
        return program.session().itemsOf(game::kLocalPlayer).slots;
    }
    static int count(Program& program, const char* item) { return world::countItems(slots(program), item); }
};

TEST_F(ItemsTest, BlocksAreBrokenOverTimeAndPlaced) {
    {
        Program program = survive("");
        takeMouse(program);
        program.tap(MouseButton::Left);
        program.frames(3);
        EXPECT_EQ(program.blockAt(kGround), "grass") << "a click is too short";
        program.hold(MouseButton::Left);
        program.until("the ground is broken", [&] { return program.blockAt(kGround) == "air"; });
        program.release(MouseButton::Left);
        EXPECT_EQ(count(program, "dirt"), 1);
        program.tap(MouseButton::Right);
        program.until("dirt is placed", [&] { return program.blockAt(kGround) == "dirt"; });
        EXPECT_EQ(count(program, "dirt"), 0);
        program.tap(MouseButton::Right);
        program.frames(3);
        expectGood(program.quit());
    }
    EXPECT_EQ(savedBlock("home", kGround), "dirt");
}

TEST_F(ItemsTest, PlanksAreCraftedByClicks) {
    Program program = survive("\n0 3 0 oak_log");
    takeMouse(program);
    program.press(Key::Tab);
    program.widget("Items");
    program.click("own", "0 3 oak_log");
    program.click("grid", "36 0 ");
    program.until("the logs lie in the grid", [&] { return slots(program)[36].count == 3; });
    program.click("made", "4 oak_planks");
    program.click("made", "4 oak_planks");
    program.until("planks are made", [&] { return count(program, "oak_planks") == 8; });
    EXPECT_EQ(slots(program)[36], (world::ItemStack{"oak_log", 1}));
    program.press(Key::Escape);
    program.frames(2);
    EXPECT_EQ(slots(program)[36], world::ItemStack{}) << "the grid is cleared";
    EXPECT_EQ(count(program, "oak_log"), 1);
    expectGood(program.quit());
}

TEST_F(ItemsTest, StacksGoIntoAChestAndBack) {
    constexpr world::BlockPos kChest{8, 8, 81};
    Program program = survive("\n0 1 0 chest\n1 9 0 coal");
    const auto held = [&] {
        return game::itemsOf(program.session().world(), program.session().blocks(), kChest).value();
    };
    takeMouse(program);
    program.tap(MouseButton::Right);
    program.until("a chest is built", [&] { return program.blockAt(kChest) == "chest"; });
    program.tap(MouseButton::Right);
    program.widget("Chest");
    program.click("own", "1 9 coal", 0.5, MouseButton::Right);  // half
    program.click("chest", "4 0 ");
    program.until("coal is in the chest", [&] { return held()[4].count == 5; });
    EXPECT_EQ(slots(program)[1].count, 4);
    program.click("chest", "4 5 coal");
    program.click("own", "20 0 ", 0.5, MouseButton::Right);  // one
    program.until("one is taken", [&] { return slots(program)[20].count == 1; });
    EXPECT_EQ(held()[4].count, 4);
    program.press(Key::Escape);
    program.frames(2);
    EXPECT_EQ(count(program, "coal") + held()[4].count, 9);
    expectGood(program.quit());
}

TEST_F(ItemsTest, CommandsGiveAndChangeTheMode) {
    makeWorld("home");
    Program program = play("home");
    takeMouse(program);
    const auto say = [&](const std::string& line) {
        program.press(Key::T);
        program.widget("##chat");
        program.type(line);
        program.press(Key::Enter);
    };
    say("/give bread 2");
    program.until("bread", [&] { return count(program, "bread") == 2; });
    say("/mode survival");
    program.until("the mode", [&] { return program.isShown("chat line", "you are in survival"); });
    takeMouse(program);
    program.tap(MouseButton::Right);
    program.until("bread is eaten", [&] { return count(program, "bread") == 1; });
    expectGood(program.quit());
}

}  // namespace
}  // namespace terrane::app

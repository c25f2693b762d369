// The selection tool, signs, the palette, named places, screenshots.
#include <fmt/format.h>

#include "terrane/world/blocks/sign.h"
#include "tests/window/window_fixture.h"

namespace terrane::app {
namespace {

// Blocks of this name above the ground near the player.
int countOf(Program& program, const std::string& name) {
    const game::Session& session = program.session();
    const world::BlockId block = session.blocks().find(name)->id;
    int count = 0;
    for (int x = -4; x < 24; ++x)
        for (int y = -8; y < 24; ++y)
            for (int z = 81; z < 90; ++z) count += session.world().block({x, y, z}) == block ? 1 : 0;
    return count;
}

class BuildingTest : public WindowTest {
  protected:
    // In the air, with the named block in the hand and the mouse captured.
    Program playWith(const std::string& hand, const std::string& camera) {
        makeWorld("home", {{"camera", camera}, {"movement", "medium"}, {"hotbar", "0 " + hand}});
        return play("home");
    }

    static void takeMouse(Program& program) {
        program.untilDrawn();
        program.tap(MouseButton::Left);
    }

    static void go(Program& program, const world::Pose& pose) {
        program.game().player.placeAt(pose, program.game().settings.movement);
        program.frames();
    }

    // Selects a box of 6 x 2 x 4 blocks in front of the player.
    static void selectBox(Program& program) {
        takeMouse(program);
        program.press(Key::B);
        go(program, {{5.5, 8.5, 81.5}, 0, 0});
        program.tap(MouseButton::Left, {.shift = true});
        go(program, {{10.5, 9.5, 84.5}, 0, 0});
        program.tap(MouseButton::Right, {.shift = true});
        go(program, {{8.5, -3.5, 88.5}, 90, -35});
    }

    static void untilCount(Program& program, const std::string& name, int count) {
        program.until(fmt::format("{} {}", count, name), [&] { return countOf(program, name) == count; });
    }
};

TEST_F(BuildingTest, BoxesAreFilledCopiedAndKeptInFiles) {
    const std::filesystem::path file = data() / "structures" / "wall.structure";
    Program program = playWith("bricks", "8.5 -3.5 88.5 90 -35");
    selectBox(program);
    program.press(Key::G);
    untilCount(program, "bricks", 48);
    program.press(Key::C, {.control = true});
    program.press(Key::R);
    program.press(Key::V, {.control = true});
    program.press(Key::S, {.control = true});
    program.type("wall");
    program.press(Key::Enter);
    program.until("the file is written", [&] { return exists(file); });
    program.press(Key::Delete);
    untilCount(program, "bricks", 0);
    program.tap(MouseButton::Left);  // places the copy
    untilCount(program, "bricks", 48);
    program.press(Key::O, {.control = true});
    program.widget("wall");
    program.press(Key::Enter);
    program.tap(MouseButton::Left);  // in front of the existing blocks
    program.until("more blocks", [&] { return countOf(program, "bricks") > 48; });
    program.press(Key::Z, {.control = true});
    untilCount(program, "bricks", 48);
    program.press(Key::Y, {.control = true});
    program.until("the blocks again", [&] { return countOf(program, "bricks") > 48; });
    program.press(Key::Escape);  // ends pasting
    program.press(Key::Escape);  // closes the tool
    EXPECT_FALSE(program.game().building.isSelecting());
    expectGood(program.quit());
    EXPECT_GT(file_size(file), 40u);
}

TEST_F(BuildingTest, TheWheelChangesTheHeightOfTheBox) {
    Program program = playWith("bricks", "8.5 -3.5 88.5 90 -35");
    selectBox(program);  // 6 x 2 x 4 blocks
    const std::size_t slot = program.game().interaction.hotbar.selected;
    const auto turn = [&](double steps, bool withShift) {
        program.hold(Key::Control);
        if (withShift) program.hold(Key::Shift);
        program.turnWheel(steps);
        program.release(Key::Control);
        if (withShift) program.release(Key::Shift);
    };
    turn(1, false);
    EXPECT_EQ(program.game().notices.message, "height 5, from 81 to 85; 60 blocks");
    turn(-3, false);
    EXPECT_EQ(program.game().notices.message, "height 2, from 81 to 82; 24 blocks");
    turn(1, true);
    EXPECT_EQ(program.game().notices.message, "height 1, from 82 to 82; 12 blocks");
    EXPECT_EQ(program.game().interaction.hotbar.selected, slot) << "the hotbar stays";
    program.press(Key::G);
    untilCount(program, "bricks", 12);
    program.turnWheel(-1);
    EXPECT_NE(program.game().interaction.hotbar.selected, slot) << "the wheel alone is the hotbar's";
    program.press(Key::B);
    turn(-1, false);
    EXPECT_EQ(program.game().interaction.hotbar.selected, slot + 2) << "without the tool too";
    expectGood(program.quit());
}

TEST_F(BuildingTest, ShapesAreFilledClearedAndTakenBack) {
    Program program = playWith("bricks", "8.5 -3.5 88.5 90 -35");
    selectBox(program);
    go(program, {{10.5, 11.5, 84.5}, 0, 0});
    program.tap(MouseButton::Right, {.shift = true});  // 6 x 4 x 4 blocks
    go(program, {{8.5, -3.5, 88.5}, 90, -35});
    const auto fills = [&](const std::string& shape, int count) {
        program.press(Key::U);
        EXPECT_EQ(program.game().notices.message, "shape: " + shape);
        program.press(Key::G);
        untilCount(program, "bricks", count);
        program.press(Key::Z, {.control = true});
        untilCount(program, "bricks", 0);
    };
    fills("hollow", 96 - 4 * 2 * 2);
    fills("walls", 96 - 4 * 2 * 4);
    program.press(Key::U);
    EXPECT_EQ(program.game().notices.message, "shape: sphere");
    fills("line", 6);
    program.tap(MouseButton::Middle);
    program.click("Shape (U)");
    EXPECT_EQ(program.game().notices.message, "shape: box");
    program.click("Fill (G)");
    untilCount(program, "bricks", 96);
    program.click("Shape (U)");
    program.click("Clear (Del)");
    untilCount(program, "bricks", 16);
    program.tap(MouseButton::Middle);
    program.press(Key::Escape);
    expectGood(program.quit());
}

TEST_F(BuildingTest, ThePanelOfTheToolHasButtons) {
    Program program = playWith("bricks", "8.5 -3.5 88.5 90 -35");
    selectBox(program);
    program.tap(MouseButton::Middle);  // frees the cursor
    program.click("Fill (G)");
    untilCount(program, "bricks", 48);
    program.click("Clear (Del)");
    untilCount(program, "bricks", 0);
    program.tap(MouseButton::Middle);
    EXPECT_TRUE(program.game().input.isCaptured);
    program.press(Key::Escape);
    expectGood(program.quit());
}

TEST_F(BuildingTest, SignsAreWritten) {
    constexpr world::BlockPos kSign{8, 10, 81};
    const auto text = [&](Program& program) {
        const world::BlockEntityData* data = program.session().world().blockEntityData(kSign);
        return data ? world::decodeSign(*data).value() : world::SignText{};
    };
    const world::SignText kWritten{"hello", "second line", std::string(world::kSignColumns, 'm'), ""};
    {
        Program program = playWith("sign", "8.5 8.5 82.4 90 -35");
        takeMouse(program);
        program.tap(MouseButton::Right);  // builds it
        program.until("a sign", [&] { return program.blockAt(kSign) == "sign"; });
        program.tap(MouseButton::Right);  // opens it
        for (const std::string& line :
             {std::string("hello"), std::string("second line"), std::string(30, 'm')}) {
            program.widget("Done");
            program.type(line);
            program.press(Key::Down);
            program.frames(2);  // the next line takes the focus
        }
        program.press(Key::Enter);
        program.until("the text", [&] { return text(program)[0] == "hello"; });
        EXPECT_EQ(text(program), kWritten);
        // Escape keeps the former text.
        program.tap(MouseButton::Right);
        program.widget("Done");
        program.type("more");
        program.press(Key::Escape);
        EXPECT_FALSE(program.game().building.isAsking());
        expectGood(program.quit());
    }
    Program program = play("home");
    program.untilDrawn();
    EXPECT_EQ(text(program), kWritten);
    expectGood(program.quit());
}

class HudTest : public BuildingTest {
  protected:
    static std::string hotbar(Program& program) {
        return game::textOf(program.game().interaction.hotbar, program.session().blocks());
    }
    static bool starts(const std::string& text, const std::string& with) { return text.starts_with(with); }
};

TEST_F(HudTest, BlocksArePickedAndChosen) {
    Program program = playWith("bricks", kDown);
    takeMouse(program);
    program.press(Key::Digit3);
    EXPECT_PRED2(starts, hotbar(program), "2 bricks cobble stone_bricks");
    program.tap(MouseButton::Middle);  // picks the targeted block
    EXPECT_PRED2(starts, hotbar(program), "2 bricks cobble grass");
    program.press(Key::Tab);
    program.widget("##search");
    program.type("chest");
    program.press(Key::Enter);
    EXPECT_PRED2(starts, hotbar(program), "2 bricks cobble chest");
    program.press(Key::Digit5, {.control = true});  // Control sinks
    EXPECT_PRED2(starts, hotbar(program), "4 bricks");
    program.press(Key::Digit3);
    program.turnWheel(1);
    EXPECT_PRED2(starts, hotbar(program), "1 bricks");
    program.press(Key::Tab);
    program.click("##block", "Stone");
    EXPECT_EQ(program.session().blocks().type(program.game().interaction.block()).name, "stone");
    EXPECT_TRUE(program.game().input.isCaptured);
    expectGood(program.quit());
}

// Headings in the order of the groups, each above its blocks; a page of one group and a search have none.
TEST_F(HudTest, TheBlocksOfAllGroupsHaveHeadings) {
    Program program = playWith("bricks", kDown);
    takeMouse(program);
    program.press(Key::Tab);
    program.widget("heading", "Ground");
    const auto headings = [&] {
        std::vector<std::string> shown;
        float last = -1e9f;
        for (const Widget& widget : program.window().record.widgets()) {
            if (widget.label != "heading") continue;
            EXPECT_GT(widget.min.y, last);
            last = widget.min.y;
            shown.push_back(widget.value);
        }
        return shown;
    };
    const auto blockNames = [&] {
        std::vector<std::string> shown;
        for (const Widget& widget : program.window().record.widgets())
            if (widget.label == "##block") shown.push_back(widget.value);
        return shown;
    };
    EXPECT_EQ(headings().size(), game::paletteGroups(program.session().blocks()).size());
    const std::size_t all = blockNames().size();
    EXPECT_EQ(all, game::paletteBlocks(program.session().blocks(),
                                       {"", "", [](world::BlockId) { return std::string(); }})
                       .size())
        << "each block once";
    const Widget block = program.widget("##block", "Oak log");
    std::string above;
    for (const Widget& widget : program.window().record.widgets())
        if (widget.label == "heading" && widget.max.y <= block.min.y) above = widget.value;
    EXPECT_EQ(above, "Plants");
    program.click("##block", "Oak log");
    EXPECT_EQ(program.session().blocks().type(program.game().interaction.block()).name, "oak_log");
    program.press(Key::Tab);
    program.widget("##search");
    program.type("oak");
    EXPECT_TRUE(headings().empty());
    program.press(Key::Escape);
    program.press(Key::Tab);
    program.click("Wood");
    EXPECT_TRUE(headings().empty());
    EXPECT_LT(blockNames().size(), all);
    program.press(Key::Escape);
    expectGood(program.quit());
}

TEST_F(HudTest, PlacesAreNamedAndFoundAgain) {
    const std::string kPlace = "100.5 -40.5 95 180 -20";
    {
        Program program = playWith("bricks", kPlace);
        program.untilDrawn();
        const world::Pose there = program.game().player.pose();
        program.press(Key::N);
        program.widget("##name");
        program.type("far away");
        program.press(Key::Enter);
        program.widget("Go", "far away");
        program.press(Key::Escape);
        program.press(Key::F7);
        EXPECT_TRUE(program.game().hud.showsFacts);
        program.press(Key::H);  // to the spawn
        EXPECT_NE(program.game().player.pose(), there);
        program.press(Key::N);
        program.click("Go", "far away");
        EXPECT_EQ(program.game().player.pose(), there);
        expectGood(program.quit());
        EXPECT_EQ(setting("home", "places"), kPlace + " far away\n");
    }
    Program program = play("home");
    program.untilDrawn();
    program.press(Key::N);
    program.click("Remove", "far away");
    EXPECT_TRUE(program.game().hud.places.empty());
    program.press(Key::Escape);
    expectGood(program.quit());
}

TEST_F(HudTest, DistancesOfPlacesCountHeight) {
    Program program = playWith("bricks", "8.5 8.5 84 0 -20");
    program.untilDrawn();
    program.press(Key::N);
    program.widget("##name");
    program.type("below");
    program.press(Key::Enter);
    program.widget("Go", "below");
    program.press(Key::Escape);
    world::Pose above = program.game().player.pose();
    above.position.z += 100;
    program.game().player.placeAt(above, game::Movement::Fly);
    program.press(Key::N);
    program.widget("", "below  (100 m)");
    program.press(Key::Escape);
    expectGood(program.quit());
}

TEST_F(HudTest, AHeldKeyThatOpensATextFieldDoesNotTypeIntoIt) {
    Program program = playWith("bricks", kDown);
    program.untilDrawn();
    program.window().onCharacter('n');
    program.hold(Key::N);
    for (int k = 0; k < 20; ++k) {  // the system repeats the character
        program.window().onCharacter('n');
        program.frames();
    }
    program.release(Key::N);
    program.type("no");
    EXPECT_EQ(program.widget("##name").value, "no");
    program.press(Key::Enter);
    program.widget("Go", "no");
    program.press(Key::Escape);
    expectGood(program.quit());
}

TEST_F(HudTest, AScreenshotIsShownForAWhile) {
    Program program = playWith("bricks", kDown);
    program.untilDrawn();
    program.press(Key::F12);
    EXPECT_TRUE(exists(data() / "screenshots" / "terrane-0001.png"));
    EXPECT_TRUE(program.game().hud.screenshot.isShown());
    program.frames(200);  // ten seconds
    EXPECT_FALSE(program.game().hud.screenshot.isShown());
    program.press(Key::F8);
    EXPECT_TRUE(program.game().hud.isHidden);
    expectGood(program.quit());
}

}  // namespace
}  // namespace terrane::app

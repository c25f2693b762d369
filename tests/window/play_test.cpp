// A world that is played: keys, mouse, gamepad and menu, and what a save keeps.
#include <algorithm>
#include <cmath>
#include <csignal>
#include <glm/geometric.hpp>

#include "terrane/game/items.h"
#include "tests/window/window_fixture.h"

namespace terrane::app {
namespace {

class PlayTest : public WindowTest {
  protected:
    // In the world `name`, above its ground; the mouse turns the player.
    Program playAbove(const std::string& name, std::vector<std::string> arguments = {}) {
        if (!exists(worldFile(name))) makeWorld(name, {{"camera", kDown}, {"movement", "noclip"}});
        return play(name, std::move(arguments));
    }

    static void takeMouse(Program& program) {
        program.untilDrawn();
        program.tap(MouseButton::Left);
        EXPECT_TRUE(program.game().input.isCaptured);
    }

    static void breakGround(Program& program) {
        takeMouse(program);
        program.tap(MouseButton::Left);
        program.until("the block is broken", [&] { return program.blockAt(kGround) == "air"; });
    }
};

TEST_F(PlayTest, FramesFollowTheWindow) {
    Program program = playAbove("home");
    program.untilDrawn();
    EXPECT_TRUE(program.window().hasIcon);
    program.window().units = {400, 260};
    program.until("a larger image",
                  [&] { return program.game().parts.renderer.size() == glm::ivec2(400, 260); });
    program.window().isMinimised = true;
    const int drawn = program.window().framesDrawn;
    program.frames(3);
    EXPECT_EQ(program.window().framesDrawn, drawn);
    program.window().isMinimised = false;
    program.frames(2);
    EXPECT_GT(program.window().framesDrawn, drawn);
    program.window().isClosed = true;
    expectGood(program.untilEnd());
    EXPECT_NE(log().find("closed after "), std::string::npos);
}

TEST_F(PlayTest, KeysFly) {
    Program program = playAbove("home", {"--movement", "noclip"});
    program.untilDrawn();
    const glm::dvec3 start = program.game().player.pose().position;
    program.hold(Key::Shift);
    program.hold(Key::W);
    program.frames(9);  // half a second
    program.release(Key::W);
    const glm::dvec3 end = program.game().player.pose().position;
    EXPECT_NEAR(glm::distance(start, end), 30, 5);
    program.release(Key::Shift);
    program.frames(5);
    EXPECT_EQ(program.game().player.pose().position, end);
    expectGood(program.quit());
}

TEST_F(PlayTest, TheGamepadPlays) {
    Program program = playAbove("home");
    program.untilDrawn();
    const world::Pose start = program.game().player.pose();
    program.setPad(Gamepad{.leftX = 1});
    program.frames(5);
    const glm::dvec3 now = program.game().player.pose().position;
    EXPECT_GT(glm::distance(now, start.position), 1);
    program.setPad(Gamepad{.rightX = 1});
    EXPECT_NE(program.game().player.pose().yaw, start.yaw);
    program.setPad(Gamepad{.rightBumper = true});
    EXPECT_EQ(program.game().interaction.hotbar.selected, 1u);
    program.setPad(Gamepad{.rightTrigger = true});
    const world::BlockPos under = world::blockOf({now.x, now.y, 80.5});
    program.until("a block is broken", [&] { return program.blockAt(under) == "air"; });
    program.setPad(Gamepad{.start = true});
    program.widget("Paused");
    program.setPad(Gamepad{.east = true});
    EXPECT_FALSE(program.game().menu.isPaused);
    program.setPad({});
    expectGood(program.quit());
}

TEST_F(PlayTest, TwoQuickPressesOfJumpBeginAndEndFlight) {
    makeWorld("home", {{"camera", "8.5 8.5 82.62 0 0"}});
    Program program = play("home");
    program.untilDrawn();
    const auto movement = [&] { return program.game().settings.movement; };
    const auto height = [&] { return program.game().player.pose().position.z; };
    const double ground = height();
    const auto pressSlowly = [&] {
        program.press(Key::Space);
        program.frames(10);  // half a second
    };
    pressSlowly();
    pressSlowly();
    EXPECT_EQ(movement(), game::Movement::Walk);
    program.press(Key::Space);
    EXPECT_EQ(movement(), game::Movement::Walk);
    program.press(Key::Space);
    EXPECT_EQ(movement(), game::Movement::Fly);
    EXPECT_EQ(program.game().notices.message, "movement: flying");
    program.hold(Key::Space);
    program.frames(20);
    program.release(Key::Space);
    EXPECT_NEAR(height(), ground + world::kFlySpeed, 3);
    const double flies = height();
    program.frames(20);
    EXPECT_NEAR(height(), flies, 1) << "it stays up";
    // Both presses within one frame.
    for (const bool isPress : {true, false, true, false}) program.window().onKey(Key::Space, isPress, {});
    program.frames(2);
    EXPECT_EQ(movement(), game::Movement::Walk);
    program.frames(60);
    EXPECT_NEAR(height(), ground, 0.01);
    // By a gamepad.
    for (int k = 0; k < 2; ++k) {
        program.setPad(Gamepad{.south = true});
        program.setPad(Gamepad{});
    }
    EXPECT_EQ(movement(), game::Movement::Fly);
    expectGood(program.quit());
    EXPECT_EQ(setting("home", "movement"), "fly");
}

TEST_F(PlayTest, FlightThroughBlocksIsTheLastMode) {
    Program program = play("home");
    program.untilDrawn();
    const auto movement = [&] { return program.game().settings.movement; };
    EXPECT_EQ(movement(), game::Movement::Walk);
    program.press(Key::M);
    EXPECT_EQ(movement(), game::Movement::Fly);
    program.press(Key::M);
    EXPECT_EQ(movement(), game::Movement::Noclip);
    program.press(Key::Space);
    program.press(Key::Space);
    EXPECT_EQ(movement(), game::Movement::Noclip) << "nobody lands in a block";
    program.press(Key::M);
    EXPECT_EQ(movement(), game::Movement::Walk);
    expectGood(program.quit());
}

TEST_F(PlayTest, AnUnpluggedGamepadLetsGo) {
    Program program = playAbove("home");
    program.untilDrawn();
    program.setPad(Gamepad{.leftX = 1, .leftTrigger = true, .rightTrigger = true});
    program.frames(3);
    EXPECT_TRUE(program.game().interaction.breaking.isDown());
    EXPECT_TRUE(program.game().interaction.building.isDown());
    program.setPad({});
    EXPECT_FALSE(program.game().interaction.breaking.isDown());
    EXPECT_FALSE(program.game().interaction.building.isDown());
    const world::Pose pose = program.game().player.pose();
    program.frames(10);
    EXPECT_EQ(program.game().player.pose(), pose) << "it walks no farther";
    // While the menu is open, too.
    program.setPad(Gamepad{.rightTrigger = true});
    program.setPad(Gamepad{.rightTrigger = true, .start = true});
    program.widget("Paused");
    program.setPad({});
    program.setPad(Gamepad{.east = true});
    program.setPad(Gamepad{});
    EXPECT_FALSE(program.game().menu.isPaused);
    EXPECT_FALSE(program.game().interaction.breaking.isDown());
    expectGood(program.quit());
}

TEST_F(PlayTest, GamepadButtonsAreRebound) {
    {
        Program program = playAbove("home", {"--size", "640x480"});
        program.untilDrawn();
        program.press(Key::Escape);
        program.click("Settings");
        program.click("Controls");
        EXPECT_EQ(program.widget("pad", "break").label, "Right trigger###pad");
        program.click("pad", "break");
        program.setPad(Gamepad{.south = true});  // activates nothing, though a button is in focus
        program.frames(3);
        program.setPad(Gamepad{});
        program.frames(2);
        EXPECT_EQ(program.widget("pad", "break").label, "Lower button###pad");
        EXPECT_EQ(program.widget("pad", "jump").label, "none###pad");
        program.click("pad", "jump");
        program.setPad(Gamepad{.start = true});  // cancels
        program.setPad(Gamepad{});
        program.frames(2);
        EXPECT_EQ(program.widget("pad", "jump").label, "none###pad");
        EXPECT_TRUE(program.isShown("Controls")) << "it does not close the menu";
        program.click("pad", "jump");
        program.press(Key::Escape);  // cancels, too
        EXPECT_TRUE(program.isShown("Controls"));
        program.press(Key::Escape);
        program.press(Key::Escape);
        program.setPad(Gamepad{.south = true});
        program.until("a block is broken", [&] { return program.blockAt(kGround) == "air"; });
        program.setPad({});
        expectGood(program.quit());
    }
    EXPECT_EQ(std::ranges::count(settingsLines(), "pad-buttons = 'jump=none,break=South'"), 1);
    Program program = playAbove("home");
    program.untilDrawn();
    EXPECT_EQ(program.game().settings.padButtons.keyOf(Action::Break), PadButton::South);
    expectGood(program.quit());
}

TEST_F(PlayTest, FurtherMouseButtonsAreKeys) {
    Program program = playAbove("home", {"--keys", "break=Mouse4,palette=Mouse5"});
    program.untilDrawn();
    program.window().onMouseButton(3, true, {});
    program.until("a block is broken", [&] { return program.blockAt(kGround) == "air"; });
    EXPECT_TRUE(program.game().interaction.breaking.isDown());
    program.window().onMouseButton(3, false, {});
    program.frames();
    EXPECT_FALSE(program.game().interaction.breaking.isDown());
    program.window().onMouseButton(4, true, {});
    program.window().onMouseButton(4, false, {});
    program.frames();
    EXPECT_TRUE(program.game().hud.palette.isOpen);
    program.window().onMouseButton(19, true, {});  // one that no mouse has
    program.frames();
    program.press(Key::Escape);
    expectGood(program.quit());
}

TEST_F(PlayTest, TheMouseTurnsThePlayerOnceItIsCaptured) {
    Program program = playAbove("home");
    program.untilDrawn();
    const world::Pose start = program.game().player.pose();
    program.moveMouse({10, 10});
    program.moveMouse({10, 10});
    EXPECT_EQ(program.game().player.pose(), start);
    takeMouse(program);
    EXPECT_TRUE(program.window().isCaptured);
    program.moveMouse({300, 0});  // the first position is a reference
    EXPECT_EQ(program.game().player.pose(), start);
    program.moveMouse({10, -100});
    EXPECT_NEAR(std::abs(program.game().player.pose().yaw - start.yaw),
                10 * program.game().settings.mouseSensitivity, 1e-3);
    EXPECT_GT(program.game().player.pose().pitch, start.pitch);
    expectGood(program.quit());
}

TEST_F(PlayTest, KeysAreTakenBeforeThereIsAnImage) {
    Program program = playAbove("home");
    program.until("a world is played", [&] { return program.isPlaying(); });
    ASSERT_FALSE(hasWorldImage(program.game().parts.renderer));
    for (const Key key : {Key::F12, Key::F3, Key::F4, Key::F2, Key::M, Key::L}) program.press(key);
    EXPECT_FALSE(exists(data() / "screenshots"));
    EXPECT_EQ(program.game().settings.movement, game::Movement::Walk);
    program.untilDrawn();
    program.press(Key::F12);
    EXPECT_TRUE(exists(data() / "screenshots" / "terrane-0001.png"));
    program.press(Key::Escape);  // the panel
    expectGood(program.quit());
}

TEST_F(PlayTest, TheGpuMakesMeshesWhileOneBuilds) {
    Program program = playAbove("home", {"--backend", "gpu"});
    breakGround(program);
    program.press(Key::Digit2);
    program.tap(MouseButton::Right);
    program.until("a block is built", [&] { return program.blockAt(kGround) == "cobble"; });
    program.untilDrawn();
    expectGood(program.quit());
    EXPECT_EQ(savedBlock("home", kGround), "cobble");
}

TEST_F(PlayTest, ASignalSavesAndQuits) {
    for (const int number : {SIGINT, SIGTERM}) {
        const std::string name = std::to_string(number);
        Program program = playAbove(name);
        breakGround(program);
        std::raise(number);
        expectGood(program.untilEnd());
        EXPECT_EQ(savedBlock(name, kGround), "air");
        EXPECT_EQ(setting(name, "camera"), kDown);
        EXPECT_EQ(setting(name, "movement"), "noclip");
    }
}

TEST_F(PlayTest, EditsAndTheCameraOutliveTheProgram) {
    std::string camera;
    {
        Program program = playAbove("home");
        breakGround(program);
        program.hold(Key::S);
        program.frames(2);
        program.release(Key::S);
        expectGood(program.quit());
        camera = setting("home", "camera");
        EXPECT_NE(camera, kDown);
    }
    Program program = playAbove("home");
    program.untilDrawn();
    EXPECT_EQ(program.blockAt(kGround), "air");
    expectGood(program.quit());
    EXPECT_EQ(setting("home", "camera"), camera);
}

TEST_F(PlayTest, TimePassesWhileItsKeyIsHeld) {
    Program program = playAbove("home", {"--time", "0.6"});
    program.untilDrawn();
    const auto time = [&] { return program.session().clock.timeDay; };
    const double start = time();
    program.press(Key::P);
    EXPECT_NEAR(time(), start + 0.01, 0.001);
    program.hold(Key::P);
    program.frames(30);
    // Two presses of 0.01; of 31 frames of 0.05 s those after 0.4 s, each 0.005; the day itself, 0.0015. One
    // frame more or less, since 0.4 s is a whole number of frames.
    EXPECT_NEAR(time(), start + 0.02 + 23 * 0.005 + 0.0015, 0.0055);
    program.release(Key::P);
    program.hold(Key::O);
    program.frames(40);
    program.release(Key::O);
    EXPECT_LT(time(), start);
    expectGood(program.quit());
}

// The files while one plays are all that a program leaves that is killed.
TEST_F(PlayTest, WithoutOptionsEverythingIsSaved) {
    write(data() / "bookmarks.txt", fmt::format("{}\n", kDown));
    {
        Program program =
            start({"--generator", "flat", "--movement", "noclip", "--time", "0.6", "--bookmark", "1"});
        takeMouse(program);
        program.turnWheel(-1);
        program.tap(MouseButton::Left);
        program.until("the block is broken", [&] { return program.blockAt(kGround) == "air"; });
        program.press(Key::P);
        program.frames(60);  // three seconds, until edits are queued
        const store::SaveNumber last = program.session().store().status().queued;
        program.until("all is saved", [&] { return program.session().store().status().durable >= last; });
        for (const char* end : {"", "-wal", "-shm"})
            if (exists(data() / (std::string("flat-1.sqlite") + end)))
                copy_file(data() / (std::string("flat-1.sqlite") + end),
                          data() / (std::string("killed.sqlite") + end));
        expectGood(program.quit());
    }
    EXPECT_EQ(worldNames(), (std::vector<std::string>{"flat-1", "killed"}));
    EXPECT_EQ(savedBlock("killed", kGround), "air");
    EXPECT_EQ(setting("killed", "camera"), kDown);
    EXPECT_GT(std::stod(setting("killed", "time")), 0.61);
    EXPECT_EQ(setting("killed", "hotbar").substr(0, 2), "1 ");
    // Wherever the program is started.
    create_directories(folder() / "elsewhere");
    current_path(folder() / "elsewhere");
    Program program = start({"--generator", "flat"});
    program.untilDrawn();
    EXPECT_EQ(program.blockAt(kGround), "air");
    EXPECT_EQ(program.game().interaction.hotbar.selected, 1u);
    expectGood(program.quit());
    EXPECT_TRUE(is_empty(folder() / "elsewhere"));
}

TEST_F(PlayTest, NotToSaveIsAChoice) {
    {
        write(data() / "bookmarks.txt", fmt::format("{}\n", kDown));
        Program program = start({"--generator", "flat", "--no-save", "--bookmark", "1"});
        breakGround(program);
        expectGood(program.quit());
        EXPECT_TRUE(worldNames().empty());
    }
    {
        // If nothing can be saved, the player is told before building.
        setenv("XDG_DATA_HOME", "/dev/null", 1);
        Program program = start({"--generator", "flat"});
        const std::string message = program.untilEnd().error().message;
        EXPECT_NE(message.find("/dev/null/terrane: "), std::string::npos) << message;
        EXPECT_NE(message.find("(--no-save plays without saving)"), std::string::npos) << message;
        setenv("XDG_DATA_HOME", folder().c_str(), 1);
    }
    // The hint is not given where it does not help.
    makeWorld("a");
    Program program = start({"--world", "a", "--seed", "9"});
    EXPECT_EQ(program.untilEnd().error().message, worldFile("a").string() + ": made with seed 1, not 9");
}

// A click on the program's icon: nobody sees standard error.
TEST_F(PlayTest, AnErrorAtTheStartIsShownInAWindowWithoutATerminal) {
    const std::string broken = "preset = low\nview-distance = \"far";
    write(data() / "settings.toml", broken);
    const std::string message = (data() / "settings.toml").string() + ":1: ";
    const std::vector<std::string> arguments = {"--size", "480x300", "--language", "en"};
    {
        Program program(arguments, false);
        EXPECT_FALSE(program.isPlaying());
        program.widget("Terrane ended with an error");
        const auto shows = [&] {
            const auto& widgets = program.window().record.widgets();
            return std::ranges::any_of(
                widgets, [&](const Widget& widget) { return widget.value.starts_with(message); });
        };
        program.until("the error is shown", shows);
        program.click("Copy the text");
        EXPECT_TRUE(program.window().clipboardText.starts_with(message));
        program.click("Quit (Q)");
        const base::Result<void> ended = program.untilEnd();
        ASSERT_FALSE(ended);
        EXPECT_TRUE(ended.error().message.starts_with(message)) << ended.error().message;
    }
    for (const Key key : {Key::Q, Key::Escape, Key::Enter}) {
        Program program(arguments, false);
        program.until("the button has the focus", [&] { return program.focused() == "Quit (Q)"; });
        program.press(key);
        EXPECT_FALSE(program.untilEnd());
    }
    {
        Program program(arguments, false);
        program.window().isClosed = true;
        EXPECT_FALSE(program.untilEnd());
    }
    EXPECT_EQ(textOf(data() / "settings.toml"), broken) << "it is kept";
    EXPECT_FALSE(start().untilEnd()) << "with a terminal it is only a line";
    // Every other error that ends the program.
    std::filesystem::remove(data() / "settings.toml");
    write(worldFile("bad"), "no save");
    Program program({"--size", "480x300", "--language", "en", "--world", "bad"}, false);
    program.until("the button has the focus", [&] { return program.focused() == "Quit (Q)"; });
    program.press(Key::Q);
    EXPECT_FALSE(program.untilEnd());
}

TEST_F(PlayTest, AWorldOfTheWorkingDirectoryIsFound) {
    makeWorld("home");
    create_directories(folder() / "save");
    rename(worldFile("home"), folder() / "save" / "home.sqlite");
    Program program = play("home");
    program.until("the world is played", [&] { return program.isPlaying(); });
    expectGood(program.quit());
    EXPECT_NE(log().find("save/home.sqlite: opened from the working directory; move it into"),
              std::string::npos);
    EXPECT_TRUE(worldNames().empty());
}

TEST_F(PlayTest, APlayerLearnsThatSavingFails) {
    const std::filesystem::path away = folder() / "away.sqlite";
    Program program = playAbove("home", {"--size", "640x400"});
    program.untilDrawn();
    rename(worldFile("home"), away);
    program.widget("overlay", "save notice");
    program.press(Key::Escape);
    program.press(Key::Q);
    program.widget("The world could not be saved");  // asks instead of closing
    program.press(Key::Escape);
    EXPECT_FALSE(program.isShown("Quit without saving"));
    EXPECT_TRUE(program.isPlaying());
    program.press(Key::Escape);  // leaves the menu
    program.widget("overlay", "save notice");
    rename(away, worldFile("home"));
    program.until("saving works again", [&] { return !program.isShown("overlay", "save notice"); });
    EXPECT_NE(log().find("deleted or moved while it was open"), std::string::npos);
    rename(worldFile("home"), away);
    program.widget("overlay", "save notice");
    program.window().isClosed = true;
    program.click("Keep playing");
    EXPECT_FALSE(program.window().isClosed);
    program.press(Key::Escape);
    program.press(Key::Q);
    program.click("Quit without saving");
    const base::Result<void> ended = program.untilEnd();
    ASSERT_FALSE(ended);
    EXPECT_NE(ended.error().message.find("home.sqlite: deleted or moved "), std::string::npos);
    EXPECT_NE(ended.error().message.find("; not saved: "), std::string::npos);
}

TEST_F(PlayTest, ItemsInAChestAreSaved) {
    constexpr world::BlockPos kChest{8, 8, 81};
    makeWorld("home", {{"camera", "8.5 8.5 85 0 -89"}, {"movement", "noclip"}, {"hotbar", "0 chest"}});
    const auto open = [&](Program& program) {
        program.tap(MouseButton::Right);
        program.widget("Chest");
    };
    const auto items = [&](Program& program) {
        return game::itemsOf(program.session().world(), program.session().blocks(), kChest).value();
    };
    {
        Program program = play("home");
        takeMouse(program);
        program.tap(MouseButton::Right);
        program.until("a chest is built", [&] { return program.blockAt(kChest) == "chest"; });
        open(program);
        program.click("slot");
        program.click("slot");
        program.press(Key::Escape);
        EXPECT_EQ(items(program).front().count, 2);
        expectGood(program.quit());
    }
    Program program = play("home");
    takeMouse(program);
    open(program);
    program.click("slot", "chest", 0.5, MouseButton::Right);
    program.press(Key::Escape);
    EXPECT_EQ(items(program).front().count, 1);
    program.tap(MouseButton::Left);  // breaks nothing: one is still in it
    program.frames(5);
    EXPECT_EQ(program.blockAt(kChest), "chest");
    open(program);
    program.click("slot", "chest", 0.5, MouseButton::Right);
    program.press(Key::Escape);
    for (const world::BlockPos broken : {kChest, kGround}) {
        program.tap(MouseButton::Left);
        program.until("a block is broken", [&] { return program.blockAt(broken) == "air"; });
    }
    program.tap(MouseButton::Right);
    program.until("a chest is built", [&] { return program.blockAt(kGround) == "chest"; });
    expectGood(program.quit());
    EXPECT_EQ(savedBlock("home", kGround), "chest");
}

TEST_F(PlayTest, EscapeClosesOneThingAtATime) {
    Program program = playAbove("home");
    program.untilDrawn();
    const world::Pose start = program.game().player.pose();
    program.press(Key::F2);
    program.widget("view-distance");
    program.press(Key::Escape);
    EXPECT_FALSE(program.game().debug.showsPanel);
    EXPECT_FALSE(program.game().menu.isPaused);
    program.press(Key::Escape);
    program.widget("Paused");
    program.click("Settings");
    program.widget("View distance");
    program.press(Key::Escape);
    EXPECT_TRUE(program.game().menu.isPaused);
    program.hold(Key::W);
    program.frames(5);
    program.release(Key::W);
    program.press(Key::Escape);
    EXPECT_FALSE(program.game().menu.isPaused);
    EXPECT_EQ(program.game().player.pose(), start);
    program.press(Key::Escape);
    program.click("Resume (Esc)");
    EXPECT_FALSE(program.game().menu.isPaused);
    program.press(Key::Escape);
    program.click("Save and quit (Q)");
    expectGood(program.untilEnd());
}

TEST_F(PlayTest, AWrongTimeInASaveIsNamed) {
    makeWorld("home", {{"time", "nan"}});
    {
        Program program = play("home");
        program.until("the world is played", [&] { return program.isPlaying(); });
        EXPECT_TRUE(program.quit());
        EXPECT_NE(log().find("warning: the save's time of day is not a number from 0 to 1: \"nan\""),
                  std::string::npos);
    }
    EXPECT_NE(setting("home", "time"), "nan");  // a time is stored again
}

TEST_F(PlayTest, APlayerTriesEverythingAndFindsItAgain) {
    makeWorld("home");
    std::vector<std::string> written;
    std::string camera;
    {
        Program program = play("home", {"--collect-perf-data", "perf.csv"});
        takeMouse(program);
        program.hold(Key::W);
        for (const Key key : {Key::Space, Key::F1, Key::F3, Key::F4, Key::F5, Key::F6, Key::F12, Key::O,
                              Key::P, Key::I, Key::M, Key::M}) {
            program.press(key);
            program.frames(3);
        }
        program.release(Key::W);
        for (const MouseButton button : {MouseButton::Left, MouseButton::Right}) {
            program.hold(button);
            program.frames(8);
            program.release(button);
        }
        program.press(Key::F2);
        for (const char* name : {"clouds", "god-rays", "distance-fog"}) program.click(name);
        program.press(Key::Escape);
        expectGood(program.quit());
        camera = setting("home", "camera");
        written = settingsLines();
    }
    EXPECT_EQ(linesOf(data() / "bookmarks.txt").size(), 1u);
    const auto image = base::readPng(data() / "screenshots" / "terrane-0001.png");
    ASSERT_TRUE(image);
    EXPECT_EQ(glm::ivec2(image->width, image->height), glm::ivec2(480, 300));
    EXPECT_EQ(setting("home", "movement"), "noclip");  // walk, then fly
    EXPECT_EQ(written.size(), 3u);
    const std::vector<std::string> rows = linesOf(folder() / "perf.csv");
    ASSERT_GT(rows.size(), 10u);
    EXPECT_EQ(rows[0].substr(0, 20), "time_s,frame_ms,fps,");
    const auto commas = [](const std::string& row) { return std::ranges::count(row, ','); };
    double milliseconds = 0;
    for (const std::string& row : rows) {
        EXPECT_EQ(commas(row), commas(rows[0]));
        if (&row != &rows[0]) milliseconds += std::stod(row.substr(row.find(',') + 1));
    }
    EXPECT_NEAR(std::stod(rows.back()), milliseconds / 1000, 0.1);

    Program again = play("home");
    again.untilDrawn();
    expectGood(again.quit());
    EXPECT_EQ(setting("home", "camera"), camera);
    EXPECT_EQ(settingsLines(), written);
}

}  // namespace
}  // namespace terrane::app

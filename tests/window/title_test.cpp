// The title screen: worlds, dialogs, settings.
#include "tests/window/window_fixture.h"

namespace terrane::app {
namespace {

class TitleTest : public WindowTest {
  protected:
    static void leaveForTitle(Program& program) {
        program.press(Key::Escape);
        program.press(Key::T);
        program.until("the title", [&] { return !program.isPlaying() && program.isShown("New world"); });
    }

    // Quits from the main page.
    void quit(Program& program) {
        program.press(Key::Q);
        expectGood(program.untilEnd());
    }
};

TEST_F(TitleTest, ANewWorldIsCreatedLeftAndContinued) {
    Program program = start();
    program.until("the only entry is in focus", [&] { return program.focused() == "New world"; });
    program.press(Key::Enter);
    program.until("the form is in focus", [&] { return program.focused() == "Create"; });
    program.press(Key::Enter);
    program.untilDrawn();
    EXPECT_EQ(program.session().store().identity().generator, gen::kDefaultGenerator);
    EXPECT_EQ(program.game().settings.movement, game::Movement::Walk);
    program.press(Key::M);
    EXPECT_EQ(program.game().settings.movement, game::Movement::Fly);
    const world::Pose left = program.game().player.pose();
    leaveForTitle(program);
    EXPECT_TRUE(exists(data() / "World.png"));
    program.click("Continue World");
    program.until("the world is played", [&] { return program.isPlaying(); });
    EXPECT_EQ(program.game().player.pose(), left);
    EXPECT_EQ(program.game().settings.movement, game::Movement::Fly);
    leaveForTitle(program);
    // A new world starts with default settings.
    program.click("New world");
    EXPECT_EQ(program.widget("name").value, "World 2");
    program.click("generator");
    program.click("flat");
    program.click("Create");
    program.until("the world is played", [&] { return program.isPlaying(); });
    EXPECT_EQ(program.game().settings.movement, game::Movement::Walk);
    expectGood(program.quit());
    EXPECT_EQ(setting("World", "movement"), "fly");
    EXPECT_EQ(setting("World 2", "generator"), "flat");
}

TEST_F(TitleTest, ANewWorldHasTheHeightsOfItsForm) {
    Program program = start();
    program.click("New world");
    program.click("generator");
    program.click("flat");
    program.click("bottom");
    program.type("-60");
    program.click("Create");
    program.widget("Message");
    program.click("OK");
    program.click("bottom");
    program.press(Key::Backspace);
    program.type("4");
    EXPECT_EQ(program.widget("bottom").value, "-64");
    program.click("top");
    program.type("320");
    program.click("Create");
    program.until("the world is played", [&] { return program.isPlaying(); });
    EXPECT_EQ(program.session().store().identity().heights, (world::Heights{-64, 320}));
    expectGood(program.quit());
    EXPECT_EQ(setting("World", "bottom"), "-64");
    EXPECT_EQ(setting("World", "top"), "320");
}

TEST_F(TitleTest, WorldsAreRenamedCopiedAndDeleted) {
    makeWorld("home");
    Program program = start();
    const auto untilNames = [&](const std::vector<std::string>& names) {
        program.until("other names of worlds", [&] { return worldNames() == names; });
    };
    program.click("Worlds (1)");
    program.click("Rename");
    program.widget("Rename world");
    program.type("hut");
    program.press(Key::Enter);
    untilNames({"hut"});
    program.click("Copy");
    EXPECT_EQ(program.widget("##name").value, "hut copy");
    program.click("Copy");
    untilNames({"hut", "hut copy"});
    program.click("world", "hut copy");
    program.click("Delete");
    program.click("Keep it");
    EXPECT_EQ(worldNames().size(), 2u);
    program.click("world", "hut copy");
    program.click("Delete");
    program.widget("Keep it");
    program.click("Delete");
    untilNames({"hut"});
    program.widget("world", "hut");
    program.press(Key::Escape);
    program.widget("Settings");
    quit(program);
}

TEST_F(TitleTest, AHeldKeyChoosesOnce) {
    Program program = start();
    program.until("an entry is in focus", [&] { return program.focused() == "New world"; });
    program.hold(Key::Enter);
    program.frames(60);  // three seconds
    EXPECT_EQ(program.focused(), "Create");
    program.release(Key::Enter);
    program.press(Key::Escape);
    program.widget("Join a server");
    EXPECT_TRUE(worldNames().empty());
    quit(program);
}

TEST_F(TitleTest, SettingsAreKept) {
    for (const bool isInverted : {true, false}) {
        Program program = start();
        program.click("Settings");
        program.click("Controls");
        program.click("Invert up and down");
        EXPECT_EQ(program.widget("Invert up and down").value, isInverted ? "on" : "off");
        program.press(Key::Escape);
        program.widget("New world");
        quit(program);
        EXPECT_EQ(settingsLines(),
                  isInverted ? std::vector<std::string>{"invert-y = 'true'"} : std::vector<std::string>{});
    }
}

TEST_F(TitleTest, AKeyIsBoundInTheSettings) {
    Program program = start();
    program.click("Settings");
    program.click("Controls");
    program.click("key", "jump");
    program.press(Key::F);
    EXPECT_EQ(program.widget("key", "jump").label, "F###key");
    program.click("Default keys");
    EXPECT_EQ(program.widget("key", "jump").label, "Space###key");
    program.click("key", "jump");
    program.press(Key::Escape);  // keeps the old one, and the dialog open
    EXPECT_EQ(program.widget("key", "jump").label, "Space###key");
    program.press(Key::Escape);
    program.widget("New world");
    quit(program);
}

TEST_F(TitleTest, TheGamepadGoesThroughMenus) {
    Program program = start();
    const auto push = [&](bool Gamepad::*button) {
        Gamepad pad;
        pad.*button = true;
        program.setPad(pad);
        program.setPad(Gamepad());
    };
    program.until("an entry is in focus", [&] { return program.focused() == "New world"; });
    push(&Gamepad::down);
    push(&Gamepad::down);
    EXPECT_EQ(program.focused(), "Settings");
    push(&Gamepad::south);
    program.widget("View distance");
    push(&Gamepad::rightBumper);
    program.widget("Mouse sensitivity");
    push(&Gamepad::leftBumper);
    program.widget("View distance");
    push(&Gamepad::east);
    program.widget("New world");
    quit(program);
}

TEST_F(TitleTest, TheLanguageChangesAtOnce) {
    Program program = start();
    program.click("Settings");
    program.click("General");
    program.click("language");
    program.click("Deutsch");
    program.press(Key::Escape);
    program.click("Neue Welt");
    program.widget("Erstellen");
    program.press(Key::Escape);
    program.widget("Neue Welt");
    quit(program);
    EXPECT_EQ(settingsLines(), std::vector<std::string>{"language = 'de'"});
}

TEST_F(TitleTest, ANamedWorldIsOpenedAtOnce) {
    Program program = play("home");
    program.until("the world is played", [&] { return program.isPlaying(); });
    expectGood(program.quit());
    EXPECT_EQ(setting("home", "generator"), "flat");
}

TEST_F(TitleTest, AWorldThatCannotBeOpenedIsTold) {
    write(worldFile("bad"), "no save");
    Program program = start();
    program.until("an entry is in focus", [&] { return program.focused() == "New world"; });
    program.press(Key::Up);
    EXPECT_EQ(program.focused(), "Worlds");
    program.press(Key::Enter);
    program.until("the only world is in focus", [&] { return program.focused() == "##world"; });
    EXPECT_FALSE(program.widget("Play").isEnabled);
    program.press(Key::Enter);
    program.widget("Message");
    program.click("OK");
    program.widget("world", "bad");
    program.press(Key::Escape);
    program.widget("New world");
    quit(program);
    EXPECT_EQ(textOf(worldFile("bad")), "no save");
}

}  // namespace
}  // namespace terrane::app

// Rules of packs in a world of one's own: the chat, commands, refusals.
#include "terrane/game/chat.h"
#include "tests/window/window_fixture.h"

namespace terrane::app {
namespace {

class RulesTest : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        write(folder() / "mine" / "pack.toml", "format = 1\nname = \"mine\"\nrules = 1\n");
        writeScript(
            "events.before('break', function() return 'the ground stays' end, 'grass')\n"
            "commands.add{name = 'hello', help = 'answers', run = function() return 'hello' end}\n");
        write(data() / "bookmarks.txt", std::string(kDown) + "\n");
    }
    void writeScript(const std::string& text) const {
        write(folder() / "mine" / "scripts" / "main.lua", text);
    }
    Program playWithRules() {
        makeWorld("w");
        return play("w", {"--content", (folder() / "mine").string(), "--bookmark", "1", "--movement",
                          "noclip", "--watch"});
    }
    static void say(Program& program, const std::string& line) {
        program.press(Key::T);
        program.widget("##chat");
        program.type(line);
        program.press(Key::Enter);
    }
};

TEST_F(RulesTest, AnswerInTheChatAndRefuse) {
    Program program = playWithRules();
    program.untilDrawn();
    program.tap(MouseButton::Left);  // captures the mouse
    program.tap(MouseButton::Left);
    program.until("the reason", [&] { return program.isShown("chat line", "the ground stays"); });
    EXPECT_EQ(program.blockAt(kGround), "grass");
    say(program, "/hello");
    program.until("the answer", [&] { return program.isShown("chat line", "hello"); });
    say(program, "/nothing");
    const std::string help = game::chatHelp(program.session().chatCommands);
    EXPECT_NE(help.find("/hello: answers"), std::string::npos) << help;
    program.until("the commands", [&] { return program.isShown("chat line", help); });
    EXPECT_TRUE(program.quit());
}

TEST_F(RulesTest, BeginAnewWhenTheirFileChanges) {
    Program program = playWithRules();
    program.untilDrawn();
    writeScript("what(");
    program.until("an error", [&] { return log().find("mine/scripts/main.lua:1") != std::string::npos; });
    EXPECT_FALSE(program.isShown("chat line", "good day"));
    writeScript("events.on('join', function(e) e.player:say('good day') end)");
    program.until("a greeting", [&] { return program.isShown("chat line", "good day"); });
    EXPECT_TRUE(program.quit());
}

}  // namespace
}  // namespace terrane::app

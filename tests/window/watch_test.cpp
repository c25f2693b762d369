// A content pack that changes during the game: terrain is regenerated, edits stay.
#include <fmt/format.h>

#include "tests/window/window_fixture.h"

namespace terrane::app {
namespace {

class WatchTest : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        write(folder() / "mine" / "pack.toml", "format = 1\nname = \"mine\"\n");
        writeGround("grass");
        write(data() / "bookmarks.txt", fmt::format("{}\n", kDown));
    }

    void writeScript(const std::string& text) const {
        write(folder() / "mine" / "generators" / "plain.lua", text);
    }
    // A ground of this block on earth.
    void writeGround(const std::string& block) const {
        writeScript(R"(
g:pass3D("ground", function(p)
  local soil = select(p.z:lt(80), p:block("dirt"), p:block(")" +
                    block + R"("))
  p:setBlock(select(p.z:le(80), soil, p:block("air")))
end)
)");
    }

    Program playWatched() {
        return start({"--content", (folder() / "mine").string(), "--generator", "mine:plain", "--watch",
                      "--world", "w", "--recreate", "--bookmark", "1", "--movement", "fast"});
    }
    Program playAgain() {
        return start({"--content", (folder() / "mine").string(), "--world", "w", "--bookmark", "1"});
    }
};

TEST_F(WatchTest, AChangedScriptMakesNewLand) {
    Program program = playWatched();
    program.untilDrawn();
    program.tap(MouseButton::Left);
    program.tap(MouseButton::Left);
    program.until("the block is broken", [&] { return program.blockAt(kGround) == "air"; });
    writeScript("p:oops(");
    program.until("an error", [&] { return log().find("plain.lua:1") != std::string::npos; });
    EXPECT_EQ(program.blockAt({24, 8, 80}), "grass");
    writeGround("stone");
    program.until("other land", [&] {
        return program.isPlaying() && program.blockAt({24, 8, 80}) == "stone";
    });
    EXPECT_NE(log().find("regenerated except for chunks with edits"), std::string::npos);
    program.untilDrawn();
    EXPECT_EQ(program.blockAt(kGround), "air");
    EXPECT_EQ(program.blockAt({2, 2, 80}), "grass");  // the edited chunk stays as it was
    EXPECT_TRUE(program.quit());
    EXPECT_EQ(worldNames(), std::vector<std::string>{"w"});  // no copies
    Program again = playAgain();
    again.untilDrawn();
    EXPECT_EQ(again.blockAt(kGround), "air");
    EXPECT_TRUE(again.quit());
}

TEST_F(WatchTest, AChangeWhileSavingFailsAsksFirst) {
    Program program = playWatched();
    program.untilDrawn();
    rename(worldFile("w"), folder() / "away.sqlite");
    program.widget("overlay", "save notice");
    writeGround("stone");
    program.click("Quit without saving");  // before the world is opened again
    const base::Result<void> ended = program.untilEnd();
    ASSERT_FALSE(ended);
    EXPECT_NE(ended.error().message.find("w.sqlite: deleted or moved "), std::string::npos);
    EXPECT_FALSE(exists(worldFile("w")));
}

}  // namespace
}  // namespace terrane::app

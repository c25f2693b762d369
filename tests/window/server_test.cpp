// Playing on a server, which runs between the program's frames.
#include "apps/terrane/window/title/join_dialog.h"
#include "tests/window/server_fixture.h"

namespace terrane::app {
namespace {

TEST_F(ServerTest, AServerIsJoinedFromTheTitleAndRemembered) {
    const std::string address = server_->address();
    Program program = start();
    program.beforeFrame = [&] {
        if (server_) server_->update();
    };
    program.click("Join a server");
    program.widget("##address");
    program.type(address);
    program.press(Key::Tab);
    program.type("Eve");
    program.press(Key::Enter);
    program.until("the player has joined", [&] { return program.isPlaying() && program.game().remote.play; });
    EXPECT_EQ(readServers(serverListFile(data())), (std::vector<PlayedServer>{{address, "Eve"}}));
    program.untilDrawn();
    EXPECT_EQ(server_->server.state().clients.all.size(), 1u);
    program.press(Key::Escape);
    program.press(Key::T);
    program.until("the player has left",
                  [&] { return !program.isPlaying() && server_->server.state().clients.all.empty(); });
    server_.reset();
    program.click("Join a server");
    EXPECT_EQ(program.widget("##address").value, address);
    EXPECT_EQ(program.widget("##player").value, "Eve");
    program.click("Join");
    program.click("OK");
    EXPECT_NE(log().find(address + ": Connection refused"), std::string::npos) << log();
    program.press(Key::Q);
    expectGood(program.untilEnd());
}

TEST_F(ServerTest, PlayersSeeTheBlocksAndWordsOfEachOther) {
    boost::asio::io_context context;
    net::LinkPlayer bob(context, server_->sockets->port(), "Bob");
    Program program = start({"--connect", server_->address(), "--name", "Ann", "--movement", "fast"});
    program.beforeFrame = [&] {
        server_->update();
        bob.update();
        context.restart();
        context.poll();
    };
    program.until("both have joined", [&] {
        return program.isPlaying() && bob.isLoaded() && program.game().remote.others.names.size() == 1;
    });
    program.untilDrawn();
    const world::BlockPos built = bob.above(2);
    bob.put(built, "cobble");
    program.until("the block is there", [&] { return program.blockAt(built) == "cobble"; });
    // The player breaks it.
    const glm::dvec3 eyes(built.x + 0.5, built.y + 0.5, built.z + 4);
    program.game().player.placeAt({eyes, 0, -89}, game::Movement::Noclip);
    program.tap(MouseButton::Left);
    program.until("it is targeted", [&] { return program.game().interaction.target().has_value(); });
    program.tap(MouseButton::Left);
    program.until("the other player sees it",
                  [&] { return bob.session->world().block(built) == world::kAir; });
    program.press(Key::T);
    program.widget("##chat");
    program.type("hello");
    program.press(Key::Enter);
    EXPECT_TRUE(program.game().input.isCaptured);
    program.press(Key::P);  // the server sets the time
    EXPECT_EQ(program.game().notices.message, "the server sets the time");
    program.press(Key::Y);
    program.widget("Players");
    expectGood(program.quit());
}

TEST_F(ServerTest, TheChatIsScrolledToOlderLines) {
    Program program =
        start({"--connect", server_->address(), "--name", "Ann", "--movement", "fast", "--size", "640x400"});
    program.beforeFrame = [&] { server_->update(); };
    program.until("the player has joined", [&] { return program.isPlaying() && program.game().remote.play; });
    program.untilDrawn();
    ChatView& chat = program.game().remote.chat;
    const auto add = [&](int first, int last) {
        for (int k = first; k <= last; ++k)
            chat.add({"Bob", fmt::format("line {}", k)}, program.game().seconds);
        program.frames();
    };
    const auto isInView = [&](const std::string& line) { return program.isShown("chat line", line); };
    add(1, 2000);
    EXPECT_LE(chat.lineCount(), 500u) << "memory is bounded";
    program.press(Key::PageUp);
    EXPECT_TRUE(isInView("Bob: line 2000")) << "nobody types";
    program.press(Key::T);
    program.widget("##chat");
    program.press(Key::PageUp);
    EXPECT_FALSE(isInView("Bob: line 2000"));
    EXPECT_TRUE(isInView("Bob: line 1984"));
    add(2001, 2003);
    EXPECT_TRUE(isInView("Bob: line 1984")) << "lines that arrive do not move the page";
    program.press(Key::PageDown);
    program.turnWheel(-9);  // a page down leaves a line or two
    EXPECT_TRUE(isInView("Bob: line 2003"));
    program.turnWheel(1);
    EXPECT_FALSE(isInView("Bob: line 2003"));
    EXPECT_TRUE(isInView("Bob: line 2002"));
    program.turnWheel(9999);
    const std::string oldest = fmt::format("Bob: line {}", 2003 - chat.lineCount() + 1);
    EXPECT_TRUE(isInView(oldest));
    EXPECT_TRUE(isInView(fmt::format("Bob: line {}", 2003 - chat.lineCount() + 10))) << "a full page";
    program.press(Key::PageDown);
    EXPECT_FALSE(isInView(oldest)) << "one page down, whatever was turned too far";
    program.press(Key::Escape);
    program.frames();
    EXPECT_TRUE(isInView("Bob: line 2003")) << "closed";
    program.press(Key::T);
    program.widget("##chat");
    program.press(Key::PageUp);
    program.type("hello");
    program.press(Key::Enter);
    program.until("the line is there", [&] { return isInView("Ann: hello"); });
    expectGood(program.quit());
}

TEST_F(ServerTest, AWrongNameIsOneLine) {
    Program program = start({"--connect", server_->address(), "--name", " x "});
    const base::Result<void> ended = program.untilEnd();
    ASSERT_FALSE(ended);
    EXPECT_EQ(ended.error().message.find("--name  x : a name has 1 to 24 bytes"), 0u)
        << ended.error().message;
}

}  // namespace
}  // namespace terrane::app

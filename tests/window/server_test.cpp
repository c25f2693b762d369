// Playing on a server, which runs between the program's frames.
#include "apps/terrane/window/title/join_dialog.h"
#include "terrane/io/open_session.h"
#include "tests/net/socket_fixture.h"
#include "tests/window/window_fixture.h"

namespace terrane::app {
namespace {

// A server of a flat world on a free port.
struct FlatServer {
    explicit FlatServer(const std::filesystem::path& folder)
        : server(partsIn(folder),
                 net::SqliteRecords::open(folder / "w.server.sqlite", contentBlocks()).value()),
          sockets(net::ServerSockets::open(context, server.state(), {"127.0.0.1", 0}, folder / "key.pem")
                      .value()) {}

    static game::SessionParts partsIn(const std::filesystem::path& folder) {
        io::WorldOptions options;
        options.generator = "flat";
        options.threads = 1;
        const io::SaveOptions save{.world = (folder / "w.sqlite").string(), .storeGenerated = {}};
        return std::move(io::openSessionParts(options, save, store::WorldAccess::ReadWrite).value().parts);
    }

    std::string address() const { return "127.0.0.1:" + std::to_string(sockets->port()); }

    void update() {
        const net::Time now = std::chrono::steady_clock::now();
        if (now >= nextTick) {
            nextTick = now + net::kServerTick;
            net::tick(server.state(), now);
            sockets->flush();
        }
        context.restart();
        context.poll();
    }

    boost::asio::io_context context;
    net::TestServer server;
    std::unique_ptr<net::ServerSockets> sockets;
    net::Time nextTick{};
};

class ServerTest : public WindowTest {
  protected:
    void SetUp() override {
        WindowTest::SetUp();
        create_directories(folder() / "server");
        server_ = std::make_unique<FlatServer>(folder() / "server");
    }

    std::unique_ptr<FlatServer> server_;
};

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

TEST_F(ServerTest, AWrongNameIsOneLine) {
    Program program = start({"--connect", server_->address(), "--name", " x "});
    const base::Result<void> ended = program.untilEnd();
    ASSERT_FALSE(ended);
    EXPECT_EQ(ended.error().message.find("--name  x : a name has 1 to 24 bytes"), 0u)
        << ended.error().message;
}

}  // namespace
}  // namespace terrane::app

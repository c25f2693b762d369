// A server of a flat world that tests of the window join; it runs between the program's frames.
#pragma once

#include "terrane/io/open_session.h"
#include "tests/net/socket_fixture.h"
#include "tests/window/window_fixture.h"

namespace terrane::app {

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

}  // namespace terrane::app

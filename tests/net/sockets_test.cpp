// A server on a real port: players over TLS, and clients that send something else or nothing.
#include <algorithm>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <cstdlib>

#include "terrane/base/machine.h"
#include "terrane/net/server/server.h"
#include "terrane/net/server/server_console.h"
#include "terrane/net/wire/security.h"
#include "tests/net/socket_fixture.h"
#include "tests/net/test_proxy.h"
#include "tests/support/depth.h"

namespace terrane::net {
namespace {

namespace asio = boost::asio;
using Tcp = asio::ip::tcp;
using SocketError = boost::system::error_code;

Tcp::endpoint localPort(std::uint16_t port) {
    return {asio::ip::make_address("127.0.0.1"), port};
}

// A client with blocking calls, for another thread.
struct BlockingClient {
    explicit BlockingClient(std::uint16_t port) : tls(clientContext()), stream(context, tls) {
        stream.next_layer().connect(localPort(port));
    }
    // Everything that the server sends until it closes.
    Bytes readAll() {
        Bytes bytes;
        std::array<std::byte, 4096> part;
        SocketError error;
        while (!error) {
            const std::size_t count = stream.read_some(asio::buffer(part), error);
            bytes.insert(bytes.end(), part.begin(), part.begin() + static_cast<std::ptrdiff_t>(count));
        }
        return bytes;
    }

    asio::io_context context;
    asio::ssl::context tls;
    asio::ssl::stream<Tcp::socket> stream;
};

std::optional<Refused> refusedOf(const Bytes& stream) {
    FrameReader reader(kMaxServerMessage);
    reader.add(stream);
    while (const auto frame = reader.next().value())
        if (auto message = decodeServerMessage(*frame).value(); std::holds_alternative<Refused>(message))
            return std::get<Refused>(message);
    return std::nullopt;
}

class SocketsTest : public SocketTest {
  protected:
    // A joined player builds and receives the decision.
    bool builds(LinkPlayer& player) {
        const world::BlockPos pos = player.above(2);
        const char* block = player.session->world().block(pos) == world::kAir ? "glass" : "air";
        if (player.put(pos, block) != game::EditResult::Applied) return false;
        const bool isDecided = runUntil([&] { return player.world->undecidedCount() == 0; });
        return isDecided && server_->server.state().session.world().block(pos) == contentBlock(block);
    }
    void expectNobodyElse(std::size_t players) {
        EXPECT_TRUE(runUntil([&] { return server_->sockets->connectionCount() == players; }));
    }
};

TEST_F(SocketsTest, PlayersJoinOverTls) {
    start();
    LinkPlayer& ann = addPlayer("Ann");
    LinkPlayer& bob = addPlayer("Bob");
    ASSERT_TRUE(runUntil([&] { return ann.isLoaded() && bob.isLoaded(); })) << ann.link.reason();
    EXPECT_EQ(ann.serverKey, server_->sockets->key());
    EXPECT_EQ(ann.serverKey.size(), 64u);
    const world::BlockPos pos = ann.above(2);
    ASSERT_EQ(ann.put(pos, "glass"), game::EditResult::Applied);
    EXPECT_TRUE(runUntil([&] { return bob.session->world().block(pos) == contentBlock("glass"); }));
    ann.link.leave();
    EXPECT_TRUE(runUntil([&] { return bob.world->players().empty(); }));
    expectNobodyElse(1);
}

TEST_F(SocketsTest, APortInUseIsRefused) {
    start();
    const std::uint16_t port = server_->sockets->port();
    const auto second =
        ServerSockets::open(context_, server_->server.state(), {"127.0.0.1", port}, folder_ / "second.pem");
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().message,
              fmt::format("127.0.0.1 port {}: cannot listen: Address already in use", port));
}

// OpenSSL would wait for somebody to write into it.
TEST_F(SocketsTest, AKeyFileThatIsAPipeIsRefused) {
    const auto pipe = folder_ / "pipe.pem";
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const auto context = serverContext(pipe);
    ASSERT_FALSE(context);
    EXPECT_EQ(context.error().message, pipe.string() + ": not a regular file");
}

TEST_F(SocketsTest, ALinkThatLeavesWhileItConnectsAsksForNoTrust) {
    start();
    LinkPlayer& ann = addPlayer("Ann");
    ann.link.leave();
    LinkPlayer& bob = addPlayer("Bob");
    ASSERT_TRUE(runUntil([&] { return bob.isLoaded(); })) << bob.link.reason();
    EXPECT_TRUE(ann.serverKey.empty());
    expectNobodyElse(1);
}

TEST_F(SocketsTest, ConnectionsWithoutTlsAreClosed) {
    start();
    LinkPlayer& ann = addPlayer("Ann");
    ASSERT_TRUE(runUntil([&] { return ann.isLoaded(); }));
    for (const std::string& text :
         {std::string("GET / HTTP/1.1\r\n\r\n"), std::string(5000, '\xff'), std::string(3, '\0')}) {
        const std::uint16_t port = port_;
        const bool isClosed = beside([port, text] {
            BlockingClient client(port);
            SocketError error;
            asio::write(client.stream.next_layer(), asio::buffer(text), error);
            // The last text may be the start of a TLS record: close our side so that the server stops
            // waiting.
            if (text.size() < 5) client.stream.next_layer().shutdown(Tcp::socket::shutdown_send, error);
            std::array<char, 512> answer;
            while (!error) client.stream.next_layer().read_some(asio::buffer(answer), error);
            return error == asio::error::eof || error == asio::error::connection_reset;
        });
        EXPECT_TRUE(isClosed);
    }
    expectNobodyElse(1);
    EXPECT_TRUE(builds(ann));
}

TEST_F(SocketsTest, OlderTlsIsRefused) {
    start();
    const std::uint16_t port = port_;
    const bool isRefused = beside([port] {
        BlockingClient client(port);
        SSL_set_min_proto_version(client.stream.native_handle(), TLS1_2_VERSION);
        SSL_set_max_proto_version(client.stream.native_handle(), TLS1_2_VERSION);
        SocketError error;
        client.stream.handshake(asio::ssl::stream_base::client, error);
        return error.failed();
    });
    EXPECT_TRUE(isRefused);
    expectNobodyElse(0);
}

// They receive the reason although they keep sending.
TEST_F(SocketsTest, TooLongAMessageEndsTheConnection) {
    start();
    const std::uint16_t port = port_;
    const Bytes answer = beside([port] {
        BlockingClient client(port);
        client.stream.handshake(asio::ssl::stream_base::client);
        Bytes bytes;
        WireWriter(bytes).number(kMaxClientMessage + 1);
        bytes.resize(300000);
        SocketError error;
        asio::write(client.stream, asio::buffer(bytes), error);
        return client.readAll();
    });
    const auto refused = refusedOf(answer);
    ASSERT_TRUE(refused);
    EXPECT_EQ(refused->why, Refusal::ProtocolError);
    expectNobodyElse(0);
}

TEST_F(SocketsTest, AnotherServerKeyIsNotTrusted) {
    start();
    LinkPlayer& ann = addPlayer("Ann");
    ann.trusts = false;
    ASSERT_TRUE(runUntil([&] { return ann.link.stage() == ClientLink::Stage::Ended; }));
    EXPECT_NE(ann.link.reason().find("key has changed"), std::string::npos) << ann.link.reason();
    EXPECT_EQ(server_->server.state().clients.known.byName("Ann"), nullptr) << "nothing was said to it";
    expectNobodyElse(0);
}

TEST_F(SocketsTest, AServerThatStartsAgainIsJoinedAgain) {
    start();
    LinkPlayer& ann = addPlayer("Ann");
    ASSERT_TRUE(runUntil([&] { return ann.isLoaded(); }));
    const world::BlockPos pos = ann.above(2);
    ASSERT_EQ(ann.put(pos, "glass"), game::EditResult::Applied);
    ASSERT_TRUE(runUntil([&] { return ann.world->undecidedCount() == 0; }));
    server_->sockets->stopListening();
    ASSERT_TRUE(stop(server_->server.state(), "a pause"));
    ASSERT_TRUE(runUntil([&] { return !ann.isJoined(); }));
    EXPECT_EQ(ann.link.reason(), "a pause");
    server_.reset();
    ann.ahead += std::chrono::seconds(1);  // the next attempt is due
    ASSERT_TRUE(runUntil([&] { return ann.link.reason() != "a pause"; })) << "nobody listens";
    EXPECT_NE(ann.link.stage(), ClientLink::Stage::Ended) << ann.link.reason();
    start();
    ann.ahead += std::chrono::seconds(2);
    ASSERT_TRUE(runUntil([&] { return ann.joins == 2 && ann.isLoaded(); })) << ann.link.reason();
    EXPECT_EQ(ann.session->world().block(pos), contentBlock("glass"));
    EXPECT_TRUE(builds(ann));
}

TEST_F(SocketsTest, WhoIsSentAwayStaysAway) {
    start();
    LinkPlayer& ann = addPlayer("Ann");
    ASSERT_TRUE(runUntil([&] { return ann.isLoaded(); }));
    for (int k = 0; k < 100; ++k) ann.world->say("still talking");  // in transit meanwhile
    EXPECT_EQ(runConsoleLine(server_->server.state(), "kick Ann enough"), "Ann is sent away");
    ASSERT_TRUE(runUntil([&] { return ann.link.stage() != ClientLink::Stage::Joined; }));
    EXPECT_EQ(ann.link.stage(), ClientLink::Stage::Ended);
    EXPECT_EQ(ann.link.reason(), "you were kicked: enough");
    expectNobodyElse(0);
}

// ——— connections that do nothing

TEST_F(SocketsTest, OpenConnectionsKeepNobodyOut) {
    const std::size_t count = atDepth(600, 10'000);
    base::raiseOpenFileLimit();
    start();
    LinkPlayer& ann = addPlayer("Ann");
    ASSERT_TRUE(runUntil([&] { return ann.isLoaded(); }));
    // The header of a TLS record of 500 bytes: the server waits for the rest.
    const std::array<char, 5> begun{0x16, 0x03, 0x01, 0x01, static_cast<char>(0xf4)};
    for (const bool begins : {false, true}) {
        const std::size_t before = base::residentBytes();
        std::vector<Tcp::socket> sockets;
        std::size_t most = 0;
        for (std::size_t k = 0; k < count; ++k) {
            SocketError error;
            sockets.emplace_back(context_).connect(localPort(port_), error);
            if (begins && !error) asio::write(sockets.back(), asio::buffer(begun), error);
            // Accept all before opening more, since nothing else empties the system's queue.
            if (k % 50 == 49) (void)runUntil([&] { return context_.poll() == 0; });
            most = std::max(most, server_->sockets->connectionCount());
        }
        EXPECT_TRUE(builds(ann));
        most = std::max(most, server_->sockets->connectionCount());
        EXPECT_LE(most, kMaxPendingConnections + 1);
        EXPECT_GE(most, std::min(count, kMaxPendingConnections / 2));
        const std::size_t now = base::residentBytes();
        fmt::print("{} connections that {}: {} are kept, {} KiB\n", count,
                   begins ? "begin TLS" : "say nothing", most, (now - std::min(before, now)) / 1024);
        LinkPlayer& bob = addPlayer(begins ? "Bob" : "Cid");
        EXPECT_TRUE(runUntil([&] { return bob.isJoined(); })) << bob.link.reason();
        bob.link.leave();
        players_.pop_back();
    }
    expectNobodyElse(1);
}

TEST_F(SocketsTest, WhoStopsReadingIsSentAway) {
    ServerSettings settings = patientSettings();
    settings.maxUnsentBytes = 1'000'000;
    start(settings);
    TestProxy proxy(context_, port_);
    LinkPlayer& ann = addPlayer("Ann");
    LinkPlayer& bob = addPlayer("Bob", proxy.port());
    ASSERT_TRUE(runUntil([&] { return ann.isLoaded() && bob.isLoaded(); }));
    proxy.isStalled = true;
    const std::string line = "say " + std::string(390, 'x');
    // The system's buffers hold several megabytes. More lines are sent only after Ann has read the earlier
    // ones.
    EXPECT_TRUE(runUntil([&] {
        ServerState& state = server_->server.state();
        const bool hasAnnRead = std::ranges::any_of(state.clients.all, [](const auto& entry) {
            return entry.second.outgoing.size() + entry.second.unsent == 0;
        });
        for (int k = 0; hasAnnRead && k < 60; ++k) (void)runConsoleLine(state, line);
        return state.clients.playing.size() == 1;
    }));
    EXPECT_TRUE(ann.isJoined()) << ann.link.reason();
    expectNobodyElse(1);
    EXPECT_TRUE(builds(ann));
    // It reconnects when it reads again.
    proxy.isStalled = false;
    EXPECT_TRUE(runUntil([&] { return bob.joins == 2; })) << bob.link.reason();
}

}  // namespace
}  // namespace terrane::net

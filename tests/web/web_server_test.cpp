// Tests of connections and their limits: terrane/web/web_server.cpp.
#include "terrane/web/web_server.h"

#include <gmock/gmock.h>
#include <ifaddrs.h>
#include <net/if.h>

#include <boost/asio/post.hpp>
#include <functional>

#include "tests/web/web_server_fixture.h"

namespace terrane::web {
namespace {

using testing::HasSubstr;

// With limits of 0 s, a tick closes connections that would otherwise be closed seconds later.
TEST_F(WebServerTest, ClosesWhoAsksTooSlowly) {
    WebLimits limits;
    limits.headerTimeout = std::chrono::seconds(0);
    WebServer& server = start(limits);
    Browser silent = browser(), patient = browser();
    patient.get("/a");
    EXPECT_EQ(next(patient).body, "a");
    ASSERT_EQ(connectionCount(), 2u);
    server.tick();
    EXPECT_TRUE(isClosedSoon(silent)) << "the first request is due at once";
    EXPECT_FALSE(patient.isClosed()) << "there is no request to wait for";
    for (const char* part : {"G", "GET / HTTP/1.1\r\n", "GET / HTTP/1.1\r\nHost: localhost\r\n"}) {
        Browser slow = browser();
        slow.get("/b");
        EXPECT_EQ(next(slow).body, "b");
        slow.send(part);
        EXPECT_TRUE(isClosedByTicks(slow)) << part;
    }
    server.tick();
    EXPECT_FALSE(patient.isClosed());
}

TEST_F(WebServerTest, ClosesWhoIsIdle) {
    WebLimits limits;
    limits.idleTimeout = std::chrono::seconds(0);
    start(limits);
    Browser fresh = browser(), idle = browser();
    idle.get("/a");
    EXPECT_EQ(next(idle).body, "a");
    EXPECT_TRUE(isClosedByTicks(idle));
    EXPECT_FALSE(fresh.isClosed()) << "its first request may take longer";
    EXPECT_EQ(connectionCount(), 1u);
}

TEST_F(WebServerTest, ClosesWhoDoesNotRead) {
    WebLimits limits;
    limits.sendTimeout = limits.idleTimeout = std::chrono::seconds(0);
    WebServer& server = start(limits);
    Browser lazy = browser("127.0.0.1", 4096);
    lazy.get("/large.bin");
    ASSERT_TRUE(runUntil([&] { return large_.use_count() == 2; }));
    EXPECT_EQ(connectionCount(), 1u);
    server.tick();
    EXPECT_EQ(connectionCount(), 0u);
    EXPECT_TRUE(runUntil([&] { return large_.use_count() == 1; })) << "the answer is let go";
}

TEST_F(WebServerTest, AnswersThatAreLookedForMayTakeLong) {
    WebLimits limits;
    limits.headerTimeout = limits.sendTimeout = limits.idleTimeout = std::chrono::seconds(0);
    WebServer& server = start(limits);
    Browser one = browser();
    one.get("/api/block?x=1&y=2");
    ASSERT_TRUE(runUntil([&] { return replies_.size() == 1; }));
    for (int k = 0; k < 3; ++k) server.tick();
    replies_[0](textResponse(200, "late"));
    EXPECT_EQ(next(one).body, "late");
    EXPECT_EQ(cancelled_, 0);
}

TEST_F(WebServerTest, NewcomersGetTheRoomOfIdleOnes) {
    WebLimits limits;
    limits.connections = 4;
    start(limits);
    Browser busy = browser();
    busy.get("/api/block?x=1&y=2");
    ASSERT_TRUE(runUntil([&] { return replies_.size() == 1; }));
    std::vector<Browser> idle;
    for (int k = 0; k < 3; ++k) {
        idle.push_back(browser());
        idle.back().get("/a");
        EXPECT_EQ(next(idle.back()).body, "a");
    }
    idle[0].get("/again");
    EXPECT_EQ(next(idle[0]).body, "again");
    Browser fresh = browser();
    fresh.get("/b");
    EXPECT_EQ(next(fresh).body, "b");
    EXPECT_TRUE(isClosedSoon(idle[1])) << "the one that was idle for longest";
    EXPECT_FALSE(idle[0].isClosed());
    EXPECT_FALSE(idle[2].isClosed());
    EXPECT_FALSE(busy.isClosed());
    EXPECT_EQ(connectionCount(), 4u);
    EXPECT_EQ(server_->statistics().refused, 1u);
    replies_[0](textResponse(200, "late"));
    EXPECT_EQ(next(busy).body, "late");
}

TEST_F(WebServerTest, WhereAllAreBusyTheFirstOneGoes) {
    WebLimits limits;
    limits.connections = 2;
    start(limits);
    Browser one = browser(), two = browser();
    one.get("/api/block?x=1&y=2");
    two.get("/api/block?x=1&y=2");
    ASSERT_TRUE(runUntil([&] { return replies_.size() == 2; }));
    Browser fresh = browser();
    fresh.get("/b");
    EXPECT_EQ(next(fresh).body, "b");
    EXPECT_EQ(connectionCount(), 2u);
    EXPECT_EQ(cancelled_, 1);
    for (const Reply& reply : replies_) reply(textResponse(200, "late"));
    EXPECT_TRUE(runUntil([&] { return one.take().has_value() != two.take().has_value(); }));
}

// A local address other than loopback: the server treats it as remote.
std::optional<std::string> otherAddress() {
    ifaddrs* all = nullptr;
    if (::getifaddrs(&all) != 0) return std::nullopt;
    std::optional<std::string> found;
    for (const ifaddrs* each = all; each; each = each->ifa_next) {
        if (!each->ifa_addr || each->ifa_addr->sa_family != AF_INET || (each->ifa_flags & IFF_LOOPBACK))
            continue;
        char text[INET_ADDRSTRLEN] = {};
        const auto* address = reinterpret_cast<const sockaddr_in*>(each->ifa_addr);
        if (::inet_ntop(AF_INET, &address->sin_addr, text, sizeof(text))) found = text;
    }
    ::freeifaddrs(all);
    return found;
}

TEST_F(WebServerTest, AnAddressHasSoManyRequests) {
    const auto address = otherAddress();
    if (!address) GTEST_SKIP() << "this machine has no address but the loopback";
    WebLimits limits;
    limits.requestsPerSecond = 0.001;
    limits.requestBurst = 5;
    start(limits, {"0.0.0.0", 0});
    Browser stranger = browser(*address), again = browser(*address), local = browser();
    for (int k = 0; k < 5; ++k) {
        stranger.get("/a");
        EXPECT_EQ(next(stranger).status, 200);
    }
    for (Browser* one : {&stranger, &again}) {
        one->get("/a");
        const Received refused = next(*one);
        EXPECT_EQ(refused.status, 429) << "also on another connection";
        EXPECT_EQ(refused.field("Retry-After"), "1");
    }
    for (int k = 0; k < 20; ++k) {
        local.get("/a");
        EXPECT_EQ(next(local).status, 200) << "a proxy on this machine asks for many";
    }
    EXPECT_EQ(server_->statistics().refused, 2u);
}

TEST_F(WebServerTest, AnAddressHasSoManyConnections) {
    const auto address = otherAddress();
    if (!address) GTEST_SKIP() << "this machine has no address but the loopback";
    WebLimits limits;
    limits.connectionsPerAddress = 2;
    start(limits, {"0.0.0.0", 0});
    Browser one = browser(*address), two = browser(*address);
    for (Browser* each : {&one, &two}) {
        each->get("/a");
        EXPECT_EQ(next(*each).status, 200);
    }
    Browser three = browser(*address), local = browser();
    EXPECT_TRUE(isClosedSoon(three));
    local.get("/a");
    EXPECT_EQ(next(local).status, 200);
    one.close();
    EXPECT_TRUE(runUntil([&] { return connectionCount() == 2; }));
    Browser four = browser(*address);
    four.get("/a");
    EXPECT_EQ(next(four).status, 200) << "there is room again";
}

TEST_F(WebServerTest, ItsEndClosesAll) {
    start();
    Browser idle = browser(), busy = browser(), listener = browser();
    idle.get("/a");
    busy.get("/api/block?x=1&y=2");
    listener.get("/api/edits");
    EXPECT_EQ(next(idle).body, "a");
    ASSERT_TRUE(runUntil([&] { return replies_.size() == 1 && hub_.count() == 1; }));
    server_.reset();
    EXPECT_EQ(cancelled_, 1);
    replies_[0](textResponse(200, "too late"));
    hub_.publish("edits", "[1]", false);
    EXPECT_EQ(hub_.count(), 0u);
    for (Browser* each : {&idle, &busy, &listener}) EXPECT_TRUE(isClosedSoon(*each));
    EXPECT_EQ(busy.text(), "");
}

// The server may be destroyed while the context has an accepted connection that is not reported yet.
TEST_F(WebServerTest, NobodyIsAcceptedAfterItsEnd) {
    for (int rounds = 0; rounds < 5; ++rounds) {
        start();
        runShortly();
        Browser late = browser();
        late.get("/api/block?x=1&y=2");
        std::function<void(int)> endAfter = [&](int left) {
            if (left == 0) return server_.reset();
            boost::asio::post(context_, [&, left] { endAfter(left - 1); });
        };
        context_.restart();
        endAfter(rounds + 1);
        while (server_) context_.poll_one();
        EXPECT_TRUE(isClosedSoon(late)) << rounds;
    }
    EXPECT_EQ(replies_.size(), static_cast<std::size_t>(cancelled_)) << "nobody is asked after the end";
}

TEST_F(WebServerTest, AnAddressIsListenedOnOnce) {
    const std::uint16_t port = start().port();
    EXPECT_GT(port, 0);
    const auto open = [&](const WebAddress& address) {
        return WebServer::open(
            context_, address, [](const Route&, const Reply&) { return Cancel(); }, hub_);
    };
    const auto second = open({"127.0.0.1", port});
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().code, base::ErrorCode::Busy);
    EXPECT_THAT(second.error().message, HasSubstr(std::to_string(port)));
    for (const char* wrong : {"", "localhost:80", "1.2.3", "here"}) {
        const auto server = open({wrong, 0});
        ASSERT_FALSE(server) << wrong;
        EXPECT_EQ(server.error().code, base::ErrorCode::BadInput);
    }
}

}  // namespace
}  // namespace terrane::web

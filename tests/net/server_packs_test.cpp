// Content packs from a server to a client that lacks them.
#include "terrane/net/server/server_login.h"

#include <gtest/gtest.h>

#include "terrane/net/client/client_link.h"
#include "tests/net/server_fixture.h"

namespace terrane::net {
namespace {

// Two packs, one of several parts.
ServerContent twoPacks() {
    ServerContent content;
    for (const std::size_t size : {std::size_t{100}, 2 * kMaxPackPart + 5}) {
        auto archive = std::make_shared<Bytes>(size);
        fillRandom(*archive);
        PackOffer offer{"p" + std::to_string(size), "1", {}, static_cast<std::uint32_t>(size)};
        content.packs.push_back({offer, archive});
    }
    return content;
}

class ServerPacks : public testing::Test {
  protected:
    // Logs in up to WorldOffer.
    WorldOffer offerTo(TestWire& wire) {
        const ClientIdentity identity = testIdentity("ann");
        wire.say(helloOf(identity));
        auto messages = wire.take();
        wire.say(loginOf(identity, *findMessage<Greeting>(messages), wire.channel));
        messages = wire.take();
        return *findMessage<WorldOffer>(messages);
    }
    bool isRefused(TestWire& wire) { return findMessage<Refused>(wire.take()) != nullptr; }

    base::TempFolder folder_;
    ServerContent content_ = twoPacks();
    TestServer server_{folder_.path(), {}, content_};
};

TEST_F(ServerPacks, ComePartByPart) {
    TestWire wire(server_);
    PackFetch fetch{offerTo(wire), {1, 0}, {}};
    ASSERT_EQ(fetch.offer.packs.size(), 2u);
    EXPECT_EQ(fetch.offer.packs[1], content_.packs[1].offer);
    std::vector<Bytes> archives;
    while (const auto ask = nextPart(fetch)) {
        wire.say(*ask);
        const auto messages = wire.take();
        const auto* part = findMessage<PackPart>(messages);
        ASSERT_NE(part, nullptr);
        const auto isWhole = takePart(fetch, *part);
        ASSERT_TRUE(isWhole) << isWhole.error().message;
        if (!*isWhole) continue;
        archives.push_back(std::exchange(fetch.archive, {}));
        fetch.missing.pop_back();
    }
    ASSERT_EQ(archives.size(), 2u);
    EXPECT_EQ(archives[0], *content_.packs[0].archive);
    EXPECT_EQ(archives[1], *content_.packs[1].archive);
    wire.say(Proof{server_.state().offer.digests});
    EXPECT_TRUE(findMessage<Joined>(wire.take()));
}

// Limit per connection: each pack once.
TEST_F(ServerPacks, AreSentOnce) {
    TestWire wire(server_);
    offerTo(wire);
    wire.say(AskPack{0, 0});
    EXPECT_FALSE(isRefused(wire));
    wire.say(AskPack{0, 0});
    EXPECT_TRUE(isRefused(wire));
}

TEST_F(ServerPacks, OtherOrdersAreRefused) {
    for (const AskPack ask : {AskPack{2, 0}, AskPack{1, 5}, AskPack{0, 100}, AskPack{255, 0}}) {
        TestWire wire(server_);
        offerTo(wire);
        wire.say(ask);
        EXPECT_TRUE(isRefused(wire)) << int{ask.number} << " " << ask.offset;
    }
    TestWire early(server_);
    early.say(AskPack{0, 0});
    EXPECT_TRUE(isRefused(early));
    TestWire late(server_);
    ASSERT_TRUE(std::holds_alternative<Joined>(logIn(late, testIdentity("bob"))));
    late.say(AskPack{0, 0});
    EXPECT_TRUE(isRefused(late));
}

TEST_F(ServerPacks, AClientTakesOnlyWhatItAskedFor) {
    TestWire wire(server_);
    const WorldOffer offer = offerTo(wire);
    const auto take = [&](const PackPart& part) {
        PackFetch fetch{offer, {0}, {}};
        return takePart(fetch, part).has_value();
    };
    EXPECT_TRUE(take({0, 0, Bytes(50)}));
    EXPECT_FALSE(take({1, 0, Bytes(50)}));
    EXPECT_FALSE(take({0, 1, Bytes(50)}));
    EXPECT_FALSE(take({0, 0, Bytes(101)}));
    EXPECT_FALSE(take({0, 0, {}}));
    PackFetch none{offer, {}, {}};
    EXPECT_FALSE(takePart(none, {0, 0, Bytes(50)}));
}

// Clients that download parts get more login time, others do not.
TEST_F(ServerPacks, TheLoginWaitsForPacks) {
    TestWire fetching(server_), idle(server_);
    offerTo(fetching);
    offerTo(idle);
    fetching.say(AskPack{1, 0});
    fetching.say(AskPack{1, kMaxPackPart});
    fetching.take();
    const auto wait = server_.state().settings.loginWithin + std::chrono::seconds(1);
    server_.now += wait;
    server_.tick();
    EXPECT_FALSE(isRefused(fetching));
    EXPECT_TRUE(isRefused(idle));
}

}  // namespace
}  // namespace terrane::net

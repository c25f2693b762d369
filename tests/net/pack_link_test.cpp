// A client's link that downloads content packs before it joins, over sockets.
#include <gtest/gtest.h>

#include "terrane/net/server/server_clients.h"
#include "tests/net/socket_fixture.h"

namespace terrane::net {
namespace {

class PackLink : public testing::Test {
  protected:
    // Runs until the link is joined or ended.
    void run(LinkEvents events) {
        ClientLink link(context_, {"127.0.0.1", server_.sockets->port()}, testIdentity("ann"),
                        std::move(events));
        const auto isOver = [&] { return link.stage() != ClientLink::Stage::Connecting; };
        const auto step = [&] {
            link.update(std::chrono::steady_clock::now());
            server_.update();
            context_.restart();
            // One message at a time; otherwise a login completes in a single call.
            context_.run_one_for(std::chrono::milliseconds(5));
            if (!untimely_) return;
            for (auto& [id, client] : server_.server.state().clients.all) send(client, *untimely_);
            server_.sockets->flush();
        };
        EXPECT_TRUE(base::waitUntil(isOver, step));
        stage_ = link.stage();
        reason_ = link.reason();
    }
    LinkEvents events() {
        return {[](const std::string&) { return true; },
                [this](const WorldOffer& offer) -> base::Result<SampleDigests> {
                    proved_ = true;
                    return sampleDigests(*offeredGenerator(offer, contentBlocks()), offer.samples);
                },
                [](const ServerMessage&) {},
                [](const WorldOffer&) {
                    return std::vector<std::uint8_t>{1, 0};
                },
                [this](const PackOffer& offer, const Bytes& archive) -> base::Result<void> {
                    got_[offer.name] = archive;
                    return {};
                }};
    }
    static ServerContent content() {
        ServerContent made;
        for (const std::size_t size : {kMaxPackPart + 1, std::size_t{10}}) {
            auto archive = std::make_shared<Bytes>(size);
            fillRandom(*archive);
            made.packs.push_back(
                {{"p" + std::to_string(made.packs.size()), "", {}, static_cast<std::uint32_t>(size)},
                 archive});
        }
        return made;
    }

    base::TempFolder folder_;
    boost::asio::io_context context_;
    ServerContent content_ = content();
    SocketServer server_{context_, folder_.path(), 0, patientSettings(), content_};
    ClientLink::Stage stage_{};
    std::string reason_;
    bool proved_ = false;
    std::optional<ServerMessage> untimely_;  // what the server sends besides, all the time
    std::map<std::string, Bytes> got_;
};

TEST_F(PackLink, GetsWhatItLacksAndJoins) {
    run(events());
    EXPECT_EQ(stage_, ClientLink::Stage::Joined) << reason_;
    EXPECT_EQ(got_["p0"], *content_.packs[0].archive);
    EXPECT_EQ(got_["p1"], *content_.packs[1].archive);
}

// Listeners of Joined rely on the offer.
TEST_F(PackLink, LeavesAServerThatLetsItInBeforeTheProof) {
    untimely_ = Joined{};
    run(events());
    EXPECT_EQ(stage_, ClientLink::Stage::Ended);
    EXPECT_EQ(reason_, "the server let the player in before it offered its world");
    EXPECT_FALSE(proved_);
}

TEST_F(PackLink, LeavesAServerThatOffersItsWorldTwice) {
    untimely_ = WorldOffer{};
    auto withoutPacks = events();
    withoutPacks.missingPacks = {};
    withoutPacks.prove = [](const WorldOffer&) -> base::Result<SampleDigests> { return SampleDigests{}; };
    run(std::move(withoutPacks));
    EXPECT_EQ(stage_, ClientLink::Stage::Ended);
    EXPECT_EQ(reason_, "the server offered its world twice");
}

TEST_F(PackLink, LeavesAServerThatSendsBlocksOutsideOfItsWorld) {
    for (const world::BlockIndex index : {-1, 256 * 256}) {
        untimely_ = BlocksChanged{{0, 0}, {{index, {1, 0, {}}}}};
        run(events());
        EXPECT_EQ(stage_, ClientLink::Stage::Ended);
        EXPECT_EQ(reason_, "the server sent blocks above or below its world");
    }
}

TEST_F(PackLink, JoinsWithoutPacksThatItHas) {
    LinkEvents has = events();
    has.missingPacks = [](const WorldOffer&) { return std::vector<std::uint8_t>(); };
    run(has);
    EXPECT_EQ(stage_, ClientLink::Stage::Joined) << reason_;
    EXPECT_TRUE(got_.empty());
}

TEST_F(PackLink, EndsWhereThePlayerDoesNotAcceptThem) {
    LinkEvents refuses = events();
    refuses.missingPacks = [](const WorldOffer&) -> base::Result<std::vector<std::uint8_t>> {
        return base::fail("packs are missing");
    };
    run(refuses);
    EXPECT_EQ(stage_, ClientLink::Stage::Ended);
    EXPECT_EQ(reason_, "packs are missing");
    EXPECT_FALSE(proved_);
}

TEST_F(PackLink, EndsWhereAPackIsAnother) {
    LinkEvents refuses = events();
    refuses.packArrived = [](const PackOffer& offer, const Bytes&) -> base::Result<void> {
        return base::fail("{} is another pack", offer.name);
    };
    run(refuses);
    EXPECT_EQ(stage_, ClientLink::Stage::Ended);
    EXPECT_EQ(reason_, "p0 is another pack");
    EXPECT_FALSE(proved_);
}

}  // namespace
}  // namespace terrane::net

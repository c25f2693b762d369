// Servers of worlds of other heights than 0…255, without sockets: edits, claims, places and the history at
// their lowest and highest layers.
#include <gmock/gmock.h>

#include <algorithm>

#include "terrane/game/places.h"
#include "terrane/net/server/server_console.h"
#include "tests/net/hostile_fixture.h"

namespace terrane::net {
namespace {

using testing::HasSubstr;
using world::BlockPos;
using world::Heights;

class TallServer : public testing::TestWithParam<Heights> {
  protected:
    Heights heights() const { return GetParam(); }
    int lowest() const { return heights().bottom; }
    int highest() const { return heights().top - 1; }
    std::unique_ptr<TestServer> open(const std::filesystem::path& folder) {
        return std::make_unique<TestServer>(
            serverParts(folder / "w.sqlite", heights()),
            SqliteRecords::open(folder / "w.server.sqlite", contentBlocks()).value(), patientSettings());
    }
    // An operator, who may move to any height at once.
    void join(TestServer& server, std::unique_ptr<TestPlayer>& player, const std::string& name) {
        player = std::make_unique<TestPlayer>(server, testIdentity(name));
        (void)runConsoleLine(server.state(), "op " + name);
        ASSERT_TRUE(stepUntil(server, {player.get()}, [&] { return player->isLoaded(); }));
    }
    void go(TestServer& server, TestPlayer& player, int z) {
        player.pose.position.z = z + 0.5;
        ASSERT_TRUE(stepUntil(server, {&player}, [&] {
            return server.state().clients.all.at(player.wire->id).pose == wirePose(player.pose);
        }));
    }
    static BlockPos under(const TestPlayer& player, int z) {
        const BlockPos eyes = world::blockOf(player.pose.position);
        return {eyes.x + 1, eyes.y, z};
    }
    // Puts a block at a height, and waits until the server has decided.
    void build(TestServer& server, TestPlayer& player, int z, std::string_view name) {
        ASSERT_NO_FATAL_FAILURE(go(server, player, std::clamp(z, lowest(), highest())));
        ASSERT_EQ(player.put(under(player, z), name), game::EditResult::Applied) << z;
        ASSERT_TRUE(stepUntil(server, {&player}, [&] { return player.world->undecidedCount() == 0; }));
        EXPECT_EQ(server.state().session.world().block(under(player, z)), contentBlock(name));
    }

    base::TempFolder folder_;
};

INSTANTIATE_TEST_SUITE_P(Tall, TallServer, testing::Values(Heights{-64, 320}, Heights{-2048, 2048}),
                         [](const auto& kind) { return fmt::format("{}", kind.param.top); });

TEST_P(TallServer, WhatOneBuildsTheOtherSees) {
    const auto server = open(folder_.path());
    std::unique_ptr<TestPlayer> ann, bob;
    ASSERT_NO_FATAL_FAILURE(join(*server, ann, "Ann"));
    ASSERT_NO_FATAL_FAILURE(join(*server, bob, "Bob"));
    EXPECT_EQ(ann->session->world().heights(), heights());
    const int heightsToBuild[] = {lowest() + 1, -1, highest()};
    for (const int z : heightsToBuild) ASSERT_NO_FATAL_FAILURE(build(*server, *ann, z, "glass"));
    const auto sees = [&](const TestPlayer& player) {
        return std::ranges::all_of(
            heightsToBuild, [&](int z) { return player.block(under(*ann, z)) == contentBlock("glass"); });
    };
    // From the bottom, all is needed that is above.
    ASSERT_NO_FATAL_FAILURE(go(*server, *bob, lowest()));
    EXPECT_TRUE(stepUntil(*server, {ann.get(), bob.get()}, [&] { return sees(*bob); }));
    std::unique_ptr<TestPlayer> cid;
    ASSERT_NO_FATAL_FAILURE(join(*server, cid, "Cid"));
    ASSERT_NO_FATAL_FAILURE(go(*server, *cid, lowest()));
    EXPECT_TRUE(stepUntil(*server, {cid.get()}, [&] { return sees(*cid); }))
        << "as a difference of the chunk";
}

// Ann stands on the ground or above it; Bob builds in a hall far below, beside her.
TEST_P(TallServer, WhatIsFarBelowIsToldWhenSomebodyNeedsIt) {
    const auto server = open(folder_.path());
    std::unique_ptr<TestPlayer> ann, bob;
    ASSERT_NO_FATAL_FAILURE(join(*server, ann, "Ann"));
    ASSERT_NO_FATAL_FAILURE(join(*server, bob, "Bob"));
    ASSERT_NO_FATAL_FAILURE(go(*server, *ann, highest()));
    ASSERT_TRUE(stepUntil(*server, {ann.get(), bob.get()}, [&] { return ann->isLoaded(); }));
    const BlockPos deep = under(*bob, lowest() + 1), top = under(*bob, highest());
    ASSERT_NO_FATAL_FAILURE(build(*server, *bob, deep.z, "glass"));
    ASSERT_TRUE(stepUntil(*server, {bob.get()}, [&] { return bob->block(deep) == contentBlock("glass"); }));
    for (int k = 0; k < 50; ++k) step(*server, {ann.get(), bob.get()});
    const world::ChunkPos chunk = world::chunkOf(deep);
    EXPECT_TRUE(ann->store->difference(chunk).empty()) << "of " << deep.z;
    EXPECT_NE(ann->block(deep), contentBlock("glass"));
    // What is near her in the same chunk comes alone, and again with the rest once she is there.
    ASSERT_NO_FATAL_FAILURE(build(*server, *bob, top.z, "stone"));
    ASSERT_TRUE(
        stepUntil(*server, {ann.get(), bob.get()}, [&] { return ann->block(top) == contentBlock("stone"); }));
    EXPECT_EQ(ann->store->difference(chunk).size(), 1u);
    ASSERT_NO_FATAL_FAILURE(go(*server, *ann, lowest() + 3));
    EXPECT_TRUE(stepUntil(*server, {ann.get(), bob.get()},
                          [&] { return ann->block(deep) == contentBlock("glass"); }));
    EXPECT_EQ(ann->store->difference(chunk).size(), 2u);
    EXPECT_EQ(ann->block(top), contentBlock("stone"));
    // Changes come at once now.
    ASSERT_NO_FATAL_FAILURE(build(*server, *bob, deep.z, "dirt"));
    EXPECT_TRUE(
        stepUntil(*server, {ann.get(), bob.get()}, [&] { return ann->block(deep) == contentBlock("dirt"); }));
}

// By a script: players do not break the lowest layer.
TEST_P(TallServer, TheLowestLayer) {
    const auto server = open(folder_.path());
    std::unique_ptr<TestPlayer> ann;
    ASSERT_NO_FATAL_FAILURE(join(*server, ann, "Ann"));
    ASSERT_NO_FATAL_FAILURE(go(*server, *ann, lowest()));
    const BlockPos pos = under(*ann, lowest());
    game::Session& session = server->state().session;
    (void)session.pipeline().chunkAt(world::chunkOf(pos));
    ASSERT_EQ(session.edit({game::kNoPlayer, pos, world::SetBlock{contentBlock("glass")}, {}}),
              game::EditResult::Applied);
    ASSERT_TRUE(stepUntil(*server, {ann.get()}, [&] { return ann->block(pos) == contentBlock("glass"); }));
    EXPECT_EQ(ann->put(pos, "air"), game::EditResult::Protected);
}

TEST_P(TallServer, PositionsOutsideOfTheWorldAreRefused) {
    const auto server = open(folder_.path());
    std::unique_ptr<TestPlayer> ann;
    ASSERT_NO_FATAL_FAILURE(join(*server, ann, "Ann"));
    for (const int z : {lowest() - 1, highest() + 1}) {
        ASSERT_NO_FATAL_FAILURE(go(*server, *ann, z));
        const BlockPos pos = under(*ann, z);
        EXPECT_EQ(ann->put(pos, "glass"), game::EditResult::NotLoaded);
        TestWire eve(*server);
        ASSERT_TRUE(
            std::holds_alternative<Joined>(logIn(eve, testIdentity("Eve" + std::to_string(z + 9000)))));
        (void)runConsoleLine(server->state(), "op Eve" + std::to_string(z + 9000));
        eve.say(Move{wirePose(ann->pose)});
        eve.say(Edit{1, pos, world::SetBlock{contentBlock("glass")}, {}});
        const bool isInSomeWorld = z >= world::kLowestBottom && z < world::kHighestTop;
        if (!isInSomeWorld) {
            EXPECT_EQ(refusalOf(eve), Refusal::ProtocolError);
            continue;
        }
        eve.say(Fill{2, {{pos, pos}, contentBlock("glass"), 0, {}}});
        std::vector<Done> done;
        ASSERT_TRUE(stepUntil(*server, {ann.get()}, [&] {
            eve.say(Pong{0});
            for (const ServerMessage& message : eve.take())
                if (const auto* decided = std::get_if<Done>(&message)) done.push_back(*decided);
            return done.size() == 2;
        }));
        EXPECT_EQ(static_cast<game::EditResult>(done[0].result), game::EditResult::NotLoaded);
        EXPECT_EQ(static_cast<game::BuildOutcome::Result>(done[1].result),
                  game::BuildOutcome::Result::OutOfWorld);
    }
}

TEST_P(TallServer, ClaimsReachFromTheBottomToTheTop) {
    const auto server = open(folder_.path());
    std::unique_ptr<TestPlayer> ann, bob;
    ASSERT_NO_FATAL_FAILURE(join(*server, ann, "Ann"));
    ASSERT_NO_FATAL_FAILURE(join(*server, bob, "Bob"));
    const BlockPos at = under(*ann, 0);
    ASSERT_THAT(runConsoleLine(server->state(), fmt::format("claim Home {} {} {} {} Ann", at.x - 9, at.y - 9,
                                                            at.x + 9, at.y + 9)),
                HasSubstr("is claimed for Ann"));
    for (const int z : {lowest() + 1, -1, highest()}) {
        ASSERT_NO_FATAL_FAILURE(build(*server, *ann, z, "glass"));
        const BlockPos pos = under(*ann, z);
        (void)runConsoleLine(server->state(), "op Bob");
        bob->pose = ann->pose;
        ASSERT_NO_FATAL_FAILURE(go(*server, *bob, z));
        (void)runConsoleLine(server->state(), "deop Bob");
        ASSERT_TRUE(
            stepUntil(*server, {bob.get()}, [&] { return bob->block(pos) == contentBlock("glass"); }));
        ASSERT_EQ(bob->put(pos, "air"), game::EditResult::Applied) << "until the server has decided";
        ASSERT_TRUE(stepUntil(*server, {bob.get()}, [&] { return bob->world->undecidedCount() == 0; }));
        const auto decided = bob->world->popDecided();
        ASSERT_EQ(decided.size(), 1u);
        EXPECT_EQ(std::get<game::EditResult>(decided[0]), game::EditResult::Claimed) << z;
        EXPECT_EQ(bob->block(pos), contentBlock("glass"));
    }
}

TEST_P(TallServer, PlacesAreAtAnyHeight) {
    const auto server = open(folder_.path());
    for (const int z : {lowest(), -1, highest()})
        EXPECT_THAT(runConsoleLine(server->state(), fmt::format("mark 1 2 {} at {}", z, z + 5000)),
                    HasSubstr("is marked"));
    const auto places = game::savedPlaces(server->state().session.store());
    ASSERT_EQ(places.size(), 3u);
    EXPECT_EQ(places[0].pose.position.z, lowest());
    EXPECT_EQ(places[2].pose.position.z, highest());
}

// What was acknowledged survives a crash, at all heights; then it is rolled back.
TEST_P(TallServer, TheHistoryKnowsAllHeights) {
    const auto first = folder_ / "first", copy = folder_ / "copy";
    std::filesystem::create_directories(first);
    std::filesystem::create_directories(copy);
    std::vector<BlockPos> built;
    {
        const auto server = open(first);
        std::unique_ptr<TestPlayer> ann;
        ASSERT_NO_FATAL_FAILURE(join(*server, ann, "Ann"));
        for (const int z : {lowest() + 1, -1, 0, highest()}) {
            ASSERT_NO_FATAL_FAILURE(build(*server, *ann, z, "glass"));
            built.push_back(under(*ann, z));
        }
        // The state after a crash: only the server's file has the edits.
        for (const auto& entry : std::filesystem::directory_iterator(first)) {
            const std::string name = entry.path().filename().string();
            if (name.starts_with("w.server.sqlite") && !name.ends_with("lock"))
                std::filesystem::copy(entry.path(), copy / name);
        }
    }
    const auto server = open(copy);
    std::unique_ptr<TestPlayer> bob;
    ASSERT_NO_FATAL_FAILURE(join(*server, bob, "Bob"));
    ASSERT_NO_FATAL_FAILURE(go(*server, *bob, lowest()));
    const auto count = [&] {
        return std::ranges::count_if(built,
                                     [&](BlockPos pos) { return bob->block(pos) == contentBlock("glass"); });
    };
    EXPECT_TRUE(stepUntil(*server, {bob.get()}, [&] { return count() == 4; }));
    EXPECT_THAT(runConsoleLine(server->state(), "rollback Ann 10"), HasSubstr("4 blocks"));
    EXPECT_TRUE(stepUntil(*server, {bob.get()}, [&] { return count() == 0; }));
    EXPECT_TRUE(stop(server->state(), "the end"));
}

// The file of a server belongs to a world of the same heights.
TEST_P(TallServer, RecordsOfOtherHeightsAreRefused) {
    const auto records = folder_ / "w.server.sqlite";
    ASSERT_TRUE(stop(open(folder_.path())->state(), "the end"));
    const auto refused = openServerHost(serverParts(folder_ / "low.sqlite"),
                                        SqliteRecords::open(records, contentBlocks()).value(), {}, "test");
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message, HasSubstr(fmt::format("(seed and generator 1 {}, layers {})",
                                                               kTestGenerator, describe(heights()))));
}

}  // namespace
}  // namespace terrane::net

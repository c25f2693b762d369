// Players on one server, without sockets: each has its own world, and all worlds become equal.
#include "terrane/net/server/server.h"

#include <gmock/gmock.h>

#include <limits>

#include "terrane/net/server/server_console.h"
#include "terrane/net/server/server_history.h"
#include "tests/net/server_fixture.h"

namespace terrane::net {
namespace {

class ServerTest : public testing::Test {
  protected:
    world::BlockPos above(const TestPlayer& player, int dx = 2) const {
        const world::BlockPos eyes = world::blockOf(player.pose.position);
        return {eyes.x + dx, eyes.y, eyes.z + 2};
    }
    // Ann joins and places a block at `pos`, which the server acknowledges.
    void annBuilds(TestServer& server, world::BlockPos& pos) {
        TestPlayer ann(server, testIdentity("Ann"));
        ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return ann.isLoaded(); }));
        pos = above(ann);
        ASSERT_EQ(ann.put(pos, "glass"), game::EditResult::Applied);
        ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return ann.world->undecidedCount() == 0; }));
    }
    base::TempFolder folder_;
};

TEST_F(ServerTest, WhatOneBuildsTheOtherSees) {
    TestServer server(folder_.path());
    TestPlayer ann(server, testIdentity("Ann")), bob(server, testIdentity("Bob"));
    ASSERT_TRUE(stepUntil(server, {&ann, &bob}, [&] { return ann.isLoaded() && bob.isLoaded(); }));
    const world::BlockPos pos = above(ann);
    ASSERT_EQ(ann.put(pos, "glass"), game::EditResult::Applied);
    EXPECT_EQ(ann.block(pos), contentBlock("glass")) << "it shows at once";
    ASSERT_TRUE(stepUntil(server, {&ann, &bob}, [&] { return bob.block(pos) == contentBlock("glass"); }));
    ASSERT_TRUE(stepUntil(server, {&ann, &bob}, [&] { return ann.world->undecidedCount() == 0; }));
    EXPECT_EQ(server.state().session.world().block(pos), contentBlock("glass"));
    // A later player gets the edits, too.
    TestPlayer cid(server, testIdentity("Cid"));
    ASSERT_TRUE(stepUntil(server, {&cid}, [&] { return cid.isLoaded(); }));
    ASSERT_TRUE(stepUntil(server, {&cid}, [&] { return cid.block(pos) == contentBlock("glass"); }));
}

TEST_F(ServerTest, OfTwoWhoBuildAtOnePlaceOneIsTakenBack) {
    TestServer server(folder_.path());
    TestPlayer ann(server, testIdentity("Ann")), bob(server, testIdentity("Bob"));
    ASSERT_TRUE(stepUntil(server, {&ann, &bob}, [&] { return ann.isLoaded() && bob.isLoaded(); }));
    const world::BlockPos pos = above(ann);
    ASSERT_EQ(bob.put(pos, "stone"), game::EditResult::Applied);
    ASSERT_EQ(ann.put(pos, "glass"), game::EditResult::Applied);
    ASSERT_TRUE(stepUntil(server, {&ann, &bob}, [&] {
        return ann.world->undecidedCount() == 0 && bob.world->undecidedCount() == 0;
    }));
    EXPECT_EQ(ann.block(pos), bob.block(pos));
    EXPECT_EQ(server.state().session.world().block(pos), ann.block(pos));
    const auto decided = ann.world->popDecided(), others = bob.world->popDecided();
    EXPECT_EQ(decided.size() + others.size(), 1u) << "one hears of it";
}

TEST_F(ServerTest, FillsAndUndoAreDecidedByTheServer) {
    TestServer server(folder_.path());
    TestPlayer ann(server, testIdentity("Ann"));
    ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return ann.isLoaded(); }));
    const world::BlockPos low = above(ann);
    const world::BlockPos high{low.x + 3, low.y + 3, low.z + 3};
    EXPECT_EQ(
        ann.session->build({game::kLocalPlayer, game::FillBox{{low, high}, contentBlock("glass"), 0, {}}})
            .result,
        game::BuildOutcome::Result::Sent);
    ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return ann.world->undecidedCount() == 0; }));
    EXPECT_EQ(ann.block(high), contentBlock("glass"));
    auto decided = ann.world->popDecided();
    ASSERT_EQ(decided.size(), 1u);
    EXPECT_EQ(std::get<game::BuildOutcome>(decided[0]).changed, 64u);
    EXPECT_EQ(ann.session->undoOrRedo(game::kLocalPlayer, game::HistoryWay::Undo).outcome,
              game::UndoResult::Outcome::Sent);
    ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return ann.world->undecidedCount() == 0; }));
    EXPECT_EQ(ann.block(high), world::kAir);
    decided = ann.world->popDecided();
    ASSERT_EQ(decided.size(), 1u);
    const auto& undone = std::get<DecidedTakeBack>(decided[0]);
    EXPECT_EQ(undone.way, game::HistoryWay::Undo);
    EXPECT_EQ(undone.result.blocks, 64u);
    EXPECT_EQ(ann.session->undoOrRedo(game::kLocalPlayer, game::HistoryWay::Redo).outcome,
              game::UndoResult::Outcome::Sent);
    ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return ann.world->undecidedCount() == 0; }));
    decided = ann.world->popDecided();
    ASSERT_EQ(decided.size(), 1u);
    EXPECT_EQ(std::get<DecidedTakeBack>(decided[0]).way, game::HistoryWay::Redo);
}

// Two concurrent rollbacks of the same edits: the history stays readable.
TEST_F(ServerTest, RollBacksMayOverlap) {
    TestServer server(folder_.path());
    TestPlayer ann(server, testIdentity("Ann"));
    ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return ann.isLoaded(); }));
    const world::BlockPos pos = above(ann);
    ASSERT_EQ(ann.put(pos, "glass"), game::EditResult::Applied);
    ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return ann.world->undecidedCount() == 0; }));
    for (const char* line : {"rollback Ann 10", "rollback Ann 20"})
        (void)runConsoleLine(server.state(), line);
    ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return ann.block(pos) == world::kAir; }));
    ASSERT_TRUE(saveEverything(server.state()));
    int edits = 0;
    const auto count = [&](const LoggedEdit& edit) -> base::Result<void> {
        edits += static_cast<int>(edit.after.size());
        return {};
    };
    ASSERT_TRUE(server.state().history.records.forEachEdit({}, EditOrder::OldestFirst, count));
    EXPECT_EQ(edits, 2);
}

TEST_F(ServerTest, WhatWasAcknowledgedIsThereAfterACrash) {
    const auto first = folder_ / "first", copy = folder_ / "copy";
    std::filesystem::create_directories(first);
    std::filesystem::create_directories(copy);
    world::BlockPos pos;
    {
        TestServer server(first);
        ASSERT_NO_FATAL_FAILURE(annBuilds(server, pos));
        // The state after a crash: only the server's file has the edit.
        for (const auto& entry : std::filesystem::directory_iterator(first)) {
            const std::string name = entry.path().filename().string();
            if (name.starts_with("w.server.sqlite") && !name.ends_with("lock"))
                std::filesystem::copy(entry.path(), copy / name);
        }
    }
    TestServer server(copy);
    TestPlayer bob(server, testIdentity("Bob"));
    ASSERT_TRUE(stepUntil(server, {&bob}, [&] { return bob.isLoaded() && bob.block(pos) != world::kAir; }));
    EXPECT_EQ(bob.block(pos), contentBlock("glass"));
}

TEST_F(ServerTest, PlayersSeeEachOtherAndTalk) {
    TestServer server(folder_.path());
    TestPlayer ann(server, testIdentity("Ann")), bob(server, testIdentity("Bob"));
    ASSERT_TRUE(stepUntil(server, {&ann, &bob}, [&] { return bob.world->players().size() == 1; }));
    EXPECT_EQ(bob.world->players().begin()->second.name, "Ann");
    ann.pose.position.x += 3;
    ASSERT_TRUE(stepUntil(server, {&ann, &bob}, [&] {
        return std::abs(bob.world->players().begin()->second.pose.position.x - ann.pose.position.x) < 0.1;
    }));
    (void)bob.world->popChat();
    ann.world->say("hello");
    step(server, {&ann, &bob});
    const auto chat = bob.world->popChat();
    ASSERT_EQ(chat.size(), 1u);
    EXPECT_EQ(chat[0].name, "Ann");
    EXPECT_EQ(chat[0].text, "hello");
    ann.wire->say(Leave{});
    ASSERT_TRUE(stepUntil(server, {&bob}, [&] { return bob.world->players().empty(); }));
}

TEST_F(ServerTest, LandIsLoadedOnlyAroundThoseWhoBuild) {
    TestServer server(folder_.path());
    TestPlayer ann(server, testIdentity("Ann"));
    ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return ann.isLoaded(); }));
    const auto isLoaded = [&] {
        const world::ChunkPos beside = world::offsetBy(world::chunkOf(ann.pose.position), -1, -1);
        return server.state().session.world().maybeChunkAt(beside) != nullptr;
    };
    for (int tick = 0; tick < 200; ++tick) step(server, {&ann});
    EXPECT_FALSE(isLoaded());
    ASSERT_EQ(ann.put(above(ann), "glass"), game::EditResult::Applied);
    EXPECT_TRUE(stepUntil(server, {&ann}, isLoaded));
    for (int tick = 0; tick < 410; ++tick) step(server, {&ann});  // twenty seconds and a bit
    server.state().clients.all.at(ann.wire->id).role = game::Role::Operator;
    ann.pose.position.x += 16 * 20;
    for (int tick = 0; tick < 100; ++tick) step(server, {&ann});
    EXPECT_FALSE(isLoaded()) << "she only walks now";
}

// A player may still be known from the server that she left a moment ago.
TEST_F(ServerTest, TheListHasPlayersOfOtherServersOnce) {
    TestServer server(folder_.path());
    TestPlayer ann(server, testIdentity("Ann"));
    ServerState& state = server.state();
    const KnownPlayer& bob =
        state.clients.known.add(testIdentity("Bob").key.publicKey, "Bob", game::Role::Guest);
    const game::PlayerId unknown = bob.id + 1;
    for (const game::PlayerId id : {state.clients.known.byName("Ann")->id, bob.id, unknown})
        state.clients.elsewhere[id].at.id = id;
    ann.wire->say(AskPlayers{});
    const auto messages = ann.wire->take();
    const auto* list = findMessage<PlayerList>(messages);
    ASSERT_TRUE(list);
    ASSERT_EQ(list->players.size(), 2u);
    EXPECT_EQ(list->players[0].name, "Ann");
    EXPECT_EQ(list->players[1].name, "Bob");
    EXPECT_EQ(list->players[1].role, game::Role::Guest);
}

TEST_F(ServerTest, AClaimIsForItsOwner) {
    TestServer server(folder_.path());
    TestPlayer ann(server, testIdentity("Ann")), bob(server, testIdentity("Bob"));
    ASSERT_TRUE(stepUntil(server, {&ann, &bob}, [&] { return ann.isLoaded() && bob.isLoaded(); }));
    const world::BlockPos pos = above(ann);
    const std::string area = fmt::format("{} {} {} {}", pos.x - 9, pos.y - 9, pos.x + 9, pos.y + 9);
    EXPECT_EQ(runConsoleLine(server.state(), "claim home " + area + " ann"), "home is claimed for ann");
    ASSERT_EQ(bob.put(pos, "glass"), game::EditResult::Applied) << "its client does not know";
    ASSERT_TRUE(stepUntil(server, {&ann, &bob}, [&] { return bob.world->undecidedCount() == 0; }));
    EXPECT_EQ(bob.block(pos), world::kAir) << "it is taken back";
    const auto decided = bob.world->popDecided();
    ASSERT_EQ(decided.size(), 1u);
    EXPECT_EQ(std::get<game::EditResult>(decided[0]), game::EditResult::Claimed);
    ASSERT_EQ(ann.put(pos, "glass"), game::EditResult::Applied);
    ASSERT_TRUE(stepUntil(server, {&ann, &bob}, [&] { return bob.block(pos) == contentBlock("glass"); }));
}

TEST_F(ServerTest, AGuestWhoIsMadeAPlayerBuildsAtOnce) {
    TestServer server(folder_.path());
    TestPlayer ann(server, testIdentity("Ann"));
    ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return ann.isLoaded(); }));
    const world::BlockPos pos = above(ann);
    (void)runConsoleLine(server.state(), "guest Ann");
    step(server, {&ann});
    EXPECT_EQ(ann.put(pos, "glass"), game::EditResult::NotAllowed);
    (void)runConsoleLine(server.state(), "deop Ann");
    step(server, {&ann});
    EXPECT_EQ(ann.put(pos, "glass"), game::EditResult::Applied);
    ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return ann.world->undecidedCount() == 0; }));
    EXPECT_EQ(ann.block(pos), contentBlock("glass"));
}

TEST_F(ServerTest, TextThatCannotTravelIsSaidAsItCan) {
    TestServer server(folder_.path());
    TestPlayer ann(server, testIdentity("Ann"));
    (void)ann.world->popChat();
    ann.world->say("a\u202eb\n" + std::string(2 * kMaxChatBytes, 'x'));
    step(server, {&ann});
    const auto chat = ann.world->popChat();
    ASSERT_EQ(chat.size(), 1u);
    EXPECT_EQ(chat[0].text.size(), kMaxChatBytes);
    EXPECT_TRUE(chat[0].text.starts_with("a\\xe2\\x80\\xaeb")) << chat[0].text;
}

TEST_F(ServerTest, ARollbackThatHasBegunEndsBeforeTheServerDoes) {
    world::BlockPos pos;
    {
        TestServer server(folder_.path());
        ASSERT_NO_FATAL_FAILURE(annBuilds(server, pos));
        EXPECT_TRUE(runConsoleLine(server.state(), "rollback Ann 60").starts_with("rolling back 1 block;"));
        ASSERT_TRUE(stop(server.state(), "the test ends"));
    }
    TestServer again(folder_.path());
    again.state().session.pipeline().chunkAt(world::chunkOf(pos));
    EXPECT_EQ(again.state().session.world().block(pos), world::kAir);
}

// After a server ran with a date of the future, the last minute is still the last minute.
// Another program's edits would be replaced when the next server brings back the killed one's.
TEST_F(ServerTest, OnlyAServerOpensAWorldWithEditsInTheHistoryAlone) {
    const auto file = folder_ / "w.sqlite", records = folder_ / "w.server.sqlite";
    const auto open = [&](store::WorldSharing sharing) {
        store::WorldRequest request;
        request.versionOf = [](std::string_view name) {
            return gen::versionOf(gen::builtInGenerators(), name);
        };
        request.sharing = sharing;
        const auto opened = store::openWorld(store::worldLocation(file.string()), contentBlocks(), request);
        return opened ? "" : opened.error().message;
    };
    {
        TestServer server(folder_.path());
        ASSERT_TRUE(stop(server.state(), "the test ends"));
    }
    EXPECT_EQ(open(store::WorldSharing::Alone), "");
    {
        const auto history = SqliteRecords::open(records, contentBlocks()).value();
        const std::vector<game::ChangedBlock> changes{{{0, 0, 60}, {}, {contentBlock("glass"), 0, nullptr}}};
        (void)history->append(loggedEdits(1, {1}, nowMs(), changes));
        ASSERT_TRUE(history->flush());
    }
    EXPECT_THAT(open(store::WorldSharing::Alone), testing::HasSubstr("start and stop `terrane serve`"));
    EXPECT_EQ(open(store::WorldSharing::Servers), "");
    {
        TestServer server(folder_.path());
        ASSERT_TRUE(stop(server.state(), "the test ends"));
    }
    EXPECT_EQ(open(store::WorldSharing::Alone), "");
}

TEST_F(ServerTest, TheRecordsOfAnotherWorldAreRefused) {
    {
        TestServer server(folder_.path());
        ASSERT_TRUE(stop(server.state(), "the test ends"));
    }
    const auto file = folder_ / "w.server.sqlite";
    const auto open = [&] {
        return openServerHost(serverParts(folder_ / "w.sqlite"),
                              SqliteRecords::open(file, contentBlocks()).value(), {}, "test");
    };
    EXPECT_TRUE(open());
    {
        const auto records = SqliteRecords::open(file, contentBlocks()).value();
        EXPECT_EQ(records->text(kWorldText).value(), fmt::format("1 {}", kTestGenerator));
        records->setText(kWorldText, "99 hills3d");
        ASSERT_TRUE(records->flush());
    }
    const auto refused = open();
    ASSERT_FALSE(refused);
    EXPECT_THAT(refused.error().message,
                testing::HasSubstr("is of another world (seed and generator 99 hills3d)"));
}

TEST_F(ServerTest, ARollbackOfAMinuteLeavesWhatHasALaterDate) {
    TestServer server(folder_.path());
    TestPlayer ann(server, testIdentity("Ann"));
    ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return ann.isLoaded(); }));
    ServerHistory& history = server.state().history;
    const world::BlockPos early = above(ann), middle = above(ann, 3), late = above(ann, 4);
    const std::int64_t hourMs = 3'600'000, yearMs = 365 * 24 * hourMs;
    const auto log = [&](world::BlockPos pos, std::int64_t timeMs) {
        const world::BlockValue air{}, glass{contentBlock("glass"), 0, nullptr};
        (void)server.state().session.pipeline().chunkAt(world::chunkOf(pos));
        server.state().session.setBlocks(std::vector<world::PlacedBlock>{{pos, glass}});
        const std::vector<game::ChangedBlock> changes{{pos, air, glass}};
        const auto edits = loggedEdits(history.newest + 1, {server.state().clients.known.byName("Ann")->id},
                                       timeMs, changes);
        history.newest = edits.back().number;
        (void)history.records.append(edits);
    };
    log(early, nowMs() + yearMs);   // the date was wrong
    log(middle, nowMs() - hourMs);  // an hour ago it was right
    log(late, nowMs());
    EXPECT_TRUE(runConsoleLine(server.state(), "rollback * 1").starts_with("rolling back 1 block;"));
    ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return history.rollbacks.empty(); }));
    EXPECT_NE(server.state().session.world().block(early), world::kAir);
    EXPECT_NE(server.state().session.world().block(middle), world::kAir);
    EXPECT_EQ(server.state().session.world().block(late), world::kAir);
}

// The clock is set back by an hour while the server runs: the last seconds are still the last seconds.
TEST_F(ServerTest, ARollbackOfSecondsAfterTheClockWasSetBack) {
    std::int64_t systemMs = nowMs();
    TestServer server(folder_.path());
    TestPlayer ann(server, testIdentity("Ann"));
    ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return ann.isLoaded(); }));
    ServerHistory& history = server.state().history;
    history.stamps.systemMs = [&] { return systemMs; };
    const world::BlockPos early = above(ann), late = above(ann, 3);
    const auto log = [&](world::BlockPos pos) {
        const world::BlockValue air{}, glass{contentBlock("glass"), 0, nullptr};
        (void)server.state().session.pipeline().chunkAt(world::chunkOf(pos));
        server.state().session.setBlocks(std::vector<world::PlacedBlock>{{pos, glass}});
        const std::vector<game::ChangedBlock> changes{{pos, air, glass}};
        const auto edits =
            loggedEdits(history.newest + 1, {}, history.stamps.at(server.state().clients.now), changes);
        history.newest = edits.back().number;
        (void)history.records.append(edits);
    };
    log(early);
    for (int k = 0; k < 10; ++k) {
        server.now += std::chrono::seconds(1);
        step(server, {&ann});
    }
    systemMs -= 3'600'000;
    log(late);
    EXPECT_TRUE(runConsoleLine(server.state(), "rollback * 0.1").starts_with("rolling back 1 block;"));
    ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return history.rollbacks.empty(); }));
    EXPECT_NE(server.state().session.world().block(early), world::kAir);
    EXPECT_EQ(server.state().session.world().block(late), world::kAir);
}

constexpr std::int64_t kHourMs = 3'600'000, kYearMs = 365 * 24 * kHourMs;

// A system's clock that is set, and a steady one that goes on.
struct TestClocks {
    std::int64_t systemMs = 1'800'000'000'000;
    Time steady{std::chrono::hours(5)};

    void pass(std::chrono::milliseconds time) {
        systemMs += time.count();
        steady += time;
    }
};

TEST(StampClock, GoesOnWhileTheSystemsClockIsBehind) {
    TestClocks clocks;
    StampClock stamps{.systemMs = [&] { return clocks.systemMs; }};
    stamps.newestMs = clocks.systemMs + kHourMs;
    const std::int64_t first = stamps.at(clocks.steady);
    EXPECT_EQ(first, clocks.systemMs + kHourMs);
    clocks.pass(std::chrono::seconds(90));
    EXPECT_EQ(stamps.at(clocks.steady), first + 90'000);
    StampClock later{.systemMs = [&] { return clocks.systemMs; }};
    later.newestMs = clocks.systemMs - kHourMs;
    EXPECT_EQ(later.at(clocks.steady), clocks.systemMs) << "the system's clock is later";
    StampClock idle{.systemMs = [&] { return clocks.systemMs; }};
    idle.newestMs = clocks.systemMs + kHourMs;
    idle.begin(clocks.steady);
    const std::int64_t before = idle.newestMs;
    clocks.pass(std::chrono::minutes(10));
    EXPECT_EQ(idle.at(clocks.steady), before + 600'000) << "time without edits";
}

// The clock is set while the server runs: an hour back, a year ahead, and right again.
TEST(StampClock, NeverGoesBackWhileItRuns) {
    TestClocks clocks;
    StampClock stamps{.systemMs = [&] { return clocks.systemMs; }};
    testing::internal::CaptureStderr();
    std::int64_t last = stamps.at(clocks.steady);
    const auto passMinutes = [&](int minutes) {
        for (int k = 0; k < minutes; ++k) {
            clocks.pass(std::chrono::minutes(1));
            const std::int64_t stamp = stamps.at(clocks.steady);
            EXPECT_EQ(stamp, last + 60'000) << "a minute is a minute";
            last = stamp;
        }
    };
    passMinutes(30);
    clocks.systemMs -= kHourMs;
    passMinutes(30);
    EXPECT_EQ(
        testing::internal::GetCapturedStderr(),
        "terrane: warning: the newest edit of the history has a date 60 minutes ahead of the clock: the "
        "clock is wrong, or was; new edits are dated after it\n")
        << "warned once";
    clocks.systemMs += kHourMs;
    passMinutes(5);
    clocks.systemMs += kYearMs;
    EXPECT_EQ(last = stamps.at(clocks.steady), clocks.systemMs) << "it may have been wrong before";
    passMinutes(5);
    testing::internal::CaptureStderr();
    clocks.systemMs -= kYearMs;
    passMinutes(60);
    EXPECT_THAT(testing::internal::GetCapturedStderr(), testing::HasSubstr("525600 minutes ahead"));
}

// Two servers of a world, whose clocks differ by an hour: edits in the order of their numbers have stamps in
// that order.
TEST(StampClock, FollowsTheOtherServers) {
    TestClocks clocks;
    StampClock stamps{.systemMs = [&] { return clocks.systemMs; }};
    testing::internal::CaptureStderr();
    const std::int64_t own = stamps.at(clocks.steady);
    clocks.pass(std::chrono::minutes(1));
    stamps.hear(own + kHourMs, clocks.steady);
    clocks.pass(std::chrono::minutes(1));
    EXPECT_EQ(stamps.at(clocks.steady), own + kHourMs + 60'000);
    stamps.hear(own, clocks.steady);
    EXPECT_EQ(stamps.at(clocks.steady), own + kHourMs + 60'000) << "an earlier one changes nothing";
    stamps.hear(std::numeric_limits<std::int64_t>::max(), clocks.steady);
    clocks.pass(std::chrono::minutes(1));
    EXPECT_EQ(stamps.at(clocks.steady), kLastDateMs + 60'000) << "a damaged one";
    (void)testing::internal::GetCapturedStderr();
}

// The flood of a source that is rolled back is gone with it, and what stood on the blocks falls.
TEST_F(ServerTest, ARollbackRunsTheRules) {
    TestServer server(folder_.path());
    TestPlayer ann(server, testIdentity("Ann"));
    ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return ann.isLoaded(); }));
    const world::BlockPos pos = above(ann);
    ASSERT_EQ(ann.put(pos, "water"), game::EditResult::Applied);
    const auto water = [&] {
        int count = 0;
        for (int y = -10; y <= 10; ++y)
            for (int x = -10; x <= 10; ++x)
                for (int z = -8; z <= 0; ++z)
                    count += server.state().session.world().block({pos.x + x, pos.y + y, pos.z + z}) ==
                             contentBlock("water");
        return count;
    };
    ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return water() > 10; }));
    (void)runConsoleLine(server.state(), "rollback Ann 10");
    EXPECT_TRUE(stepUntil(server, {&ann}, [&] { return water() == 0; })) << water();
}

TEST_F(ServerTest, ARollbackLoadsItsChunks) {
    world::BlockPos pos;
    {
        TestServer server(folder_.path());
        ASSERT_NO_FATAL_FAILURE(annBuilds(server, pos));
        ASSERT_TRUE(stop(server.state(), "the test ends"));
    }
    TestServer again(folder_.path());
    ASSERT_FALSE(again.state().session.world().maybeChunkAt(world::chunkOf(pos)));
    EXPECT_TRUE(runConsoleLine(again.state(), "rollback Ann 60").starts_with("rolling back 1 block;"));
    ASSERT_TRUE(stepUntil(again, {}, [&] { return again.state().history.rollbacks.empty(); }));
    again.state().session.pipeline().chunkAt(world::chunkOf(pos));
    EXPECT_EQ(again.state().session.world().block(pos), world::kAir);
}

TEST_F(ServerTest, ARollbackTakesBackWhatAPlayerDid) {
    TestServer server(folder_.path());
    TestPlayer ann(server, testIdentity("Ann")), bob(server, testIdentity("Bob"));
    ASSERT_TRUE(stepUntil(server, {&ann, &bob}, [&] { return ann.isLoaded() && bob.isLoaded(); }));
    const world::BlockPos anns = above(ann), bobs = above(ann, 3);
    ASSERT_EQ(ann.put(anns, "glass"), game::EditResult::Applied);
    ASSERT_EQ(bob.put(bobs, "glass"), game::EditResult::Applied);
    ASSERT_TRUE(stepUntil(server, {&ann, &bob},
                          [&] { return ann.block(bobs) != world::kAir && bob.block(anns) != world::kAir; }));
    EXPECT_TRUE(runConsoleLine(server.state(), "rollback Bob 60").starts_with("rolling back 1 block;"));
    ASSERT_TRUE(stepUntil(server, {&ann, &bob}, [&] { return ann.block(bobs) == world::kAir; }));
    EXPECT_EQ(ann.block(anns), contentBlock("glass"));
}

// A shape on a server: drawn by the server's rules, counted, undone and rolled back like a fill.
TEST_F(ServerTest, ShapesAreFilledUndoneAndRolledBack) {
    TestServer server(folder_.path());
    TestPlayer ann(server, testIdentity("Ann"));
    ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return ann.isLoaded(); }));
    const world::BlockPos low = above(ann);
    const world::BlockBox box{low, {low.x + 4, low.y + 4, low.z + 4}};
    const auto build = [&](game::FillShape shape) {
        (void)ann.session->build(
            {game::kLocalPlayer, game::FillBox{box, contentBlock("glass"), 0, {}, shape}});
        EXPECT_TRUE(stepUntil(server, {&ann}, [&] { return ann.world->undecidedCount() == 0; }));
        const auto decided = ann.world->popDecided();
        return decided.size() == 1 ? std::get<game::BuildOutcome>(decided[0]).changed : 0;
    };
    const auto shown = [&] {
        std::size_t count = 0;
        for (std::int64_t k = 0; k < box.blockCount(); ++k)
            count += ann.block(box.blockAt(k)) == contentBlock("glass") ? 1 : 0;
        return count;
    };
    EXPECT_EQ(build({game::ShapeKind::Line, true, false}), 5u);
    EXPECT_EQ(ann.block({box.high.x, low.y, low.z}), contentBlock("glass"));
    EXPECT_EQ(shown(), 5u);
    (void)ann.session->undoOrRedo(game::kLocalPlayer, game::HistoryWay::Undo);
    ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return ann.world->undecidedCount() == 0; }));
    EXPECT_EQ(shown(), 0u);
    (void)ann.world->popDecided();
    EXPECT_EQ(build({game::ShapeKind::Hollow}), 98u);
    EXPECT_EQ(shown(), 98u);
    EXPECT_EQ(server.state().session.world().block({low.x + 2, low.y + 2, low.z + 2}), world::kAir);
    // With the three blocks of the line that are not in the hollow box: each block once.
    EXPECT_TRUE(runConsoleLine(server.state(), "rollback Ann 60").starts_with("rolling back 101 blocks;"));
    ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return shown() == 0; }));
}

TEST_F(ServerTest, AFarTownIsSeen) {
    TestServer server(folder_.path());
    TestPlayer ann(server, testIdentity("Ann"));
    ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return ann.isLoaded(); }));
    const world::BlockPos low = above(ann);
    EXPECT_EQ(ann.session
                  ->build({game::kLocalPlayer,
                           game::FillBox{
                               {low, {low.x + 15, low.y + 15, low.z + 15}}, contentBlock("glass"), 0, {}}})
                  .result,
              game::BuildOutcome::Result::Sent);
    ASSERT_TRUE(stepUntil(server, {&ann}, [&] { return ann.world->undecidedCount() == 0; }));
    ASSERT_TRUE(server.state().session.save());
    TestPlayer bob(server, testIdentity("Bob"), 2, 128);
    bob.pose.position.x += 16 * 20;  // it walked there
    server.state().clients.all.at(bob.wire->id).role = game::Role::Operator;
    ASSERT_TRUE(stepUntil(server, {&bob}, [&] { return bob.isLoaded(); }));
    const world::ChunkPos tile{world::chunkOf(low).x >> 2, world::chunkOf(low).y >> 2, 2};
    ASSERT_TRUE(stepUntil(server, {&bob}, [&] { return !bob.store->difference(tile).empty(); }));
    EXPECT_EQ(*bob.store->load(tile).chunk, *server.state().session.store().load(tile).chunk);
    // The tile of level 4 is too near to be drawn.
    const world::ChunkPos tooNear{tile.x >> 2, tile.y >> 2, 4};
    EXPECT_EQ(server.state().edits.chunks.within(tooNear, 0), std::vector{tooNear});
    ASSERT_TRUE(stepUntil(server, {&bob}, [&] { return bob.world->isViewComplete(); }));
    EXPECT_TRUE(bob.store->difference(tooNear).empty());
}

TEST_F(ServerTest, AFarTownThatIsBuiltMeanwhileIsSeen) {
    TestServer server(folder_.path());
    TestPlayer ann(server, testIdentity("Ann")), bob(server, testIdentity("Bob"), 2, 128);
    bob.pose.position.x += 16 * 20;  // it walked there
    server.state().clients.all.at(bob.wire->id).role = game::Role::Operator;
    ASSERT_TRUE(stepUntil(server, {&ann, &bob}, [&] { return ann.isLoaded() && bob.isLoaded(); }));
    const world::BlockPos low = above(ann);
    const game::FillBox town{{low, {low.x + 15, low.y + 15, low.z + 15}}, contentBlock("glass"), 0, {}};
    EXPECT_EQ(ann.session->build({game::kLocalPlayer, town}).result, game::BuildOutcome::Result::Sent);
    ASSERT_TRUE(stepUntil(server, {&ann, &bob}, [&] { return ann.world->undecidedCount() == 0; }));
    ASSERT_TRUE(server.state().session.save());
    const world::ChunkPos tile{world::chunkOf(low).x >> 2, world::chunkOf(low).y >> 2, 2};
    ASSERT_TRUE(stepUntil(server, {&ann, &bob}, [&] { return !bob.store->difference(tile).empty(); }));
}

}  // namespace
}  // namespace terrane::net

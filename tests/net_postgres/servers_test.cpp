// Several servers of one world: edits, players, chat, time.
#include <algorithm>
#include <random>

#include "terrane/game/places.h"
#include "terrane/net/server/server_console.h"
#include "terrane/net_postgres/server_rows.h"
#include "tests/net_postgres/shared_server_fixture.h"

namespace terrane::net_postgres {
namespace {

using game::EditResult;
using world::BlockPos;

// No value unless the chunk is loaded on the server.
std::optional<world::BlockId> blockOn(TestServer& server, BlockPos pos) {
    const world::World& world = server.state().session.world();
    if (!world.maybeChunkAt(world::chunkOf(pos))) return std::nullopt;
    return world.block(pos);
}

TEST_F(SharedServersTest, AnEditReachesPlayersOfOtherServers) {
    TestServer &a = servers_.add(), &b = servers_.add();
    Guest anna(a, "Anna"), bert(b, "Bert");
    ASSERT_NE(anna.id, game::kNoPlayer);
    ASSERT_NE(bert.id, anna.id) << "numbers of players are not given twice";
    ASSERT_TRUE(servers_.tickUntil([&] { return bert.find<net::ViewComplete>() != nullptr; }));
    const BlockPos pos = anna.near(1, 0);
    const auto number = anna.set(pos, "stone");
    ASSERT_TRUE(servers_.tickUntil([&] { return anna.resultOf(number).has_value(); }));
    EXPECT_EQ(anna.resultOf(number), EditResult::Applied);
    ASSERT_TRUE(servers_.tickUntil([&] { return bert.find<net::BlocksChanged>() != nullptr; }));
    const auto* changed = bert.find<net::BlocksChanged>();
    EXPECT_EQ(changed->chunk, world::chunkOf(pos));
    EXPECT_EQ(changed->blocks.at(0).value.id, contentBlock("stone"));
    // A later player gets them, too.
    Guest carl(b, "Carl");
    EXPECT_TRUE(servers_.tickUntil([&] { return carl.find<net::ChunkEdits>() != nullptr; }));
    servers_.stopAll();
}

TEST_F(SharedServersTest, OfTwoWhoChangeOneBlockAtATimeOneIsFirst) {
    TestServer &a = servers_.add(), &b = servers_.add();
    Guest anna(a, "Anna"), bert(b, "Bert");
    const BlockPos pos = anna.near(1, 1);
    // Both servers have loaded the chunk.
    const auto warmA = anna.set(anna.near(0, 1), "dirt");
    ASSERT_TRUE(servers_.tickUntil([&] { return anna.resultOf(warmA).has_value(); }));
    const auto warmB = bert.set(bert.near(0, -1), "dirt");
    ASSERT_TRUE(servers_.tickUntil([&] { return bert.resultOf(warmB).has_value(); }));
    const auto ofAnna = anna.set(pos, "stone", world::kAir), ofBert = bert.set(pos, "dirt", world::kAir);
    ASSERT_TRUE(servers_.tickUntil(
        [&] { return anna.resultOf(ofAnna).has_value() && bert.resultOf(ofBert).has_value(); }));
    const bool annaFirst = anna.resultOf(ofAnna) == EditResult::Applied;
    EXPECT_EQ(bert.resultOf(ofBert), annaFirst ? EditResult::Conflict : EditResult::Applied);
    EXPECT_EQ(anna.resultOf(ofAnna), annaFirst ? EditResult::Applied : EditResult::Conflict);
    const world::BlockId expected = contentBlock(annaFirst ? "stone" : "dirt");
    EXPECT_TRUE(
        servers_.tickUntil([&] { return blockOn(a, pos) == expected && blockOn(b, pos) == expected; }));
    servers_.stopAll();
}

// Random concurrent edits of a few blocks by three servers: all servers, the history and the store end up
// equal.
TEST_F(SharedServersTest, RandomEditsConverge) {
    std::mt19937 random(7);
    std::vector<std::unique_ptr<Guest>> guests;
    for (int k = 0; k < 3; ++k) {
        TestServer& server = servers_.add();
        for (int n = 0; n < 2; ++n)
            guests.push_back(std::make_unique<Guest>(server, fmt::format("p{}{}", k, n)));
    }
    const char* blocks[] = {"stone", "dirt", "cyan_glass", "air"};
    const auto randomPlace = [&](const Guest& guest) {
        return guest.near(static_cast<int>(random() % 3) - 1, static_cast<int>(random() % 3) - 1,
                          1 + static_cast<int>(random() % 2));
    };
    std::set<BlockPos> places;
    const auto editAtRandom = [&] {
        for (const auto& guest : guests) {
            if (random() % 3 != 0) continue;
            const BlockPos pos = randomPlace(*guest);
            places.insert(pos);
            guest->set(pos, blocks[random() % std::size(blocks)]);
        }
        // Servers tick at different times, so each hears of the others at its own time.
        servers_.all()[random() % 3]->tick();
        if (random() % 4 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    };
    std::size_t applied = 0, refused = 0;
    const auto count = [&] {
        applied = refused = 0;
        for (const auto& guest : guests)
            for (net::CommandNumber number = 1; number <= guest->last; ++number) {
                const auto result = guest->resultOf(number);
                if (!result) return false;
                (result == EditResult::Conflict ? refused : applied) += 1;
            }
        return true;
    };
    // The faster the database, the rarer is it that two edit the same block at a time.
    for (int part = 0; part < 40 && refused <= 10; ++part) {
        for (int round = 0; round < 250; ++round) editAtRandom();
        ASSERT_TRUE(servers_.tickUntil(count));
    }
    EXPECT_GT(applied, 100u);
    EXPECT_GT(refused, 10u) << "else nothing was tested";
    const auto isSettled = [&] {
        for (const auto& server : servers_.all())
            if (server->state().sharing.newest != servers_.all()[0]->state().sharing.newest ||
                !server->state().sharing.undecided.empty())
                return false;
        return true;
    };
    ASSERT_TRUE(servers_.tickUntil(isSettled));
    for (int k = 0; k < 5; ++k) servers_.tick();
    std::map<BlockPos, world::BlockId> history;
    const auto take = [&](const net::LoggedEdit& edit) -> base::Result<void> {
        for (std::size_t k = 0; k < edit.after.size(); ++k) {
            const BlockPos pos = world::blockPos(edit.chunk, edit.after[k].index);
            if (const auto found = history.find(pos); found != history.end()) {
                EXPECT_EQ(found->second, edit.before[k].value.id)
                    << "each edit is made on top of the one before";
            }
            history[pos] = edit.after[k].value.id;
        }
        return {};
    };
    ASSERT_TRUE(
        servers_.all()[0]->state().history.records.forEachEdit({}, net::EditOrder::OldestFirst, take));
    for (const auto& [pos, block] : history)
        for (const auto& server : servers_.all()) EXPECT_EQ(blockOn(*server, pos), block);
    guests.clear();
    servers_.stopAll();
    const auto registry = net::ownBlocks();
    auto reader = store_postgres::openReader(servers_.address(), *registry).value();
    for (const auto& [pos, block] : history)
        EXPECT_EQ(reader->load(world::chunkOf(pos)).chunk->block(world::blockIndex(pos)), block);
    EXPECT_EQ(postgres_.query("SELECT newest = saved FROM " + schema_ + ".history"), "t");
}

// The other server has not loaded the chunk, its row is not saved, and nobody there has seen it before.
TEST_F(SharedServersTest, WhoComesLaterIsToldWhatIsNotSavedYet) {
    TestServer &a = servers_.add(), &b = servers_.add();
    Guest anna(a, "Anna");
    const auto number = anna.set(anna.near(1, 0), "cyan_glass");
    ASSERT_TRUE(servers_.tickUntil([&] { return anna.resultOf(number) == EditResult::Applied; }));
    ASSERT_TRUE(servers_.tickUntil([&] { return b.state().sharing.newest == 1; }));
    ASSERT_EQ(postgres_.query("SELECT count(*) FROM " + schema_ + ".chunks"), "0")
        << "else nothing is tested";
    Guest bert(b, "Bert");
    ASSERT_TRUE(servers_.tickUntil([&] { return bert.find<net::ChunkEdits>() != nullptr; }));
    const auto* edits = bert.find<net::ChunkEdits>();
    EXPECT_EQ(edits->chunk, world::chunkOf(anna.near(1, 0)));
    ASSERT_EQ(edits->blocks.size(), 1u);
    EXPECT_EQ(edits->blocks[0].value.id, contentBlock("cyan_glass"));
    servers_.stopAll();
}

TEST_F(SharedServersTest, AServerThatComesLaterHasWhatIsNotSavedYet) {
    TestServer& a = servers_.add();
    Guest anna(a, "Anna");
    const BlockPos pos = anna.near(1, 0);
    const auto number = anna.set(pos, "cyan_glass");
    ASSERT_TRUE(servers_.tickUntil([&] { return anna.resultOf(number) == EditResult::Applied; }));
    TestServer& b = servers_.add();
    EXPECT_TRUE(servers_.tickUntil([&] {
        (void)b.state().session.pipeline().maybeLoadChunkAt(world::chunkOf(pos));
        return blockOn(b, pos) == contentBlock("cyan_glass");
    }));
    servers_.stopAll();
}

TEST_F(SharedServersTest, OthersSaveWhatAKilledServerChanged) {
    TestServer& a = servers_.add();
    BlockPos pos{};
    {
        Guest anna(a, "Anna");
        pos = anna.near(1, 0);
        const auto number = anna.set(pos, "cyan_glass");
        ASSERT_TRUE(servers_.tickUntil([&] { return anna.resultOf(number) == EditResult::Applied; }));
    }
    servers_.kill(a);
    ASSERT_EQ(postgres_.query("SELECT count(*) FROM " + schema_ + ".servers"), "1");
    EXPECT_EQ(postgres_.query("SELECT saved FROM " + schema_ + ".history"), "0");
    const auto alone = store_postgres::PostgresStore::open(servers_.address(), contentBlocks(), {});
    ASSERT_FALSE(alone) << "who plays alone would lose the edit";
    EXPECT_EQ(alone.error().code, base::ErrorCode::Incompatible);
    servers_.add();
    postgres_.sql("UPDATE " + schema_ + ".servers SET seen = now() - interval '1 minute' WHERE number = 1");
    EXPECT_TRUE(servers_.tickUntil(
        [&] { return postgres_.query("SELECT count(*) FROM " + schema_ + ".servers") == "1"; }));
    servers_.stopAll();
    EXPECT_EQ(postgres_.query("SELECT saved FROM " + schema_ + ".history"), "1");
    const auto registry = net::ownBlocks();
    auto reader = store_postgres::openReader(servers_.address(), *registry).value();
    EXPECT_EQ(reader->load(world::chunkOf(pos)).chunk->block(world::blockIndex(pos)),
              contentBlock("cyan_glass"));
}

// The database's clock is set back by an hour: times of before lie in the future. A killed server is gone
// nevertheless, and its leases end; a running one renews its own.
TEST_F(SharedServersTest, AKilledServerIsGoneAlsoIfTheClockIsSetBack) {
    servers_.add();  // makes the world
    auto connection = store_postgres::Connection::open(servers_.address()).value();
    const ServerName killedName{"killed", "", ""}, ownName{"own", "", ""};
    const auto killed = addServer(connection, killedName).value(),
               own = addServer(connection, ownName).value();
    const std::vector<net::Region> regions{7};
    const auto beatOf = [&](const ServerName& name, std::int64_t server) {
        return beat(connection, name, {.server = server, .saved = 0, .players = 0, .regions = regions})
            .value();
    };
    const auto isAlive = [&](const BeatAnswer& answer, std::int64_t server) {
        return std::ranges::any_of(
            answer.others, [&](const auto& other) { return other.number == server && other.isAlive; });
    };
    EXPECT_EQ(beatOf(killedName, killed).regions, regions);
    BeatAnswer answer = beatOf(ownName, own);
    EXPECT_TRUE(answer.regions.empty());
    EXPECT_TRUE(isAlive(answer, killed));
    const auto setBack = [&](const std::string& interval) {
        postgres_.sql("UPDATE " + schema_ + ".servers SET seen = seen + interval '" + interval + "'");
        postgres_.sql("UPDATE " + schema_ + ".growth_leases SET until = until + interval '" + interval + "'");
    };
    setBack("3 seconds");  // a small correction
    answer = beatOf(ownName, own);
    EXPECT_TRUE(answer.regions.empty());
    EXPECT_TRUE(isAlive(answer, killed));
    setBack("1 hour");
    answer = beatOf(ownName, own);
    EXPECT_EQ(answer.regions, regions) << "a lease does not last an hour";
    EXPECT_FALSE(isAlive(answer, killed));
    EXPECT_TRUE(isAlive(beatOf(killedName, killed), own));
    answer = beatOf(ownName, own);
    EXPECT_TRUE(isAlive(answer, killed)) << "it had only stalled";
    setBack("1 hour");
    ASSERT_TRUE(connection.changeAll(std::vector{removeServerCommand(killed)}));
    EXPECT_EQ(postgres_.query("SELECT count(*) FROM " + schema_ +
                              ".servers WHERE number = " + std::to_string(killed)),
              "0");
    servers_.stopAll();
}

TEST_F(SharedServersTest, APlayerIsOnOneServerAtATime) {
    TestServer &a = servers_.add(), &b = servers_.add();
    Guest anna(a, "Anna");
    ASSERT_TRUE(servers_.tickUntil([&] { return b.state().clients.known.byName("Anna") != nullptr; }));
    Guest again(b, "Anna", anna.identity);
    ASSERT_EQ(again.id, anna.id) << "the other server knows her";
    ASSERT_TRUE(servers_.tickUntil([&] { return anna.find<net::Refused>() != nullptr; }));
    EXPECT_EQ(anna.find<net::Refused>()->why, net::Refusal::Replaced);
    EXPECT_EQ(again.find<net::Refused>(), nullptr);
    servers_.stopAll();
}

// The first server's note arrives while the second one has not taken its news for a while.
TEST_F(SharedServersTest, OfTwoServersTheOneJoinedLastKeepsThePlayer) {
    const auto blocks = net::ownBlocks();
    servers_.add();  // makes the world
    const auto a = PostgresRecords::open(servers_.address(), *blocks, {"a", "", ""}).value();
    const auto b = PostgresRecords::open(servers_.address(), *blocks, {"b", "", ""}).value();
    const game::PlayerId player = 7;
    const auto hearsLine = [](PostgresRecords& records, net::SharedChanges& news) {
        const auto end = std::chrono::steady_clock::now() + base::kHangs;
        while (news.lines.empty() && std::chrono::steady_clock::now() < end) {
            std::this_thread::sleep_for(std::chrono::milliseconds(2));
            net::SharedChanges next = records.popChanges();
            news.joined.insert(news.joined.end(), next.joined.begin(), next.joined.end());
            news.lines = std::move(next.lines);
        }
        return !news.lines.empty();
    };
    for (int round = 0; round < 20; ++round) {
        a->publishJoined(player);
        ASSERT_TRUE(a->flush());
        if (round % 2 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
        b->publishJoined(player);
        ASSERT_TRUE(b->flush());
        a->say({"", "after a"});
        b->say({"", "after b"});
        net::SharedChanges newsOfA, newsOfB;
        ASSERT_TRUE(hearsLine(*a, newsOfA) && hearsLine(*b, newsOfB));
        EXPECT_FALSE(newsOfA.joined.empty());
        EXPECT_TRUE(newsOfB.joined.empty());
    }
    servers_.stopAll();
}

TEST_F(SharedServersTest, ANameIsGivenOnce) {
    TestServer &a = servers_.add(), &b = servers_.add();
    Guest first(a, "Anna"), second(b, "ANNA");  // simultaneous: neither server knows of the other
    ASSERT_TRUE(servers_.tickUntil(
        [&] { return (first.find<net::Refused>() != nullptr) != (second.find<net::Refused>() != nullptr); }));
    Guest& loser = first.find<net::Refused>() ? first : second;
    EXPECT_EQ(loser.find<net::Refused>()->why, net::Refusal::Name);
    // Later logins with the name are refused at once.
    for (int k = 0; k < 50; ++k) servers_.tick();
    for (const auto& server : servers_.all()) {
        Guest third(*server, "anna");
        EXPECT_EQ(third.id, game::kNoPlayer);
    }
    servers_.stopAll();
}

TEST_F(SharedServersTest, PlayersSeeAndHearEachOtherAcrossServers) {
    TestServer &a = servers_.add(), &b = servers_.add();
    Guest anna(a, "Anna"), bert(b, "Bert");
    ASSERT_TRUE(servers_.tickUntil([&] { return bert.find<net::Appears>() != nullptr; }));
    EXPECT_EQ(bert.find<net::Appears>()->name, "Anna");
    EXPECT_EQ(bert.find<net::Appears>()->player, anna.id);
    anna.wire.say(net::Say{"hello; '\"\\ there"});
    ASSERT_TRUE(servers_.tickUntil([&] {
        bert.hear();
        return std::ranges::any_of(bert.heard, [](const net::ServerMessage& message) {
            const auto* said = std::get_if<net::Said>(&message);
            return said && said->name == "Anna" && said->text == "hello; '\"\\ there";
        });
    }));
    anna.wire.say(net::Leave{});
    EXPECT_TRUE(servers_.tickUntil([&] { return bert.find<net::Disappears>() != nullptr; }));
    servers_.stopAll();
}

TEST_F(SharedServersTest, RolesBansAndClaimsHoldEverywhere) {
    TestServer &a = servers_.add(), &b = servers_.add();
    Guest anna(a, "Anna"), bert(b, "Bert");
    ASSERT_TRUE(servers_.tickUntil([&] { return a.state().clients.known.byName("Bert") != nullptr; }));
    EXPECT_EQ(net::runConsoleLine(a.state(), "guest Bert"), "Bert is a guest, who changes no blocks, now");
    ASSERT_TRUE(servers_.tickUntil([&] { return bert.find<net::RoleChanged>() != nullptr; }));
    EXPECT_EQ(bert.find<net::RoleChanged>()->role, game::Role::Guest);
    (void)net::runConsoleLine(a.state(), "claim farm -100 -100 100 100 Anna");
    ASSERT_TRUE(servers_.tickUntil([&] { return b.state().clients.known.claims().find("farm") != nullptr; }));
    EXPECT_NE(b.state().session.permissions.claims.find("farm"), nullptr);
    (void)net::runConsoleLine(a.state(), "password sesame");
    ASSERT_TRUE(servers_.tickUntil([&] { return !b.state().password.hash.empty(); }));
    (void)net::runConsoleLine(a.state(), "time 0.75");
    EXPECT_TRUE(servers_.tickUntil([&] { return std::abs(b.state().session.clock.timeDay - 0.75) < 0.01; }));
    (void)net::runConsoleLine(a.state(), "mark 5 -6 70 The mill");
    const auto places = [&] { return game::savedPlaces(b.state().session.store()); };
    // Other servers are told once they are saved.
    ASSERT_TRUE(servers_.tickUntil([&] { return places().size() == 1; }));
    EXPECT_EQ(places().at(0).name, "The mill");
    (void)net::runConsoleLine(b.state(), "unmark The mill");
    EXPECT_TRUE(servers_.tickUntil([&] { return game::savedPlaces(a.state().session.store()).empty(); }));
    (void)net::runConsoleLine(a.state(), "ban Bert noise");
    ASSERT_TRUE(servers_.tickUntil([&] { return bert.find<net::Refused>() != nullptr; }));
    EXPECT_EQ(bert.find<net::Refused>()->why, net::Refusal::Banned);
    servers_.stopAll();
}

// Only one server lets time pass in a region, and the others get its changes.
TEST_F(SharedServersTest, WaterFlowsOnOneServerAndIsOnAll) {
    TestServer &a = servers_.add(), &b = servers_.add();
    Guest anna(a, "Anna"), bert(b, "Bert");
    const BlockPos source = anna.near(1, 0, 1);
    const auto number = anna.set(source, "water");
    ASSERT_TRUE(servers_.tickUntil([&] { return anna.resultOf(number) == EditResult::Applied; }));
    const auto one = bert.set(bert.near(0, 1), "stone");  // loads the chunk there, too
    ASSERT_TRUE(servers_.tickUntil([&] { return bert.resultOf(one) == EditResult::Applied; }));
    // Without the first edit of each player: flow is a change by who caused it, or by nobody where another
    // server lets time pass.
    const std::string flow = " FROM " + schema_ + ".edits WHERE number NOT IN (SELECT min(number) FROM " +
                             schema_ + ".edits WHERE player <> 0 GROUP BY player)";
    const std::string flown = "SELECT count(*)" + flow;
    std::string before;
    ASSERT_TRUE(servers_.tickUntil([&] {
        const net::Region region = net::regionOf(world::chunkOf(source));
        EXPECT_FALSE(a.state().sharing.shared->mayGrow(region) && b.state().sharing.shared->mayGrow(region));
        for (int k = 0; k < 60; ++k) {
            servers_.tick();
            (void)b.state().session.pipeline().maybeLoadChunkAt(world::chunkOf(source));
        }
        return std::exchange(before, postgres_.query(flown)) == postgres_.query(flown) && before > "1";
    })) << "it comes to rest";
    EXPECT_EQ(postgres_.query("SELECT count(DISTINCT server)" + flow), "1");
    for (int dx = -8; dx <= 8; ++dx)
        for (int dy = -8; dy <= 8; ++dy)
            for (int dz = -6; dz <= 2; ++dz) {
                const BlockPos pos{source.x + dx, source.y + dy, source.z + dz};
                const auto onA = blockOn(a, pos), onB = blockOn(b, pos);
                if (!onA || !onB) continue;
                ASSERT_EQ(*onA, *onB) << pos.x << "," << pos.y << "," << pos.z;
                ASSERT_EQ(a.state().session.world().blockState(pos),
                          b.state().session.world().blockState(pos));
            }
    EXPECT_EQ(blockOn(b, source), contentBlock("water"));
    servers_.stopAll();
}

// A change with invalid UTF-8 does not block the changes around it.
TEST_F(SharedServersTest, WhatTheDatabaseRefusesIsGivenUp) {
    TestServer& a = servers_.add();
    Guest anna(a, "Anna");
    net::ServerRecords& records = a.state().history.records;
    records.setText("before", "1");
    records.setText("wrong", "L\xE4rm");
    records.setText("after", "2");
    const auto number = anna.set(anna.near(1, 0), "cyan_glass");
    ASSERT_TRUE(servers_.tickUntil([&] { return anna.resultOf(number) == EditResult::Applied; }));
    EXPECT_EQ(postgres_.query("SELECT count(*) FROM " + schema_ + ".texts WHERE name IN ('before', 'after')"),
              "2");
    EXPECT_EQ(postgres_.query("SELECT count(*) FROM " + schema_ + ".texts WHERE name = 'wrong'"), "0");
    servers_.stopAll();
}

// Without a notification, as when it was sent while the connection was broken.
TEST_F(SharedServersTest, WhatWasMissedIsLookedUp) {
    TestServer& a = servers_.add();
    Guest anna(a, "Anna"), bert(a, "Bert");
    for (int k = 0; k < 50; ++k) servers_.tick();
    postgres_.sql("UPDATE " + schema_ + ".players SET ban = 'noise' WHERE name = 'Bert'");
    postgres_.sql("INSERT INTO " + schema_ + ".texts VALUES ('password', 'a hash')");
    postgres_.sql("INSERT INTO " + schema_ + ".claims VALUES ('farm', 0, 0, 9, 9, 5, '')");
    postgres_.sql("INSERT INTO " + schema_ + ".settings VALUES ('places', '1 2 70 0 0 The mill')");
    for (int k = 0; k < 50; ++k) servers_.tick();
    EXPECT_EQ(bert.find<net::Refused>(), nullptr);
    postgres_.query(
        "SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE pid <> pg_backend_pid() AND "
        "application_name = 'terrane'");
    ASSERT_TRUE(servers_.tickUntil([&] { return bert.find<net::Refused>() != nullptr; }));
    EXPECT_EQ(bert.find<net::Refused>()->why, net::Refusal::Banned);
    EXPECT_EQ(a.state().password.hash, "a hash");
    EXPECT_EQ(a.state().clients.known.claims().all().size(), 1u);
    const auto places = game::savedPlaces(a.state().session.store());
    ASSERT_EQ(places.size(), 1u);
    EXPECT_EQ(places[0].name, "The mill");
    EXPECT_EQ(anna.find<net::Refused>(), nullptr) << "she plays here, and nowhere else";
    servers_.stopAll();
}

// A stalled server continues: it saves its own edits.
TEST_F(SharedServersTest, AServerThatHadOnlyStalledIsNotForgotten) {
    TestServer &a = servers_.add(), &b = servers_.add();
    Guest anna(a, "Anna");
    const auto number = anna.set(anna.near(1, 0), "cyan_glass");
    ASSERT_TRUE(servers_.tickUntil([&] { return anna.resultOf(number) == EditResult::Applied; }));
    // The state of b before a reports again.
    b.state().sharing.orphans.push_back({1, 1, {world::chunkOf(anna.near(1, 0))}});
    net::SharedWorld& shared = *b.state().history.records.shared();
    shared.removeStoppedServer(1);
    ASSERT_TRUE(servers_.tickUntil([&] { return b.state().sharing.orphans.empty(); }));
    EXPECT_EQ(postgres_.query("SELECT count(*) FROM " + schema_ + ".servers"), "2");
    servers_.stopAll();
}

}  // namespace
}  // namespace terrane::net_postgres

// Copies records of servers from a file into a database and back.
#include "terrane/net/server/server_records.h"

#include "terrane/net/server/server_console.h"
#include "terrane/net/server/sqlite_records.h"
#include "tests/net_postgres/shared_server_fixture.h"

namespace terrane::net_postgres {
namespace {

net::LoggedEdit editOf(std::int64_t number) {
    const auto chunk = world::ChunkPos{static_cast<std::int32_t>(number % 7) - 3, -2};
    const world::BlockValue air{}, stone{contentBlock("stone"), static_cast<std::uint16_t>(number), {}};
    return {number, 1000 * number, 5, chunk, {{7, air}}, {{7, stone}}};
}

std::vector<net::LoggedEdit> editsOf(net::ServerRecords& records) {
    std::vector<net::LoggedEdit> edits;
    const auto take = [&](const net::LoggedEdit& edit) -> base::Result<void> {
        edits.push_back(edit);
        return {};
    };
    EXPECT_TRUE(records.forEachEdit({}, net::EditOrder::OldestFirst, take));
    return edits;
}

void expectSame(net::ServerRecords& a, net::ServerRecords& b) {
    const auto playersA = *a.players(), playersB = *b.players();
    ASSERT_EQ(playersA.size(), playersB.size());
    for (const net::KnownPlayer& player : playersA) {
        const auto same = std::ranges::find(playersB, player.id, &net::KnownPlayer::id);
        ASSERT_NE(same, playersB.end());
        EXPECT_EQ(same->key, player.key);
        EXPECT_EQ(same->name, player.name);
        EXPECT_EQ(same->role, player.role);
        EXPECT_EQ(same->pose, player.pose);
        EXPECT_EQ(same->ban, player.ban);
    }
    ASSERT_EQ(a.claims()->size(), b.claims()->size());
    EXPECT_EQ(a.claims()->at(0).members, b.claims()->at(0).members);
    EXPECT_EQ(*a.text(net::kPasswordText), *b.text(net::kPasswordText));
    const auto editsA = editsOf(a), editsB = editsOf(b);
    ASSERT_EQ(editsA.size(), editsB.size());
    for (std::size_t k = 0; k < editsA.size(); ++k) {
        EXPECT_EQ(editsA[k].number, editsB[k].number);
        EXPECT_EQ(editsA[k].timeMs, editsB[k].timeMs);
        EXPECT_EQ(editsA[k].player, editsB[k].player);
        EXPECT_EQ(editsA[k].chunk, editsB[k].chunk);
        EXPECT_EQ(editsA[k].after, editsB[k].after);
    }
    EXPECT_EQ(a.historyEnds()->saved, b.historyEnds()->saved);
}

TEST_F(SharedServersTest, RecordsGoThereAndBack) {
    const base::TempFolder folder;
    auto file = net::SqliteRecords::open(folder / "a.server.sqlite", contentBlocks()).value();
    file->addPlayer(
        {5, net::newPlayerKey().publicKey, "Anna", game::Role::Operator, world::Pose{{1, 2, 3}, 4, 5}, ""});
    file->addPlayer({9, net::newPlayerKey().publicKey, "D'Artagnan; --", game::Role::Guest, {}, "noise \\"});
    file->addClaim({"farm", {-5, -6, 7, 8}, 5, {9}});
    file->setText(net::kPasswordText, "a hash");
    for (std::int64_t number = 1; number <= 4321; ++number) file->append({editOf(number)});
    ASSERT_TRUE(file->flush());

    sharedParts(servers_.address());  // makes the world
    auto shared = PostgresRecords::open(servers_.address(), contentBlocks(), {"copy", "", ""}).value();
    EXPECT_FALSE(net::copyRecords(*file, *shared)) << "the world lacks edits of the history";
    file->setSavedEdit(4321);
    ASSERT_TRUE(file->flush());
    const auto copied = net::copyRecords(*file, *shared);
    ASSERT_TRUE(copied) << copied.error().message;
    EXPECT_EQ(copied->players, 2u);
    EXPECT_EQ(copied->edits, 4321);
    expectSame(*file, *shared);
    EXPECT_TRUE(net::copyRecords(*file, *shared)) << "again: nothing is there twice";
    expectSame(*file, *shared);

    auto back = net::SqliteRecords::open(folder / "b.server.sqlite", contentBlocks()).value();
    ASSERT_TRUE(net::copyRecords(*shared, *back));
    expectSame(*file, *back);
    shared.reset();
    EXPECT_EQ(postgres_.query("SELECT count(*) FROM " + schema_ + ".servers"), "0") << "it is no server";

    // New players get higher numbers.
    TestServer& server = servers_.add();
    net::runConsoleLine(server.state(), "password off");
    Guest carl(server, "Carl");
    EXPECT_GT(carl.id, 9u);
    servers_.stopAll();
}

// Pages that are read again are used once. An error of `use` is not taken for one of the database.
TEST_F(SharedServersTest, EditsComeOnceThoughTheConnectionIsCut) {
    sharedParts(servers_.address());  // makes the world
    auto records = PostgresRecords::open(servers_.address(), contentBlocks(), {"test", "", ""}).value();
    std::vector<net::LoggedEdit> edits;
    for (std::int64_t number = 1; number <= 2500; ++number) edits.push_back(editOf(number));
    records->append(edits);
    ASSERT_TRUE(records->flush());
    for (const auto order : {net::EditOrder::OldestFirst, net::EditOrder::NewestFirst}) {
        std::vector<std::int64_t> numbers;
        const auto take = [&](const net::LoggedEdit& edit) -> base::Result<void> {
            numbers.push_back(edit.number);
            if (numbers.size() == 500)
                postgres_.query(
                    "SELECT pg_terminate_backend(pid) FROM pg_stat_activity WHERE pid <> "
                    "pg_backend_pid() AND application_name = 'terrane'");
            return {};
        };
        const auto read = records->forEachEdit({}, order, take);
        ASSERT_TRUE(read) << read.error().message;
        if (order == net::EditOrder::NewestFirst) std::ranges::reverse(numbers);
        ASSERT_EQ(numbers.size(), 2500u);
        for (std::size_t k = 0; k < numbers.size(); ++k)
            EXPECT_EQ(numbers[k], static_cast<std::int64_t>(k) + 1);
    }
    int used = 0;
    const auto fail = [&](const net::LoggedEdit&) -> base::Result<void> {
        ++used;
        return base::fail(base::ErrorCode::Io, "no more");
    };
    EXPECT_EQ(records->forEachEdit({}, net::EditOrder::OldestFirst, fail).error().message, "no more");
    EXPECT_EQ(used, 1);
}

}  // namespace
}  // namespace terrane::net_postgres

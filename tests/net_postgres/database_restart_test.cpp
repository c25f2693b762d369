// The servers' database stops, is killed and comes back: edits wait, and none is lost or applied twice.
#include "tests/base/temp_folder.h"
#include "tests/net_postgres/shared_server_fixture.h"

namespace terrane::net_postgres {
namespace {

using game::EditResult;

TEST(DatabaseRestart, EditsWaitAndAreKeptOnce) {
    const base::TempFolder folder;
    store_postgres::PostgresServer postgres(folder / "postgres");
    SharedServers servers(postgres.url());
    TestServer &a = servers.add(), &b = servers.add();
    Guest anna(a, "Anna"), bert(b, "Bert");
    std::vector<net::CommandNumber> numbers;
    const auto build = [&] {
        const int k = static_cast<int>(numbers.size());
        numbers.push_back(anna.set(anna.near(k % 3 - 1, k / 3 % 3 - 1, 1 + k / 9), k % 2 ? "stone" : "dirt"));
        for (int n = 0; n < 3; ++n) servers.tick();
    };
    const auto isDecided = [&] {
        return std::ranges::all_of(numbers, [&](auto number) { return anna.resultOf(number).has_value(); });
    };
    for (int k = 0; k < 5; ++k) build();
    ASSERT_TRUE(servers.tickUntil(isDecided));
    postgres.stop();
    for (int k = 0; k < 5; ++k) build();
    EXPECT_FALSE(anna.resultOf(numbers.back()).has_value()) << "what is not durable is not acknowledged";
    postgres.start();
    ASSERT_TRUE(servers.tickUntil(isDecided));
    for (int k = 0; k < 3; ++k) build();
    postgres.kill();  // perhaps in the middle of a transaction
    for (int k = 0; k < 3; ++k) build();
    postgres.start();
    ASSERT_TRUE(servers.tickUntil(isDecided));
    for (const net::CommandNumber number : numbers) EXPECT_EQ(anna.resultOf(number), EditResult::Applied);
    ASSERT_TRUE(servers.tickUntil([&] {
        return a.state().sharing.newest == b.state().sharing.newest && a.state().sharing.undecided.empty();
    }));
    EXPECT_EQ(postgres.query("SELECT count(*) FROM terrane.edits"), std::to_string(numbers.size()));
    EXPECT_EQ(
        postgres.query("SELECT max(number) = newest FROM terrane.edits, terrane.history GROUP BY newest"),
        "t");
    servers.stopAll();
    EXPECT_EQ(postgres.query("SELECT newest = saved FROM terrane.history"), "t");
}

}  // namespace
}  // namespace terrane::net_postgres

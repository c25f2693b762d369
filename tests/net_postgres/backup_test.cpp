// Copies of a shared world into files while its servers run.
#include "terrane/net_postgres/world_records.h"
#include "tests/net/backup_checks.h"
#include "tests/net_postgres/shared_server_fixture.h"
#include "tests/support/depth.h"

namespace terrane::net_postgres {
namespace {

// Guests build on two servers. A copy has one moment of both, with all that was acknowledged before.
TEST_F(SharedServersTest, ACopyIsOneMomentOfAllServers) {
    const base::TempFolder folder;
    std::vector<std::unique_ptr<Guest>> guests;
    for (TestServer* server : {&servers_.add(), &servers_.add()})
        for (int k = 0; k < 4; ++k)
            guests.push_back(std::make_unique<Guest>(*server, fmt::format("Guest {}", guests.size())));
    int written = 0;
    const auto build = [&] {
        constexpr const char* kTypes[] = {"stone", "glass", "dirt"};
        for (const auto& guest : guests) (void)guest->wire.take();
        for (std::size_t k = 0; k < guests.size(); ++k)
            guests[k]->set(
                guests[k]->near(static_cast<int>(k % 4) - 2, static_cast<int>(k / 4), 2 + written % 3),
                kTypes[written / 3 % 3]);
        ++written;
        servers_.tick();
    };
    const auto newest = [&] {
        return std::stoll(postgres_.query("SELECT newest FROM " + schema_ + ".history"));
    };
    for (int k = 0; k < atDepth(4, 30); ++k) {
        for (int ticks = 0; ticks <= k * 5 % 17; ++ticks) build();
        const std::int64_t before = newest();
        for (int ticks = 0; ticks <= k % 3; ++ticks) build();
        const auto save = folder.path() / fmt::format("{}.sqlite", k);
        const store::WorldLocation world{store::WorldLocation::Kind::Url, postgres_.url("schema=" + schema_)};
        // The servers go on, on another thread, while the copy is written.
        std::atomic<bool> isCopied = false;
        std::thread copying([&] {
            const auto copied = copyDatabase(world, contentBlocks(), save, {});
            EXPECT_TRUE(copied) << copied.error().message;
            isCopied = true;
        });
        while (!isCopied) build();
        copying.join();
        const std::int64_t after = newest();
        const std::int64_t end = store::readHistoryEnds(store::serverFilePath(save))->newest;
        EXPECT_GE(end, before);
        EXPECT_LE(end, after);
        // A server adds the end of the history to the chunks.
        TestServer(net::serverParts(save),
                   net::SqliteRecords::open(store::serverFilePath(save), contentBlocks()).value());
        net::expectChunksAreHistory(save, end);
        const auto records = net::SqliteRecords::open(store::serverFilePath(save), contentBlocks()).value();
        EXPECT_EQ(records->players()->size(), guests.size());
    }
    EXPECT_GT(newest(), 50);
    servers_.stopAll();
}

}  // namespace
}  // namespace terrane::net_postgres

// Several programs with one world: which may open it together, and what requires exclusive access.
#include <thread>

#include "terrane/store_postgres/world_database.h"
#include "tests/store_postgres/world_fixture.h"

namespace terrane::store_postgres {
namespace {

using base::ErrorCode;
using store::Provenance;
using store::Regenerate;
using store::WorldSharing;
using State = store::LoadedChunk::State;

class SharingTest : public PostgresWorldTest {
  protected:
    void expectBusy(const store::SaveAccess& access, WorldSharing sharing) {
        expectError(errorOf(tryOpen(access, sharing)), ErrorCode::Busy, address_.shown,
                    "open in another program (process ");
    }
    // Opens another world in the same database.
    std::unique_ptr<store::ReadableStore> openBackup(const std::string& schema) {
        auto store = openReader(addressIn(sharedServer(), schema), registry_);
        if (!store) throw std::runtime_error(store.error().message);
        return std::move(*store);
    }
    std::string backups() {
        return query("SELECT count(*) FROM pg_namespace WHERE nspname LIKE '" + schema_ + "_backup_%'");
    }
};

TEST_F(SharingTest, WhoMayOpenItBesideWhom) {
    using enum WorldSharing;
    const struct {
        WorldSharing first, second;
        bool isFine;
    } cases[] = {{Alone, Alone, false},     {Alone, Servers, false},     {Alone, Generating, true},
                 {Servers, Alone, false},   {Servers, Servers, true},    {Servers, Generating, true},
                 {Generating, Alone, true}, {Generating, Servers, true}, {Generating, Generating, true}};
    for (const auto& [first, second, isFine] : cases) {
        SCOPED_TRACE(fmt::format("{} {}", static_cast<int>(first), static_cast<int>(second)));
        const auto store = open(first);
        if (isFine) {
            EXPECT_TRUE(tryOpen(kWorldMustBeThere, second));
        } else {
            expectBusy(kWorldMustBeThere, second);
        }
        EXPECT_TRUE(openReader(address_, registry_)) << "readers take no lock";
    }
    EXPECT_TRUE(tryOpen(kWorldMustBeThere, Alone)) << "all have left";
}

TEST_F(SharingTest, ASnapshotKnowsTheBlocksOfItsChunks) {
    const auto store = open();
    const auto chunksIn = [](WorldConnection& world) {
        static constexpr Statement kCount = {"SELECT count(*) FROM chunks"};
        return world.connection.run(kCount)->number(0, 0);
    };
    auto snapshot = openToRead(address_, registry_, ReadAs::Snapshot);
    auto statements = openToRead(address_, registry_, ReadAs::Statements);
    ASSERT_TRUE(snapshot && statements);
    store->save({0, 0}, store::numberedChunk(1), Provenance::Edited);
    ASSERT_TRUE(store->flush());
    EXPECT_EQ(chunksIn(*snapshot), 0);
    EXPECT_EQ(chunksIn(*statements), 1);
}

// A schema with the same name in another database, or another schema, is a different world.
TEST_F(SharingTest, OtherWorldsAreNoMatter) {
    const auto store = open();
    EXPECT_TRUE(PostgresStore::open(addressIn(sharedServer(), freshSchema()), registry_, kCreateWorld));
    const std::string database = freshDatabase();
    address_ = addressOf(urlWith(database) + "&schema=" + schema_).value();
    EXPECT_TRUE(tryOpen());
}

// A server notices the end of a connection late: the locks are released before.
TEST_F(SharingTest, ItIsFreeAtOnceWhenItIsClosed) {
    constexpr Statement kLocks = {
        "SELECT count(*) FROM pg_locks JOIN pg_stat_activity USING (pid) "
        "WHERE locktype = 'advisory' AND application_name = $1"};
    Connection watching = Connection::open(address_).value();
    const auto locks = [&] { return watching.run(kLocks, Parameters().text(schema_)).value().number(0, 0); };
    address_ = addressIn(sharedServer(), schema_, "application_name=" + schema_);
    for (int round = 0; round < 10; ++round) {
        {
            const auto store = open();
            EXPECT_EQ(locks(), 2);
        }
        EXPECT_EQ(locks(), 0);
        store::SaveAccess access = kCreateWorld;
        access.decide = [](const store::WorldIdentity&) { return base::fail("not this one"); };
        EXPECT_FALSE(tryOpen(access));
        EXPECT_EQ(locks(), 0);
    }
}

TEST_F(SharingTest, ServersSeeWhatOthersSave) {
    const auto first = open(WorldSharing::Servers), second = open(WorldSharing::Servers);
    const auto worker = open(WorldSharing::Generating);
    EXPECT_EQ(second->load({0, 0}).state, State::Absent);
    first->save({0, 0}, store::numberedChunk(1), Provenance::Edited);
    ASSERT_TRUE(first->flush());
    EXPECT_EQ(*second->load({0, 0}).chunk, *store::numberedChunk(1));
    worker->save({0, 0}, store::numberedChunk(2), Provenance::Generated);
    worker->save({1, 0}, store::numberedChunk(2), Provenance::Generated);
    ASSERT_TRUE(worker->flush());
    EXPECT_EQ(*first->load({0, 0}).chunk, *store::numberedChunk(1)) << "an edited chunk stays";
    EXPECT_EQ(*second->load({1, 0}).chunk, *store::numberedChunk(2));
}

TEST_F(SharingTest, ManyThatOpenANewWorldGetTheSame) {
    constexpr int kPrograms = 4;
    for (int round = 0; round < 3; ++round) {
        address_ = addressIn(sharedServer(), freshSchema());
        std::vector<Opened> opened(kPrograms);
        std::vector<std::thread> threads;
        for (int k = 0; k < kPrograms; ++k)
            threads.emplace_back([&, k] {
                store::SaveAccess access = kCreateWorld;
                access.create->seed = static_cast<std::uint64_t>(100 + k);
                opened[static_cast<std::size_t>(k)] = tryOpen(access, WorldSharing::Servers);
            });
        for (std::thread& thread : threads) thread.join();
        for (const Opened& one : opened) {
            ASSERT_TRUE(one) << one.error().message;
            EXPECT_EQ((*one)->identity(), (*opened[0])->identity());
        }
    }
}

TEST_F(SharingTest, OfManyThatWantItAloneOneGetsIt) {
    std::vector<Opened> opened(2);
    std::vector<std::thread> threads;
    for (Opened& one : opened) threads.emplace_back([&] { one = tryOpen(); });
    for (std::thread& thread : threads) thread.join();
    int count = 0;
    for (const Opened& one : opened) {
        if (one)
            ++count;
        else
            EXPECT_EQ(one.error().code, ErrorCode::Busy) << one.error().message;
    }
    EXPECT_EQ(count, 1);
}

TEST_F(SharingTest, NotRegeneratedWhileOthersHaveIt) {
    makeWorld();
    const auto server = open(WorldSharing::Servers), worker = open(WorldSharing::Generating);
    expectBusy(regenerateBy(9), WorldSharing::Servers);
    EXPECT_EQ(open(WorldSharing::Servers)->identity(), store::kIdentity);
    EXPECT_EQ(query("SELECT count(*) FROM chunks"), "3");
    EXPECT_EQ(backups(), "0");
}

// Assigning ids to new block names requires exclusive access.
TEST_F(SharingTest, NewBlocksNeedTheWorldAlone) {
    const auto store = open(WorldSharing::Generating);
    registry_ = store::registryOf({"stone", "lamp"});
    expectBusy(kWorldMustBeThere, WorldSharing::Generating);
    EXPECT_EQ(query("SELECT count(*) FROM blocks WHERE name = 'lamp'"), "0");
}

TEST_F(SharingTest, RegeneratingKeepsTheWorldAsItWas) {
    makeWorld();
    sql("INSERT INTO quarantine (key, reason, data) VALUES (5, 'test', 'old')");
    open()->setMetadata("player", "1,2");
    {
        const auto store = tryOpen(regenerateBy(9));
        ASSERT_TRUE(store) << store.error().message;
        EXPECT_EQ((*store)->load({2, 0}).state, State::Absent);
        EXPECT_EQ((*store)->identity().seed, store::kIdentity.seed);
        EXPECT_EQ((*store)->identity().generatorVersion, 9);
        EXPECT_EQ((*store)->metadata("player"), "1,2");
        (*store)->save({2, 0}, store::numberedChunk(1000), Provenance::Edited);
    }
    const auto backup = openBackup(schema_ + "_backup_1");
    EXPECT_EQ(*backup->load({2, 0}).chunk, *store::numberedChunk(2));
    EXPECT_EQ(backup->identity(), store::kIdentity);
    EXPECT_EQ(backup->metadata("player"), "1,2");
    EXPECT_EQ(query("SELECT count(*) FROM quarantine"), "0");
    EXPECT_EQ(query("SELECT string_agg(reason, ' ') FROM " + schema_ + "_backup_1.quarantine"), "test");

    ASSERT_TRUE(tryOpen(regenerateBy(10)));
    EXPECT_EQ(openBackup(schema_ + "_backup_2")->identity().generatorVersion, 9)
        << "a copy replaces no other";
    address_ = addressIn(sharedServer(), schema_ + "_backup_1");
    EXPECT_TRUE(tryOpen(kWorldMustBeThere)) << "it can be played";
}

TEST_F(SharingTest, ChunksWithEditsStayWhereTheOthersAreMadeAnew) {
    makeWorld();
    {
        const auto store = open();
        store->save({0, 1}, store::numberedChunk(7), Provenance::Generated);
        store->save({0, 0, 1}, store::numberedChunk(8), Provenance::Edited);  // a tile
    }
    const auto store = tryOpen(regenerateBy(9, Regenerate::AllButEdited));
    ASSERT_TRUE(store) << store.error().message;
    for (int x = 0; x < 3; ++x) EXPECT_EQ(*(*store)->load({x, 0}).chunk, *store::numberedChunk(x));
    EXPECT_EQ((*store)->load({0, 1}).state, State::Absent);
    EXPECT_EQ((*store)->load({0, 0, 1}).state, State::Absent);
    EXPECT_EQ(*openBackup(schema_ + "_backup_1")->load({0, 1}).chunk, *store::numberedChunk(7));
}

TEST_F(SharingTest, ARefusedWorldIsLeftAsItIs) {
    makeWorld();
    store::SaveAccess access = kCreateWorld;
    access.decide = [](const store::WorldIdentity& saved) -> base::Result<store::Regeneration> {
        EXPECT_EQ(saved, store::kIdentity);
        return base::fail("not this one");
    };
    EXPECT_EQ(errorOf(tryOpen(access)).message, "not this one");
    EXPECT_EQ(backups(), "0");
    EXPECT_EQ(*open()->load({2, 0}).chunk, *store::numberedChunk(2));
}

}  // namespace
}  // namespace terrane::store_postgres

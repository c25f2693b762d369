// A server that stops, is killed and restarts under a store: loads wait, saves become durable, nothing is
// lost.
#include <thread>

#include "tests/store_postgres/world_fixture.h"

namespace terrane::store_postgres {
namespace {

using namespace std::chrono_literals;
using store::Provenance;
using testing::HasSubstr;
using State = store::LoadedChunk::State;

constexpr store::SaveLimits kSoon{.delay = 20ms, .chunks = 1000000};

class RestartTest : public PostgresWorldTest {
  protected:
    static void SetUpTestSuite() {
        server_ = std::make_unique<PostgresServer>(std::filesystem::temp_directory_path() /
                                                   fmt::format("terrane_restart_{}", ::getpid()));
    }
    static void TearDownTestSuite() { server_.reset(); }

    RestartTest() { address_ = addressIn(*server_, schema_); }

    std::unique_ptr<PostgresStore> openWith(const store::SaveLimits& limits, RetryTimes times = {}) {
        auto store =
            PostgresStore::open(address_, registry_, kCreateWorld, store::WorldSharing::Alone, limits, times);
        if (!store) throw std::runtime_error(store.error().message);
        return std::move(*store);
    }
    static bool waitUntilDurable(PostgresStore& store) {
        for (const auto end = std::chrono::steady_clock::now() + 20s;
             std::chrono::steady_clock::now() < end;) {
            const store::SaveStatus status = store.status();
            if (status.durable == status.queued) return true;
            std::this_thread::sleep_for(5ms);
        }
        return false;
    }

    static std::unique_ptr<PostgresServer> server_;
};
std::unique_ptr<PostgresServer> RestartTest::server_;

// Loads existing chunks continuously, and each new save again.
TEST_F(RestartTest, LoadsWaitAndSavesGetDurable) {
    constexpr int kLoaded = 20, kSaved = 8;
    const auto store = openWith(kSoon);
    for (int x = 0; x < kLoaded; ++x) store->save({x, 0}, store::numberedChunk(x), Provenance::Edited);
    ASSERT_TRUE(store->flush());
    std::atomic<bool> isEnding = false;
    std::atomic<int> loads = 0, wrong = 0, saved = 0;
    std::thread loading([&] {
        for (; !isEnding; ++loads) {
            const store::LoadedChunk loaded = store->load({loads % kLoaded, 0});
            const bool isRight = loaded.chunk && *loaded.chunk == *store::numberedChunk(loads % kLoaded);
            if (!isRight || !store->contains({loads % kLoaded, 0})) ++wrong;
        }
    });
    std::thread saving([&] {
        for (; !isEnding; ++saved, std::this_thread::sleep_for(1ms))
            store->save({saved % kSaved, 1}, store::numberedChunk(saved), Provenance::Edited);
    });
    const auto waitForMore = [&] {
        for (const int until = loads + 50; loads < until;) std::this_thread::sleep_for(1ms);
    };
    waitForMore();
    server_->stop();
    server_->start();
    waitForMore();
    server_->kill();
    server_->start();
    waitForMore();
    isEnding = true;
    loading.join();
    saving.join();
    EXPECT_EQ(wrong, 0);
    const auto flushed = store->flush();
    ASSERT_TRUE(flushed) << flushed.error().message;
    const auto reader = openReader(address_, registry_);
    ASSERT_TRUE(reader) << reader.error().message;
    for (int number = std::max(0, saved - kSaved); number < saved; ++number)
        EXPECT_EQ(*(*reader)->load({number % kSaved, 1}).chunk, *store::numberedChunk(number));
    EXPECT_EQ(server_->query("SELECT count(*) FROM " + schema_ + ".quarantine"), "0");
}

// Saves acknowledged before the kill exist; the others wait until the server is back.
TEST_F(RestartTest, WhatIsDurableOutlivesAKilledServer) {
    const auto store = openWith(store::kNever);
    for (int x = 0; x < 100; ++x) store->save({x, 0}, store::numberedChunk(x), Provenance::Generated);
    ASSERT_TRUE(store->flush());
    for (int x = 0; x < 100; ++x) store->save({x, 0}, store::numberedChunk(1000 + x), Provenance::Edited);
    server_->kill();
    server_->start();
    const auto reader = openReader(address_, registry_);
    ASSERT_TRUE(reader) << reader.error().message;
    for (int x = 0; x < 100; ++x) EXPECT_EQ(*(*reader)->load({x, 0}).chunk, *store::numberedChunk(x));
    const auto flushed = store->flush();
    ASSERT_TRUE(flushed) << static_cast<int>(flushed.error().code) << flushed.error().message;
    for (int x = 0; x < 100; ++x) EXPECT_EQ(*(*reader)->load({x, 0}).chunk, *store::numberedChunk(1000 + x));
}

TEST_F(RestartTest, AServerThatStaysAwayLosesNothing) {
    const auto store = openWith(kSoon, {.first = 5ms, .longest = 20ms, .total = 60ms});
    for (int x = 0; x < 2; ++x) store->save({x, 0}, store::numberedChunk(x), Provenance::Edited);
    ASSERT_TRUE(store->flush());
    server_->stop();
    for (const auto& loaded : {store->load({0, 0}), store->loadMany(std::array{world::ChunkPos{0, 0}})[0]}) {
        EXPECT_EQ(loaded.state, State::Damaged);
        EXPECT_TRUE(loaded.isUnreadable);
        EXPECT_THAT(loaded.problem, HasSubstr(address_.shown + ": chunk 0,0: "));
        EXPECT_EQ(loaded.problem.find('\n'), std::string::npos);
    }
    EXPECT_FALSE(store->contains({0, 0}));
    expectError(errorOf(store->editedChunks()), base::ErrorCode::Io, address_.shown, "");

    store->save({0, 0}, store::numberedChunk(50), Provenance::Generated);  // in place of the unread chunk
    store->save({1, 0}, store::numberedChunk(51), Provenance::Edited);
    store->setMetadata("player", "1,2");
    expectError(errorOf(store->flush()), base::ErrorCode::Io, address_.shown, "");
    const store::SaveStatus status = store->status();
    EXPECT_THAT(status.problem, HasSubstr(address_.shown + ": "));
    EXPECT_EQ(status.problem.find('\n'), std::string::npos);
    EXPECT_EQ(status.waiting, 1u);
    EXPECT_LT(status.durable, status.queued);
    EXPECT_EQ(*store->load({1, 0}).chunk, *store::numberedChunk(51));

    server_->start();
    EXPECT_TRUE(waitUntilDurable(*store));
    EXPECT_EQ(store->status().problem, "");
    EXPECT_EQ(*store->load({0, 0}).chunk, *store::numberedChunk(0));
    const auto reader = openReader(address_, registry_);
    ASSERT_TRUE(reader) << reader.error().message;
    EXPECT_EQ(*(*reader)->load({1, 0}).chunk, *store::numberedChunk(51));
    EXPECT_EQ((*reader)->metadata("player"), "1,2");
}

// A player edits an unreadable chunk: the old row is kept.
TEST_F(RestartTest, WhatCouldNotBeReadIsQuarantinedBeforeItIsReplaced) {
    const auto store = openWith(store::kNever, {.first = 5ms, .longest = 20ms, .total = 60ms});
    store->save({0, 0}, store::numberedChunk(1), Provenance::Edited);
    ASSERT_TRUE(store->flush());
    const std::string world = "SET search_path = " + schema_ + ";";
    const std::string before = server_->query(world + "SELECT md5(data) FROM chunks");
    server_->stop();
    EXPECT_TRUE(store->load({0, 0}).isUnreadable);
    server_->start();
    for (const int number : {2, 3}) {
        store->save({0, 0}, store::numberedChunk(number), Provenance::Edited);
        ASSERT_TRUE(store->flush());
    }
    EXPECT_EQ(server_->query(world + "SELECT string_agg(md5(data), ' ') FROM quarantine"), before);
    EXPECT_EQ(*store->load({0, 0}).chunk, *store::numberedChunk(3));
}

TEST_F(RestartTest, AStoppedServerIsNotOpened) {
    server_->stop();
    expectError(errorOf(tryOpen()), base::ErrorCode::Io, address_.shown, "cannot be reached: ");
    expectError(errorOf(openReader(address_, registry_)), base::ErrorCode::Io, address_.shown,
                "cannot be reached: ");
    server_->start();
    EXPECT_TRUE(tryOpen());
}

}  // namespace
}  // namespace terrane::store_postgres

// Connections cut at any moment, also during transactions.
#include <random>
#include <thread>

#include "tests/store_postgres/world_fixture.h"

namespace terrane::store_postgres {
namespace {

using namespace std::chrono_literals;
using store::Provenance;

constexpr int kChunks = 40;
constexpr std::chrono::milliseconds kLeastPause = 15ms;  // longer than connecting takes

class CutConnectionTest : public PostgresWorldTest {
  protected:
    CutConnectionTest() { address_ = addressIn(sharedServer(), schema_, "application_name=" + schema_); }

    // Cuts active connections until the end of the test.
    void cutAllTheTime() {
        while (!isEnding_) {
            cuts_ += std::stoi(sharedServer().query(
                "SELECT count(*) FILTER (WHERE pg_terminate_backend(pid)) FROM pg_stat_activity "
                "WHERE state <> 'idle' AND application_name = '" +
                schema_ + "'"));
            std::this_thread::sleep_for(pauseBetweenCuts_);
        }
    }

    std::atomic<bool> isEnding_ = false;
    std::atomic<int> cuts_ = 0;
    std::chrono::milliseconds pauseBetweenCuts_ = kLeastPause;
};

// About 400 KB in total, so that a transaction takes long enough to be cut.
world::ChunkPtr bigChunk(int number) {
    auto chunk = std::make_shared<world::Chunk>(*store::numberedChunk(number));
    std::mt19937 random(static_cast<std::uint32_t>(number));
    chunk->setBlockEntityData(0, store::randomBytes(random, 10000));
    return chunk;
}

// Whether all chunks are of the same save.
bool isWhole(const std::vector<store::LoadedChunk>& loaded) {
    return std::ranges::all_of(loaded, [&](const store::LoadedChunk& one) {
        const auto state = world::blockIndex(1, 1, 20);
        return one.chunk && one.chunk->blockState(state) == loaded[0].chunk->blockState(state);
    });
}

TEST_F(CutConnectionTest, EachBatchIsWrittenWholeAndOnce) {
    std::vector<world::ChunkPos> positions;
    for (int x = 0; x < kChunks; ++x) positions.push_back({x, 0});
    const auto store = open();
    const auto saveAll = [&](int number) {
        const auto chunk = bigChunk(number);
        for (const world::ChunkPos pos : positions) store->save(pos, chunk, Provenance::Edited);
        store->setMetadata("number", std::to_string(number));
        return store->flush();
    };
    const auto start = std::chrono::steady_clock::now();
    ASSERT_TRUE(saveAll(0));
    // A save that is cut repeatedly fails eventually, as intended: give each save enough time on slow
    // machines, too.
    pauseBetweenCuts_ = std::max(kLeastPause, 3 * std::chrono::duration_cast<std::chrono::milliseconds>(
                                                      std::chrono::steady_clock::now() - start));
    const auto reader = openReader(addressIn(sharedServer(), schema_), registry_);
    ASSERT_TRUE(reader);
    std::thread cutting([&] { cutAllTheTime(); });
    int last = 0;
    const auto end = std::chrono::steady_clock::now() + 60s;
    while (cuts_ < 12 && std::chrono::steady_clock::now() < end) {
        const auto saved = saveAll(++last);
        EXPECT_TRUE(saved) << saved.error().message;
        EXPECT_TRUE(isWhole((*reader)->loadMany(positions)));
        const auto loaded = store->load({last % kChunks, 0});  // its connection may be cut, too
        EXPECT_TRUE(loaded.chunk && *loaded.chunk == *bigChunk(last)) << loaded.problem;
    }
    isEnding_ = true;
    cutting.join();
    EXPECT_GE(cuts_, 12);
    for (const store::LoadedChunk& loaded : (*reader)->loadMany(positions))
        EXPECT_TRUE(loaded.chunk && *loaded.chunk == *bigChunk(last));
    EXPECT_EQ(query("SELECT value FROM settings WHERE name = 'number'"), std::to_string(last));
    EXPECT_EQ(query("SELECT count(*) FROM quarantine"), "0");
}

// Also after it ended: unsaved chunks of the first program would replace saves of the second.
TEST_F(CutConnectionTest, AnotherProgramTookTheWorld) {
    auto first = open();
    first->save({0, 0}, store::numberedChunk(1), Provenance::Edited);
    ASSERT_TRUE(first->flush());
    cutConnectionsOf(schema_);
    auto second = open();
    second->save({0, 0}, store::numberedChunk(2), Provenance::Edited);
    ASSERT_TRUE(second->flush());

    first->save({0, 0}, store::numberedChunk(3), Provenance::Edited);
    first->save({1, 0}, store::numberedChunk(3), Provenance::Edited);
    expectError(errorOf(first->flush()), base::ErrorCode::Busy, address_.shown, "open in another program");
    EXPECT_EQ(first->status().waiting, 2u);
    EXPECT_EQ(query("SELECT count(*) FROM chunks"), "1");
    EXPECT_EQ(*second->load({0, 0}).chunk, *store::numberedChunk(2));
    second.reset();
    expectError(errorOf(first->flush()), base::ErrorCode::Incompatible, address_.shown, "wrote the world");
    first.reset();
    EXPECT_EQ(query("SELECT count(*) FROM chunks"), "1");
    EXPECT_EQ(*open()->load({0, 0}).chunk, *store::numberedChunk(2));
}

// Its chunks would be of another generator version.
TEST_F(CutConnectionTest, AnotherProgramRegeneratedTheWorld) {
    const auto worker = open(store::WorldSharing::Generating);
    cutConnectionsOf(schema_);
    { ASSERT_TRUE(tryOpen(regenerateBy(9))); }
    worker->save({0, 0}, store::numberedChunk(1), Provenance::Generated);
    expectError(errorOf(worker->flush()), base::ErrorCode::Incompatible, address_.shown, "made by version 9");
    EXPECT_EQ(query("SELECT count(*) FROM chunks"), "0");
}

}  // namespace
}  // namespace terrane::store_postgres

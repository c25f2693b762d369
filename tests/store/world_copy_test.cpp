#include "terrane/store/saves/world_copy.h"

#include "terrane/store/sqlite/sqlite_store.h"
#include "tests/store/store_fixture.h"

namespace terrane::store {
namespace {

constexpr int kChunks = 10;

world::ChunkPos posOfChunk(int number) {
    return {3 * number - 10, 7 - number};
}

class WorldCopyTest : public testing::Test {
  protected:
    WorldCopyTest() {
        auto store = openFrom();
        for (int k = 0; k < kChunks; ++k)
            store->save(posOfChunk(k), numberedChunk(k), k % 2 ? Provenance::Edited : Provenance::Generated);
        store->setMetadata("time", "0.5");
        EXPECT_TRUE(store->flush());
    }

    std::unique_ptr<SqliteStore> openFrom() {
        return SqliteStore::open(from_, registry_, {.create = kIdentity, .decide = {}}, kNever).value();
    }
    base::Result<CopyReport> copy(const RowsProgress& progress = {}) {
        auto from = openSqliteToRead(from_, registry_).value();
        auto to = openSqliteRows(to_, registry_, accessOfCopy(*from)).value();
        const auto lastKey = beginCopy(*from, *to);
        if (!lastKey) return tl::unexpected(lastKey.error());
        return copyWorld(*from, *to, *lastKey, progress);
    }
    void expectCopied(int number, int content, Provenance provenance) {
        auto to = SqliteStore::open(to_, registry_, {.create = {}, .decide = {}}, kNever).value();
        const LoadedChunk loaded = to->load(posOfChunk(number));
        ASSERT_TRUE(loaded.chunk) << number;
        EXPECT_EQ(*loaded.chunk, *numberedChunk(content)) << number;
        EXPECT_EQ(loaded.provenance, provenance) << number;
    }

    base::TempFolder folder_;
    const std::filesystem::path from_ = folder_ / "from.sqlite", to_ = folder_ / "to.sqlite";
    const world::BlockRegistry registry_ = testRegistry();
};

TEST_F(WorldCopyTest, EachRowIsCopiedOnce) {
    const auto report = copy();
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->rows, kChunks);
    EXPECT_EQ(report->copied, kChunks);
    EXPECT_EQ(report->damaged, 0u);
    EXPECT_GT(report->bytes, 0u);
    for (int k = 0; k < kChunks; ++k) expectCopied(k, k, k % 2 ? Provenance::Edited : Provenance::Generated);
    auto to = SqliteStore::open(to_, registry_, {.create = {}, .decide = {}}, kNever).value();
    EXPECT_EQ(to->metadata("time"), "0.5");
}

// Another program changes the world after its rows were copied and before they are compared.
TEST_F(WorldCopyTest, WhatChangesMeanwhileIsCopiedAgain) {
    auto store = openFrom();
    bool isChanged = false;
    const auto report = copy([&](std::uint64_t) {
        if (std::exchange(isChanged, true)) return true;
        store->save(posOfChunk(3), numberedChunk(33), Provenance::Edited);
        store->save(posOfChunk(4), numberedChunk(4), Provenance::Edited);  // only its origin changes
        store->save(posOfChunk(kChunks), numberedChunk(kChunks), Provenance::Edited);
        EXPECT_TRUE(store->flush());
        return true;
    });
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->rows, kChunks + 1);
    EXPECT_EQ(report->copied, kChunks + 3);
    expectCopied(3, 33, Provenance::Edited);
    expectCopied(4, 4, Provenance::Edited);
    expectCopied(kChunks, kChunks, Provenance::Edited);
}

TEST_F(WorldCopyTest, DamagedRowsAreLeftOutAndCounted) {
    runSql(from_, "UPDATE chunks SET data = zeroblob(100) WHERE key IN (SELECT key FROM chunks LIMIT 3)");
    const auto report = copy();
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->rows, kChunks - 3);
    EXPECT_EQ(report->copied, kChunks - 3);
    EXPECT_EQ(report->damaged, 3u);
    EXPECT_NE(report->firstDamage, "");
}

TEST_F(WorldCopyTest, AStoppedCopyGoesOn) {
    const auto stopped = copy([](std::uint64_t) { return false; });
    ASSERT_FALSE(stopped);
    EXPECT_EQ(stopped.error().code, base::ErrorCode::Busy);
    const auto report = copy();
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->rows, kChunks);
    EXPECT_EQ(report->copied, 0u) << "all were copied before";
    const auto again = copy();
    ASSERT_FALSE(again);
    EXPECT_NE(again.error().message.find("a copy that was finished"), std::string::npos);
}

}  // namespace
}  // namespace terrane::store

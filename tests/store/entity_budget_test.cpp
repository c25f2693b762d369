#include "terrane/store/chunks/entity_budget.h"

#include <gmock/gmock.h>

#include "terrane/store/chunks/chunk_codec.h"
#include "terrane/store/chunks/chunk_key.h"
#include "terrane/store/sqlite/sqlite_store.h"
#include "tests/store/store_fixture.h"

namespace terrane::store {
namespace {

using testing::HasSubstr;
using State = LoadedChunk::State;

constexpr std::size_t kMiB = std::size_t{1} << 20;

TEST(EntityBudget, CountsDataUntilNobodyHoldsIt) {
    EntityBudget budget(10000);
    {
        world::Chunk chunk;
        chunk.shareBlockEntityData(7, budget.hold(world::BlockEntityData(6000)));
        EXPECT_GE(budget.usedBytes(), 6000u);
        EXPECT_EQ(budget.hold(world::BlockEntityData(6000)), nullptr);
        EXPECT_TRUE(budget.hold(world::BlockEntityData(1000))) << "what was refused counts no more";
        const std::size_t used = budget.usedBytes();
        world::Chunk copy = chunk;
        copy.setBlock(5, 1);
        EXPECT_EQ(copy.blockEntityData(7), chunk.blockEntityData(7));
        EXPECT_EQ(budget.usedBytes(), used) << "copies share";
        chunk.clearBlockEntityData(7);
        EXPECT_EQ(budget.usedBytes(), used);
    }
    EXPECT_EQ(budget.usedBytes(), 0u);
    EXPECT_FALSE(budget.hasRoomFor(10001));
    EXPECT_TRUE(budget.hasRoomFor(10000));
}

TEST(EntityBudget, DataOutlivesTheBudget) {
    auto budget = std::make_unique<EntityBudget>(1000);
    const auto data = budget->hold(world::BlockEntityData(10, std::byte{3}));
    budget.reset();
    EXPECT_EQ((*data)[9], std::byte{3});
}

// Many small pieces use more memory than their bytes.
TEST(EntityBudget, ManySmallPiecesAreCounted) {
    world::Chunk chunk;
    for (int i = 0; i < 20000; ++i)
        chunk.setBlockEntityData(static_cast<world::BlockIndex>(i), world::BlockEntityData(1));
    const Bytes bytes = *encodeChunk(chunk, allIds());
    EntityBudget small(kMiB), large(10 * kMiB);
    const auto refused = decodeChunk(bytes, allIds(), {}, 0, &small);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, base::ErrorCode::OutOfResources);
    EXPECT_EQ(small.usedBytes(), 0u);
    const auto taken = decodeChunk(bytes, allIds(), {}, 0, &large);
    ASSERT_TRUE(taken);
    EXPECT_EQ(*taken, chunk);
}

// A small file whose chunks expand to 20 MiB each.
class SwollenSaveTest : public testing::Test {
  protected:
    static constexpr int kRows = 10;
    static constexpr SaveLimits kLimits{
        .delay = std::chrono::hours(1), .chunks = 1000000, .entityBytes = 64 * kMiB};

    void SetUp() override {
        auto store = SqliteStore::open(path_, registry_, {.create = kIdentity, .decide = {}});
        ASSERT_TRUE(store);
        world::Chunk chunk = *numberedChunk(1);
        chunk.setBlockEntityData(9, world::BlockEntityData(20 * kMiB));
        (*store)->save({0, 0}, std::make_shared<const world::Chunk>(chunk), Provenance::Edited);
        store->reset();
        copyRow();
        EXPECT_LT(std::filesystem::file_size(path_), 200000u);
    }
    void copyRow() {
        auto database = Database::open(path_, OpenMode::ReadWrite);
        ASSERT_TRUE(database);
        auto select = database->prepare("SELECT data FROM chunks");
        auto insert = database->prepare("INSERT INTO chunks VALUES (?1, 1, ?2)");
        ASSERT_TRUE(select && insert && select->step());
        Bytes data(select->blob(0).begin(), select->blob(0).end());
        select->reset();
        for (int x = 1; x < kRows; ++x) {
            sealChunk(data, checksumSeed({x, 0}, true));
            insert->bind(1, keyOf({x, 0}));
            insert->bind(2, ByteView(data));
            ASSERT_TRUE(insert->run());
        }
    }
    std::vector<world::ChunkPos> positions() const {
        std::vector<world::ChunkPos> all;
        for (int x = 0; x < kRows; ++x) all.push_back({x, 0});
        return all;
    }
    static int presentIn(const std::vector<LoadedChunk>& loaded) {
        return static_cast<int>(
            std::ranges::count_if(loaded, [](const auto& l) { return l.state == State::Present; }));
    }

    base::TempFolder folder_;
    std::filesystem::path path_ = folder_ / "a.sqlite";
    world::BlockRegistry registry_ = testRegistry();
};

TEST_F(SwollenSaveTest, WhatGoesBeyondTheBudgetStaysInTheSave) {
    const auto store = SqliteStore::open(path_, registry_, {}, kLimits);
    ASSERT_TRUE(store);
    {
        const auto held = (*store)->loadMany(positions());
        EXPECT_EQ(presentIn(held), 3);
        EXPECT_EQ(held[3].state, State::Damaged);
        EXPECT_TRUE(held[3].isUnreadable);
        EXPECT_THAT(held[3].problem,
                    HasSubstr("chunk 3,0: its block entity data are more than may be in memory"));
        // A generated chunk is not saved there, an edited one is, and the row is quarantined.
        (*store)->save({3, 0}, numberedChunk(3), Provenance::Generated);
        (*store)->save({4, 0}, numberedChunk(4), Provenance::Edited);
        ASSERT_TRUE((*store)->flush());
        EXPECT_EQ(*(*store)->load({4, 0}).chunk, *numberedChunk(4));
    }
    EXPECT_EQ(queryFile(path_, "SELECT count(*) FROM quarantine"), 1);
    EXPECT_EQ(queryFile(path_, "SELECT count(*) FROM chunks"), kRows);
    EXPECT_EQ((*store)->load({3, 0}).state, State::Present) << "there is room again";
}

TEST_F(SwollenSaveTest, ForReadersToo) {
    const auto store = SqliteReader::open(path_, registry_, kLimits);
    ASSERT_TRUE(store);
    testing::internal::CaptureStderr();
    EXPECT_EQ(presentIn((*store)->loadMany(positions())), 3);
    const std::string log = testing::internal::GetCapturedStderr();
    EXPECT_EQ(std::ranges::count(log, '\n'), 1) << log;
    EXPECT_EQ(presentIn((*store)->loadMany(positions())), 3);
}

// A row whose size exceeds any chunk: noted, and replaced.
TEST_F(SwollenSaveTest, RowsLongerThanAChunk) {
    runSql(path_, fmt::format("UPDATE chunks SET data = zeroblob(70000000) WHERE key IN ({}, {})",
                              keyOf({1, 0}), keyOf({2, 0})));
    const auto store = SqliteStore::open(path_, registry_, {}, kLimits);
    ASSERT_TRUE(store);
    const LoadedChunk loaded = (*store)->load({1, 0});
    EXPECT_EQ(loaded.state, State::Damaged);
    EXPECT_THAT(loaded.problem, HasSubstr("a value is longer than"));
    for (const int x : {1, 2}) (*store)->save({x, 0}, numberedChunk(x), Provenance::Edited);
    ASSERT_TRUE((*store)->flush());
    for (const int x : {1, 2}) EXPECT_EQ(*(*store)->load({x, 0}).chunk, *numberedChunk(x));
    EXPECT_EQ(queryFile(path_, "SELECT count(*) FROM quarantine"), 2);
}

TEST_F(SwollenSaveTest, MetadataIsBounded) {
    auto store = SqliteStore::open(path_, registry_, {}, kLimits);
    ASSERT_TRUE(store);
    testing::internal::CaptureStderr();
    (*store)->setMetadata(std::string(kMaxNameBytes + 1, 'n'), "1");
    (*store)->setMetadata("large", std::string(kMaxMetadataBytes, 'v'));
    for (std::size_t k = 0; k < kMaxMetadata; ++k) (*store)->setMetadata(fmt::format("n{}", k), "v");
    const std::string log = testing::internal::GetCapturedStderr();
    EXPECT_THAT(log, HasSubstr("too many for a save"));
    EXPECT_EQ((*store)->metadata("large"), std::nullopt);
    ASSERT_TRUE((*store)->flush());
    store->reset();
    EXPECT_EQ(queryFile(path_, "SELECT count(*) FROM settings"), static_cast<std::int64_t>(kMaxMetadata) - 1)
        << "there is room for the mark of tiles";
    EXPECT_TRUE(SqliteReader::open(path_, registry_));
}

}  // namespace
}  // namespace terrane::store

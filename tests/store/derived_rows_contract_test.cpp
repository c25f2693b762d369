// The contract of every ChunkStore for derived rows. The stores are in store_kinds_test.cpp.
#include "terrane/store/derived_rows.h"

#include <gmock/gmock.h>

#include <thread>

#include "tests/store/chunk_store_contract.h"
#include "tests/store/tile_sums.h"

namespace terrane::store {
namespace {

using State = LoadedChunk::State;
using testing::ElementsAre;
using testing::IsEmpty;
using world::ChunkPos;

// Arguments of the functions of deriveSums(). Read after flush().
struct Calls {
    std::vector<std::vector<ChunkPos>> derived, written;
    std::vector<std::thread::id> threads;

    static std::vector<ChunkPos> positionsOf(std::span<const ChunkRow> rows) {
        std::vector<ChunkPos> positions;
        for (const ChunkRow& row : rows) positions.push_back(row.pos);
        return positions;
    }
    DerivedRows rows() {
        return {[this](std::span<const ChunkRow> edited, const ReadEdited& saved) {
                    derived.push_back(positionsOf(edited));
                    threads.push_back(std::this_thread::get_id());
                    return deriveSums(edited, saved);
                },
                [this](std::span<const ChunkRow> rows) {
                    written.push_back(positionsOf(rows));
                    threads.push_back(std::this_thread::get_id());
                }};
    }
};

// Expects exactly the tiles derived from these chunks, among chunks -8 to 7.
void expectTilesOf(ChunkStore& store, const std::vector<ChunkRow>& edited) {
    TileMap expected = tilesOf(edited);
    for (int level = 1; level <= kTopTileLevel; ++level)
        for (int y = -8 >> level; y < 8 >> level; ++y)
            for (int x = -8 >> level; x < 8 >> level; ++x)
                expected.try_emplace({x, y, static_cast<std::uint8_t>(level)});
    for (const auto& [pos, tile] : expected) {
        const LoadedChunk loaded = store.load(pos);
        ASSERT_EQ(loaded.state, tile ? State::Present : State::Absent) << nameOf(pos);
        EXPECT_EQ(store.contains(pos), tile != nullptr) << nameOf(pos);
        if (!tile) continue;
        EXPECT_EQ(*loaded.chunk, *tile) << nameOf(pos);
        EXPECT_EQ(loaded.provenance, Provenance::Edited);
    }
}

void saveAll(ChunkStore& store, const std::vector<ChunkRow>& rows) {
    for (const ChunkRow& row : rows) store.save(row.pos, row.chunk, Provenance::Edited);
}

TEST_P(ChunkStoreContract, DerivedRowsComeWithTheirChunks) {
    const auto store = world_->open();
    Calls calls;
    store->setDerivedRows(calls.rows());
    store->save({0, 0}, numberedChunk(1), Provenance::Edited);
    store->save({-3, 5}, numberedChunk(2), Provenance::Edited);
    store->save({4, 4}, numberedChunk(3), Provenance::Generated);
    store->save({9, 9, 1}, numberedChunk(4), Provenance::Edited);
    expectTilesOf(*store, {});
    ASSERT_TRUE(store->flush());
    expectTilesOf(*store, {{{0, 0}, numberedChunk(1)}, {{-3, 5}, numberedChunk(2)}});
    EXPECT_THAT(calls.derived, ElementsAre(ElementsAre(ChunkPos{-3, 5}, ChunkPos{0, 0})));
    ASSERT_EQ(calls.written.size(), 1u);
    EXPECT_THAT(calls.written[0],
                ElementsAre(ChunkPos{-2, 2, 1}, ChunkPos{0, 0, 1}, ChunkPos{-1, 1, 2}, ChunkPos{0, 0, 2}));

    // Siblings saved in an earlier batch are included.
    store->save({1, 0}, numberedChunk(5), Provenance::Edited);
    ASSERT_TRUE(store->flush());
    expectTilesOf(*store,
                  {{{0, 0}, numberedChunk(1)}, {{-3, 5}, numberedChunk(2)}, {{1, 0}, numberedChunk(5)}});
    ASSERT_EQ(calls.threads.size(), 4u);
    for (const std::thread::id thread : calls.threads) {
        EXPECT_EQ(thread, calls.threads[0]);
        EXPECT_NE(thread, std::this_thread::get_id());
    }
}

TEST_P(ChunkStoreContract, DerivedRowsGoWithTheirChunks) {
    const auto store = world_->open();
    store->setDerivedRows({deriveSums, {}});
    saveAll(*store, {{{0, 0}, numberedChunk(1)}, {{2, 0}, numberedChunk(2)}});
    ASSERT_TRUE(store->flush());
    const auto none = std::make_shared<world::Chunk>();
    saveAll(*store, {{{0, 0}, none}});
    ASSERT_TRUE(store->flush());
    EXPECT_FALSE(store->contains({0, 0, 1}));
    expectTilesOf(*store, {{{2, 0}, numberedChunk(2)}});
    saveAll(*store, {{{2, 0}, none}});
    ASSERT_TRUE(store->flush());
    expectTilesOf(*store, {});
    saveAll(*store, {{{2, 0}, numberedChunk(3)}});
    ASSERT_TRUE(store->flush());
    expectTilesOf(*store, {{{2, 0}, numberedChunk(3)}});
}

bool isNumbered(const world::ChunkPtr& chunk, int number) {
    return chunk && *chunk == *numberedChunk(number);
}

// During derive() the store has the state before the batch, and accepts saves.
TEST_P(ChunkStoreContract, WhatDeriveSees) {
    const auto store = world_->open();
    saveAll(*store, {{{0, 0}, numberedChunk(1)}});
    store->save({5, 5}, numberedChunk(2), Provenance::Generated);
    ASSERT_TRUE(store->flush());
    std::vector<std::vector<ChunkRow>> batches;
    const auto derive = [&](std::span<const ChunkRow> edited, const ReadEdited& saved) {
        batches.emplace_back(edited.begin(), edited.end());
        EXPECT_EQ(saved({5, 5}), nullptr) << "generated";
        EXPECT_EQ(saved({6, 6}), nullptr) << "absent";
        if (batches.size() == 1) {
            store->save({0, 0}, numberedChunk(4), Provenance::Edited);
            store->save({3, 3}, numberedChunk(5), Provenance::Edited);
            EXPECT_TRUE(isNumbered(saved({0, 0}), 1)) << "not what waits";
            EXPECT_EQ(saved({3, 3}), nullptr);
            EXPECT_FALSE(saved({0, 0, 1}));
        } else {
            EXPECT_TRUE(isNumbered(saved({0, 0}), 3));
            EXPECT_TRUE(saved({0, 0, 1}));
        }
        auto rows = deriveSums(edited, saved);
        for (const ChunkRow& row : rows) {
            EXPECT_EQ(store->contains(row.pos), saved(row.pos) != nullptr) << "not before the chunks";
        }
        return rows;
    };
    store->setDerivedRows({derive, {}});
    saveAll(*store, {{{0, 0}, numberedChunk(3)}});
    ASSERT_TRUE(store->flush());
    ASSERT_EQ(batches.size(), 1u);
    expectTilesOf(*store, {{{0, 0}, numberedChunk(3)}});
    EXPECT_EQ(*store->load({0, 0}).chunk, *numberedChunk(4)) << "it waits";
    EXPECT_EQ(store->status().waiting, 2u);

    ASSERT_TRUE(store->flush());
    ASSERT_EQ(batches.size(), 2u);
    ASSERT_EQ(batches[1].size(), 2u);
    EXPECT_EQ(*batches[1][0].chunk, *numberedChunk(4));
    EXPECT_EQ(batches[1][1].pos, (ChunkPos{3, 3}));
    expectTilesOf(*store, {{{0, 0}, numberedChunk(4)}, {{3, 3}, numberedChunk(5)}});
}

TEST_P(ChunkStoreContract, WrittenRowsCanBeLoadedAndFlushWaitsForIt) {
    const auto store = world_->open();
    int calls = 0;
    const auto written = [&](std::span<const ChunkRow> rows) {
        for (const ChunkRow& row : rows) EXPECT_EQ(*store->load(row.pos).chunk, *row.chunk);
        EXPECT_EQ(rows.size(), 2u);
        EXPECT_EQ(*store->load({0, 0}).chunk, *numberedChunk(1));
        ++calls;
    };
    store->setDerivedRows({deriveSums, written});
    saveAll(*store, {{{0, 0}, numberedChunk(1)}});
    ASSERT_TRUE(store->flush());
    EXPECT_EQ(calls, 1);
    store->setMetadata("player", "1,2,3");
    store->save({1, 1}, numberedChunk(1), Provenance::Generated);
    ASSERT_TRUE(store->flush());
    EXPECT_EQ(calls, 1) << "nothing was edited";
    store->setDerivedRows({});
    saveAll(*store, {{{0, 1}, numberedChunk(1)}});
    ASSERT_TRUE(store->flush());
    EXPECT_EQ(calls, 1);
}

TEST_P(ChunkStoreContract, ARestartKeepsDerivedRows) {
    bool isPersistent = false;
    const std::vector<ChunkRow> edited = {{{0, 0}, numberedChunk(1)}, {{-4, 3}, numberedChunk(2)}};
    {
        const auto store = world_->open();
        isPersistent = store->isPersistent();
        store->setDerivedRows({deriveSums, {}});
        ASSERT_TRUE(ensureDerivedRows(*store, "sums"));
        saveAll(*store, edited);
    }
    const auto store = world_->open();
    expectTilesOf(*store, isPersistent ? edited : std::vector<ChunkRow>());
    EXPECT_EQ(store->metadata(kDerivedRowsMark),
              isPersistent ? std::optional<std::string>("sums") : std::nullopt);
}

TEST_P(ChunkStoreContract, TellsEditedChunks) {
    const auto store = world_->open();
    EXPECT_THAT(*store->editedChunks(), IsEmpty());
    saveAll(*store, {{{3, -4}, numberedChunk(1)}, {{world::kMinChunk, world::kMaxChunk}, numberedChunk(2)}});
    store->save({4, 4}, numberedChunk(3), Provenance::Generated);
    store->save({3, 3, 1}, numberedChunk(4), Provenance::Edited);
    EXPECT_THAT(*store->editedChunks(), IsEmpty()) << "they wait";
    ASSERT_TRUE(store->flush());
    store->save({4, 4}, numberedChunk(5), Provenance::Edited);
    ASSERT_TRUE(store->flush());
    EXPECT_THAT(*store->editedChunks(),
                ElementsAre(ChunkPos{world::kMinChunk, world::kMaxChunk}, ChunkPos{3, -4}, ChunkPos{4, 4}));
}

TEST_P(ChunkStoreContract, DerivesAll) {
    const auto store = world_->open();
    // Without four chunks, so that the second group begins in the middle of a tile of level 2.
    std::vector<ChunkRow> edited;
    for (int k = 0; k < 16 * 16; ++k)
        if (k % 16 > 1 || k / 16 > 1) edited.push_back({{k % 16 - 8, k / 16 - 8}, numberedChunk(k)});
    for (int k = 0; k < 300; ++k) edited.push_back({{1000 + k % 16, k / 16}, numberedChunk(k)});
    saveAll(*store, edited);
    store->save({0, 0, 1}, numberedChunk(1), Provenance::Edited);
    store->save({0, 0, 2}, numberedChunk(1), Provenance::Generated);
    store->save({9, 9, 3}, numberedChunk(1), Provenance::Edited);
    ASSERT_TRUE(store->flush());

    Calls calls;
    store->setDerivedRows(calls.rows());
    ASSERT_TRUE(store->deriveAll("sums"));
    expectTilesOf(*store, edited);
    EXPECT_TRUE(store->contains({500, 0, 1}));
    EXPECT_FALSE(store->contains({9, 9, 3})) << "a row that follows from nothing";
    EXPECT_THAT(calls.written, IsEmpty());
    std::size_t count = 0;
    for (const auto& group : calls.derived) {
        EXPECT_LE(group.size(), kDeriveGroup);
        count += group.size();
    }
    EXPECT_EQ(count, edited.size());
    EXPECT_LE(calls.derived.size(), 3u);
}

TEST_P(ChunkStoreContract, TheMarkTellsWhetherAllRowsAreDerived) {
    const auto store = world_->open();
    saveAll(*store, {{{0, 0}, numberedChunk(1)}});
    ASSERT_TRUE(store->flush());
    store->setMetadata(kDerivedRowsMark, "sums");
    EXPECT_EQ(store->metadata(kDerivedRowsMark), std::nullopt) << "it cannot be faked";

    store->setDerivedRows({deriveSums, {}});
    EXPECT_EQ(ensureDerivedRows(*store, "sums"), true);
    expectTilesOf(*store, {{{0, 0}, numberedChunk(1)}});
    EXPECT_EQ(store->metadata(kDerivedRowsMark), "sums");
    EXPECT_EQ(ensureDerivedRows(*store, "sums"), false) << "they are there";
    EXPECT_EQ(ensureDerivedRows(*store, "other sums"), true);

    saveAll(*store, {{{2, 2}, numberedChunk(2)}});
    ASSERT_TRUE(store->flush());
    EXPECT_EQ(store->metadata(kDerivedRowsMark), "other sums");
    store->setDerivedRows({});
    store->save({1, 0}, numberedChunk(1), Provenance::Generated);
    ASSERT_TRUE(store->flush());
    EXPECT_EQ(store->metadata(kDerivedRowsMark), "other sums") << "nothing follows from generated chunks";
    saveAll(*store, {{{3, 3}, numberedChunk(3)}});
    ASSERT_TRUE(store->flush());
    EXPECT_EQ(store->metadata(kDerivedRowsMark), std::nullopt) << "edited without derive()";
    store->setDerivedRows({deriveSums, {}});
    EXPECT_EQ(ensureDerivedRows(*store, "other sums"), true);
    expectTilesOf(*store,
                  {{{0, 0}, numberedChunk(1)}, {{2, 2}, numberedChunk(2)}, {{3, 3}, numberedChunk(3)}});
}

// setDerivedRows() and deriveAll() concurrent with saves: for the thread sanitizer; every tile is right at
// the end.
TEST_P(ChunkStoreContract, DerivesAllBesideSaves) {
    const auto store = world_->open();
    std::vector<ChunkRow> edited;
    for (int k = 0; k < 64; ++k) edited.push_back({{k % 8, k / 8}, numberedChunk(k)});
    store->setDerivedRows({deriveSums, {}});
    std::thread saving([&] {
        for (const ChunkRow& row : edited) {
            store->save(row.pos, row.chunk, Provenance::Edited);
            if (row.pos.x == 5 && !store->flush()) ADD_FAILURE() << "flush";
        }
    });
    for (int k = 0; k < 5; ++k) {
        EXPECT_TRUE(store->deriveAll("sums"));
        store->setDerivedRows({deriveSums, {}});
    }
    saving.join();
    ASSERT_TRUE(store->flush());
    expectTilesOf(*store, edited);
    EXPECT_EQ(store->metadata(kDerivedRowsMark), "sums");
}

}  // namespace
}  // namespace terrane::store

// Derived rows in a file: failed writes, damage, other programs.
#include <gmock/gmock.h>

#include "terrane/store/chunks/chunk_key.h"
#include "terrane/store/saves/save_check.h"
#include "terrane/store/sqlite/sqlite_store.h"
#include "tests/store/store_fixture.h"
#include "tests/store/tile_sums.h"

namespace terrane::store {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using world::ChunkPos;

class SqliteDerivedRowsTest : public testing::Test {
  protected:
    std::unique_ptr<SqliteStore> open(Regenerate regenerate = Regenerate::None) {
        SaveAccess access{.create = kIdentity, .decide = {}};
        access.decide = [=](const WorldIdentity& saved) {
            return Regeneration{regenerate, saved.generatorVersion + (regenerate != Regenerate::None)};
        };
        auto store = SqliteStore::open(path_, registry_, access, kNever);
        if (!store) throw std::runtime_error(store.error().message);
        (*store)->setDerivedRows({deriveSums, {}});
        return std::move(*store);
    }
    // With tiles, unless `rules` is "".
    void makeSave(std::string_view rules = "sums") {
        const auto store = open();
        if (rules.empty()) {
            store->setDerivedRows({});
        } else {
            ASSERT_TRUE(ensureDerivedRows(*store, rules));
        }
        for (const ChunkRow& row : edited_) store->save(row.pos, row.chunk, Provenance::Edited);
        store->save({20, 20}, numberedChunk(20), Provenance::Generated);
    }
    std::int64_t tileCount() {
        return queryFile(path_, fmt::format("SELECT count(*) FROM chunks WHERE key >= {}", kFirstTileKey));
    }
    void expectTiles(SqliteStore& store, const std::vector<ChunkRow>& edited) {
        const TileMap tiles = tilesOf(edited);
        for (const auto& [pos, tile] : tiles) {
            const auto loaded = store.load(pos).chunk;
            ASSERT_TRUE(loaded) << nameOf(pos);
            EXPECT_EQ(*loaded, *tile) << nameOf(pos);
        }
        EXPECT_EQ(tileCount(), static_cast<std::int64_t>(tiles.size()));
    }

    base::TempFolder folder_;
    std::filesystem::path path_ = folder_ / "a.sqlite";
    world::BlockRegistry registry_ = testRegistry();
    const std::vector<ChunkRow> edited_ = {
        {{0, 0}, numberedChunk(1)}, {{1, 0}, numberedChunk(2)}, {{6, -7}, numberedChunk(3)}};
};

TEST_F(SqliteDerivedRowsTest, WhatFailedIsDerivedAgainWithTheNewerChunk) {
    const auto store = open();
    std::vector<std::vector<ChunkRow>> derived;
    int written = 0;
    store->setDerivedRows({[&](std::span<const ChunkRow> edited, const ReadEdited& saved) {
                               derived.emplace_back(edited.begin(), edited.end());
                               return deriveSums(edited, saved);
                           },
                           [&](std::span<const ChunkRow>) { ++written; }});
    // Makes writing tiles fail by a numeric overflow in their index; chunks can be written.
    runSql(path_, fmt::format("CREATE INDEX failure ON chunks (abs(-9223372036854775807 - (key >= {})))",
                              kFirstTileKey));
    store->save({0, 0}, numberedChunk(1), Provenance::Edited);
    const auto failed = store->flush();
    ASSERT_FALSE(failed);
    EXPECT_THAT(failed.error().message, HasSubstr("integer overflow"));
    EXPECT_EQ(store->status().durable, 0u);
    EXPECT_EQ(queryFile(path_, "SELECT count(*) FROM chunks"), 0) << "neither the chunk nor its tiles";
    EXPECT_FALSE(store->contains({0, 0, 1}));
    EXPECT_EQ(written, 0);

    store->save({0, 0}, numberedChunk(2), Provenance::Edited);
    runSql(path_, "DROP INDEX failure");
    ASSERT_TRUE(store->flush());
    ASSERT_EQ(derived.size(), 2u);
    EXPECT_EQ(*derived[1][0].chunk, *numberedChunk(2));
    EXPECT_EQ(written, 1);
    expectTiles(*store, {{{0, 0}, numberedChunk(2)}});
}

TEST_F(SqliteDerivedRowsTest, DeriveAllThatFailsChangesNothing) {
    makeSave();
    const auto store = open();
    runSql(path_, "CREATE INDEX failure ON settings (abs(-9223372036854775807 - (value = 'other')))");
    EXPECT_FALSE(store->deriveAll("other"));
    EXPECT_EQ(store->metadata(kDerivedRowsMark), "sums");
    expectTiles(*store, edited_);
    runSql(path_, "DROP INDEX failure");
    EXPECT_TRUE(store->deriveAll("other"));
    expectTiles(*store, edited_);
}

// A save of a program without tiles, or with other rules.
TEST_F(SqliteDerivedRowsTest, ASaveMadeBeforeGetsItsRowsOnce) {
    makeSave("");
    runSql(path_,
           fmt::format("INSERT INTO chunks SELECT {}, 1, data FROM chunks LIMIT 1", keyOf({99, 9, 1})));
    {
        const auto store = open();
        EXPECT_EQ(store->metadata(kDerivedRowsMark), std::nullopt);
        EXPECT_EQ(ensureDerivedRows(*store, "sums"), true);
        expectTiles(*store, edited_);
    }
    const auto store = open();
    EXPECT_EQ(ensureDerivedRows(*store, "sums"), false);
    expectTiles(*store, edited_);
}

TEST_F(SqliteDerivedRowsTest, EditsWithoutTilesTakeTheMarkFromTheFile) {
    makeSave();
    {
        const auto store = open();
        store->setDerivedRows({});
        store->save({3, 3}, numberedChunk(4), Provenance::Edited);
    }
    EXPECT_EQ(open()->metadata(kDerivedRowsMark), std::nullopt);
}

TEST_F(SqliteDerivedRowsTest, RegenerationDropsTiles) {
    for (const Regenerate regenerate : {Regenerate::AllButEdited, Regenerate::All}) {
        makeSave();
        EXPECT_GT(tileCount(), 0);
        const auto store = open(regenerate);
        EXPECT_EQ(tileCount(), 0);
        EXPECT_EQ(store->metadata(kDerivedRowsMark), std::nullopt);
        EXPECT_FALSE(store->contains({20, 20}));
        EXPECT_EQ(store->contains({0, 0}), regenerate == Regenerate::AllButEdited);
        EXPECT_EQ(ensureDerivedRows(*store, "sums"), true);
        expectTiles(*store, regenerate == Regenerate::All ? std::vector<ChunkRow>() : edited_);
    }
}

// Lost rows are derived again when the save is opened the next time.
TEST_F(SqliteDerivedRowsTest, DamagedRowsTakeTheMark) {
    for (const ChunkPos damaged : {ChunkPos{0, 0}, ChunkPos{0, 0, 1}}) {
        std::filesystem::remove(path_);
        makeSave();
        runSql(path_, fmt::format("UPDATE chunks SET data = zeroblob(60) WHERE key = {}", keyOf(damaged)));
        {
            const auto store = open();
            EXPECT_EQ(store->load(damaged).state, LoadedChunk::State::Damaged);
            ASSERT_TRUE(store->flush());
            EXPECT_EQ(store->metadata(kDerivedRowsMark), std::nullopt);
        }
        const auto store = open();
        EXPECT_EQ(ensureDerivedRows(*store, "sums"), true);
        expectTiles(*store,
                    damaged.level > 0 ? edited_ : std::vector<ChunkRow>{edited_.begin() + 1, edited_.end()});
    }
}

// derive() reads a damaged sibling: its rows are only right after all are derived again.
TEST_F(SqliteDerivedRowsTest, DamageThatDeriveMeetsTakesTheMark) {
    makeSave();
    runSql(path_, fmt::format("UPDATE chunks SET data = zeroblob(60) WHERE key = {}", keyOf({0, 0, 1})));
    {
        const auto store = open();
        store->save({2, 0}, numberedChunk(4), Provenance::Edited);
        ASSERT_TRUE(store->flush());
        EXPECT_TRUE(store->contains({1, 0, 1}));
        EXPECT_EQ(store->metadata(kDerivedRowsMark), std::nullopt);
    }
    const auto store = open();
    EXPECT_EQ(ensureDerivedRows(*store, "sums"), true);
    std::vector<ChunkRow> edited = edited_;
    edited.push_back({{2, 0}, numberedChunk(4)});
    expectTiles(*store, edited);
}

TEST_F(SqliteDerivedRowsTest, AReaderTellsEditedChunks) {
    makeSave();
    const auto reader = SqliteReader::open(path_, registry_);
    ASSERT_TRUE(reader);
    EXPECT_THAT(*(*reader)->editedChunks(), ElementsAre(ChunkPos{0, 0}, ChunkPos{1, 0}, ChunkPos{6, -7}));
}

TEST_F(SqliteDerivedRowsTest, TheCheckCountsTiles) {
    makeSave();
    const auto report = checkSave(path_, registry_);
    ASSERT_TRUE(report);
    EXPECT_FALSE(report->isDamaged());
    EXPECT_EQ(report->tiles, 4u);
    EXPECT_EQ(report->editedChunks, 3u);
    EXPECT_EQ(report->chunks, 8u);
}

TEST_F(SqliteDerivedRowsTest, OnlyTilesAreDerived) {
    const auto store = open();
    store->save({0, 0}, numberedChunk(1), Provenance::Edited);
    ASSERT_TRUE(store->flush());
    store->setDerivedRows({[](std::span<const ChunkRow>, const ReadEdited&) {
                               return std::vector<ChunkRow>{{{0, 0}, numberedChunk(9)}};
                           },
                           {}});
    store->save({1, 0}, numberedChunk(2), Provenance::Edited);
    const auto saved = store->flush();
    ASSERT_FALSE(saved);
    EXPECT_THAT(saved.error().message, HasSubstr("chunk 0,0 of level 0 follows from no others"));
    EXPECT_EQ(*store->load({0, 0}).chunk, *numberedChunk(1));
    store->setDerivedRows({deriveSums, {}});
    EXPECT_TRUE(store->flush()) << "nothing is lost";
}

}  // namespace
}  // namespace terrane::store

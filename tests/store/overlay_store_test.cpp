#include "terrane/store/overlay_store.h"

#include <gmock/gmock.h>

#include "tests/store/store_fixture.h"
#include "tests/store/tile_sums.h"

namespace terrane::store {
namespace {

using testing::ElementsAre;
using world::ChunkPos;

// An overlay over a world with two edited chunks and their tiles.
class OverlayStoreTest : public testing::Test {
  protected:
    void SetUp() override {
        auto below = std::make_unique<MemoryStore>(kIdentity, kNever);
        below->setDerivedRows({deriveSums, {}});
        ASSERT_TRUE(ensureDerivedRows(*below, "sums"));
        below->save({0, 0}, numberedChunk(1), Provenance::Edited);
        below->save({2, 0}, numberedChunk(2), Provenance::Edited);
        ASSERT_TRUE(below->flush());
        below_ = below.get();
        store_ = std::make_unique<OverlayStore>(std::move(below), kNever);
        store_->setDerivedRows({deriveSums, {}});
    }
    void save(ChunkPos pos, world::ChunkPtr chunk) {
        store_->save(pos, std::move(chunk), Provenance::Edited);
        ASSERT_TRUE(store_->flush());
    }
    void expectTiles(const std::vector<ChunkRow>& edited) {
        const TileMap expected = tilesOf(edited);
        for (const ChunkPos pos : {ChunkPos{0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 0, 2}}) {
            const auto tile = expected.find(pos);
            const LoadedChunk loaded = store_->load(pos);
            ASSERT_EQ(loaded.chunk != nullptr, tile != expected.end()) << nameOf(pos);
            EXPECT_EQ(store_->contains(pos), loaded.chunk != nullptr) << nameOf(pos);
            if (loaded.chunk) {
                EXPECT_EQ(*loaded.chunk, *tile->second) << nameOf(pos);
            }
        }
    }

    MemoryStore* below_ = nullptr;
    std::unique_ptr<OverlayStore> store_;
    const world::ChunkPtr none_ = std::make_shared<world::Chunk>();
};

TEST_F(OverlayStoreTest, TilesFollowFromChunksOfBoth) {
    expectTiles({{{0, 0}, numberedChunk(1)}, {{2, 0}, numberedChunk(2)}});
    EXPECT_EQ(ensureDerivedRows(*store_, "sums"), false) << "the world below has them";
    save({1, 1}, numberedChunk(3));
    expectTiles({{{0, 0}, numberedChunk(1)}, {{2, 0}, numberedChunk(2)}, {{1, 1}, numberedChunk(3)}});
    save({2, 0}, numberedChunk(4));
    expectTiles({{{0, 0}, numberedChunk(1)}, {{2, 0}, numberedChunk(4)}, {{1, 1}, numberedChunk(3)}});
    EXPECT_THAT(*store_->editedChunks(), ElementsAre(ChunkPos{0, 0}, ChunkPos{1, 1}, ChunkPos{2, 0}));
    EXPECT_THAT(*below_->editedChunks(), ElementsAre(ChunkPos{0, 0}, ChunkPos{2, 0}));
}

TEST_F(OverlayStoreTest, DeletedRowsHideThoseBelow) {
    save({0, 0}, none_);
    EXPECT_FALSE(store_->contains({0, 0, 1}));
    EXPECT_TRUE(below_->contains({0, 0, 1}));
    expectTiles({{{2, 0}, numberedChunk(2)}});
    save({2, 0}, none_);
    expectTiles({});
    const ChunkPos positions[] = {{0, 0, 2}, {0, 0}, {1, 0, 1}};
    const auto many = store_->loadMany(positions);
    EXPECT_EQ(many[0].state, LoadedChunk::State::Absent);
    EXPECT_EQ(many[1].state, LoadedChunk::State::Present);
    EXPECT_EQ(many[2].state, LoadedChunk::State::Absent);
}

TEST_F(OverlayStoreTest, DerivesAllFromBoth) {
    save({3, 3}, numberedChunk(3));
    below_->save({40, 40, 1}, numberedChunk(1), Provenance::Edited);
    below_->save({0, 0, 1}, numberedChunk(1), Provenance::Edited);
    ASSERT_TRUE(below_->flush());
    EXPECT_TRUE(store_->contains({40, 40, 1}));
    ASSERT_TRUE(store_->deriveAll("sums"));
    EXPECT_FALSE(store_->contains({40, 40, 1})) << "all rows below that count as derived are hidden";
    expectTiles({{{0, 0}, numberedChunk(1)}, {{2, 0}, numberedChunk(2)}, {{3, 3}, numberedChunk(3)}});
    EXPECT_TRUE(below_->contains({40, 40, 1}));
}

TEST_F(OverlayStoreTest, EditsWithoutTilesHideTheMark) {
    EXPECT_EQ(store_->metadata(kDerivedRowsMark), "sums");
    store_->setDerivedRows({});
    save({3, 3}, numberedChunk(3));
    EXPECT_EQ(store_->metadata(kDerivedRowsMark), std::nullopt);
    EXPECT_EQ(below_->metadata(kDerivedRowsMark), "sums");
}

TEST_F(OverlayStoreTest, GeneratedNeverReplacesEditedOfBelow) {
    store_->save({0, 0}, numberedChunk(7), Provenance::Generated);
    for (int round = 0; round < 2; ++round) {
        EXPECT_EQ(*store_->load({0, 0}).chunk, *numberedChunk(1));
        EXPECT_EQ(store_->load({0, 0}).provenance, Provenance::Edited);
        ASSERT_TRUE(store_->flush());
    }
}

}  // namespace
}  // namespace terrane::store

// Tiles of edited chunks, from the store to the meshes of the view.
#include "terrane/stream/edited_tiles.h"

#include <gtest/gtest.h>

#include <map>

#include "terrane/gen/generators/catalogue.h"
#include "terrane/mesh/chunk_mesher.h"
#include "terrane/store/overlay_store.h"
#include "tests/world/content_blocks.h"

namespace terrane::stream {
namespace {

using world::ChunkPos;

constexpr ChunkPos kEdited{-30, 21};  // beyond the chunks of the view below

class TileRowsTest : public testing::Test {
  protected:
    void keepRows(TileListener listener) {
        maintainTileRows(store_, generators_, contentBlocks(), std::move(listener));
        ASSERT_TRUE(buildTileRows(store_));
    }

    // The chunk with a roof of lamps over it, or as generated, saved as edited either way.
    void saveChunk(bool hasRoof) {
        auto chunk = std::make_shared<world::Chunk>(generators_.generate(kEdited));
        for (int n = 0; hasRoof && n < 256; ++n)
            chunk->setBlock(world::blockIndex(n % 16, n / 16, 150), contentBlock("lamp_red"));
        store_.save(kEdited, chunk, store::Provenance::Edited);
        ASSERT_TRUE(store_.flush());
    }

    // Updates until all tiles are there.
    void settle(TilePipeline& tiles, mesh::MergeMethod method = mesh::MergeMethod::Greedy) {
        do {
            tiles.waitForWorkers(std::chrono::milliseconds(100));
            tiles.update(method);
            for (const TileMesh& tile : tiles.takeMeshes(1000)) {
                meshes_[tile.pos] = tile.mesh;
                ++made_;
            }
            for (const ChunkPos pos : tiles.takeChanges().dropped) meshes_.erase(pos);
        } while (tiles.missing() > 0);
    }

    MeshPtr meshOf(ChunkPos tile) { return makeTile(parts_, tile, mesh::MergeMethod::Greedy).mesh; }

    base::JobSystem jobs_{2};
    gen::LevelGenerators generators_{
        [](int level) { return gen::makeGenerator("flat", contentBlocks(), level); }, 5};
    store::MemoryStore store_{store::WorldIdentity{5, "flat", 1}};
    TileParts parts_{jobs_, contentBlocks(), generators_, &store_};
    std::map<ChunkPos, MeshPtr> meshes_;
    int made_ = 0;
};

TEST_F(TileRowsTest, ComeWithTheEditedChunk) {
    keepRows([](auto) {});
    ChunkPos tile = kEdited;
    saveChunk(true);
    for (int level = 1; level <= 6; ++level) {
        tile = parentOf(tile);
        const store::LoadedChunk loaded = store_.load(tile);
        ASSERT_TRUE(loaded.chunk) << "level " << level;
        EXPECT_FALSE(*loaded.chunk == generators_.generate(tile));
    }
    saveChunk(false);
    for (tile = parentOf(kEdited); tile.level <= 6; tile = parentOf(tile))
        EXPECT_FALSE(store_.contains(tile));
}

TEST_F(TileRowsTest, AreBuiltForAWorldWithoutThem) {
    saveChunk(true);
    EXPECT_FALSE(store_.contains(parentOf(kEdited)));
    keepRows([](auto) {});
    EXPECT_TRUE(store_.contains(parentOf(kEdited)));
}

TEST_F(TileRowsTest, TilesInViewAreMadeAgain) {
    TilePipeline tiles(parts_);
    keepRows(tiles.tileListener());
    tiles.setView({{0, 0}, 4, 64, 8});
    settle(tiles);
    const auto before = meshes_;
    const int made = made_;

    saveChunk(true);
    settle(tiles);
    EXPECT_GT(made_, made);
    EXPECT_LT(made_, made + 8) << "others stay as they are";
    int changed = 0;
    for (const auto& [pos, mesh] : meshes_) {
        EXPECT_EQ(*mesh, *meshOf(pos)) << pos.x << ',' << pos.y;
        changed += !(*mesh == *before.at(pos));
    }
    EXPECT_GE(changed, 1);

    saveChunk(false);
    settle(tiles);
    for (const auto& [pos, mesh] : meshes_) EXPECT_EQ(*mesh, *before.at(pos)) << pos.x << ',' << pos.y;
}

// A mesh that was made before the edit and is kept while the view is elsewhere is not shown after it.
TEST_F(TileRowsTest, WhatWasMadeBeforeAnEditIsNotTakenAfterIt) {
    TilePipeline tiles(parts_);
    keepRows(tiles.tileListener());
    const TileView here{{-36, 21}, 4, 64, 8}, elsewhere{{100000, 0}, 4, 64, 8};
    tiles.setView(here);
    tiles.takeChanges();
    do {
        tiles.update(mesh::MergeMethod::Greedy);
        tiles.waitForWorkers(std::chrono::milliseconds(100));
    } while (tiles.taskTime().count < tiles.missing());
    tiles.update(mesh::MergeMethod::Greedy);
    tiles.setView(elsewhere);
    tiles.takeChanges();
    saveChunk(true);
    tiles.update(mesh::MergeMethod::Greedy);
    tiles.setView(here);
    tiles.takeChanges();
    settle(tiles);
    for (const auto& [pos, mesh] : meshes_) EXPECT_EQ(*mesh, *meshOf(pos)) << pos.x << ',' << pos.y;
}

// Saving works if a generator has no levels above 0.
TEST_F(TileRowsTest, AGeneratorWithoutLevelsHasNone) {
    const gen::LevelGenerators flat(
        [](int level) -> base::Result<gen::GeneratorGraph> {
            if (level > 0) return base::fail("only level 0");
            return gen::makeGenerator("flat", contentBlocks());
        },
        5);
    maintainTileRows(store_, flat, contentBlocks(), {});
    saveChunk(true);
    EXPECT_TRUE(store_.contains(kEdited));
    EXPECT_FALSE(store_.contains(parentOf(kEdited)));
    store_.setDerivedRows({});
}

TEST_F(TileRowsTest, AnotherMergingMethodReachesAllTiles) {
    TilePipeline tiles(parts_);
    tiles.setView({{0, 0}, 4, 64, 8});
    settle(tiles);
    settle(tiles, mesh::MergeMethod::None);
    for (const auto& [pos, mesh] : meshes_)
        EXPECT_EQ(*mesh, *makeTile(parts_, pos, mesh::MergeMethod::None).mesh) << pos.x << ',' << pos.y;
}

}  // namespace
}  // namespace terrane::stream

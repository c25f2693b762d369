#include "terrane/stream/tile_pipeline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <future>
#include <set>

#include "terrane/gen/generators/catalogue.h"
#include "terrane/mesh/chunk_mesher.h"
#include "tests/world/content_blocks.h"

namespace terrane::stream {
namespace {

using world::ChunkPos;

class TilePipelineTest : public testing::Test {
  protected:
    // Updates until all tiles are there, as frames do.
    void settle(TilePipeline& tiles) {
        for (;;) {
            tiles.update(mesh::MergeMethod::Greedy);
            for (const TileMesh& tile : tiles.takeMeshes(1000)) {
                meshes_[tile.pos] = tile.mesh;
                ++made_;
            }
            const TileChanges changes = tiles.takeChanges();
            for (const ChunkPos pos : changes.hidden) shown_.erase(pos);
            for (const ChunkPos pos : changes.shown) shown_.insert(pos);
            for (const ChunkPos pos : changes.dropped) meshes_.erase(pos);
            if (tiles.missing() == 0) return;
            tiles.waitForWorkers(std::chrono::milliseconds(100));
        }
    }

    base::JobSystem jobs_{2};
    gen::LevelGenerators generators_{
        [](int level) { return gen::makeGenerator("flat", contentBlocks(), level); }, 5};
    TileParts parts_{jobs_, contentBlocks(), generators_};
    std::map<ChunkPos, MeshPtr> meshes_;
    std::set<ChunkPos> shown_;
    std::size_t made_ = 0;
};

TEST_F(TilePipelineTest, MakesWhatTheViewShows) {
    TilePipeline tiles(parts_);
    tiles.setView({{3, -4}, 4, 64, 8});
    settle(tiles);
    EXPECT_GT(shown_.size(), 100u);
    for (const ChunkPos pos : shown_) ASSERT_TRUE(meshes_.contains(pos));
    for (const auto& [pos, mesh] : meshes_) {
        EXPECT_EQ(*mesh, *makeTile(parts_, pos, mesh::MergeMethod::Greedy).mesh) << pos.x << ' ' << pos.y;
    }
}

TEST_F(TilePipelineTest, ForgetsWhatTheViewLeft) {
    TilePipeline tiles(parts_);
    tiles.setView({{0, 0}, 4, 64, 8});
    settle(tiles);
    const std::size_t count = meshes_.size();
    tiles.setView({{5000, 0}, 4, 64, 8});
    settle(tiles);
    EXPECT_LT(meshes_.size(), 2 * count);
    tiles.setView({{5000, 0}, 4, 0, 8});
    settle(tiles);
    EXPECT_TRUE(meshes_.empty());
    EXPECT_TRUE(shown_.empty());
}

// A tile for which there is no room is not shown, and comes again.
TEST_F(TilePipelineTest, WhatIsPutBackComesAgain) {
    TilePipeline tiles(parts_);
    tiles.setView({{3, -4}, 4, 64, 8});
    settle(tiles);
    const std::set<ChunkPos> all = shown_;
    const ChunkPos lost = *std::ranges::find_if(all, [](ChunkPos pos) { return pos.level > 0; });
    tiles.setView({{3, -4}, 4, 0, 8});
    settle(tiles);
    tiles.setView({{3, -4}, 4, 64, 8});
    int putBack = 0;
    while (putBack < 3 || tiles.missing() > 0) {
        tiles.waitForWorkers(std::chrono::milliseconds(100));
        tiles.update(mesh::MergeMethod::Greedy);
        for (TileMesh& tile : tiles.takeMeshes(1000)) {
            if (tile.pos != lost || putBack == 3) continue;
            ++putBack;
            tiles.putBack(std::move(tile));
        }
        tiles.takeChanges();
        ASSERT_TRUE(putBack == 3 || !tiles.table().records.contains(lost) ||
                    !tiles.table().records.at(lost).isShown);
    }
    EXPECT_TRUE(tiles.table().records.at(lost).isShown);
}

// The view moves away while the only worker is busy: earlier requests are not made.
TEST_F(TilePipelineTest, TilesThatAreNoLongerRequestedAreNotMade) {
    base::JobSystem jobs(1);
    TilePipeline tiles({jobs, contentBlocks(), generators_});
    std::promise<void> released;
    jobs.submit(-100, [wait = released.get_future().share()] { wait.wait(); });
    std::size_t given = 0;
    for (const int x : {0, 100000}) {
        tiles.setView({{x, 0}, 4, 64, 8});
        for (int frame = 0; frame < 3; ++frame) {
            tiles.update(mesh::MergeMethod::Greedy);
            tiles.takeChanges();
        }
        given += tiles.table().loading;
    }
    EXPECT_GT(given, 100u) << "tiles of both places were given out";
    released.set_value();
    settle(tiles);
    std::size_t taken = 0;
    for (const auto& [pos, mesh] : meshes_) taken += tileDistance({100000, 0}, pos) < 1000 ? 1 : 0;
    EXPECT_EQ(taken, meshes_.size());
    EXPECT_EQ(tiles.taskTime().count, made_);
}

TEST_F(TilePipelineTest, AJobThatThrowsIsHeardOf) {
    const gen::LevelGenerators none([](int) -> base::Result<gen::GeneratorGraph> { return base::fail("no"); },
                                    5);
    TilePipeline tiles({jobs_, contentBlocks(), none});
    tiles.setView({{0, 0}, 4, 64, 8});
    EXPECT_ANY_THROW(settle(tiles));
}

}  // namespace
}  // namespace terrane::stream

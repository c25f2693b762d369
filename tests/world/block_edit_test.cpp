#include "terrane/world/changes/block_edit.h"

#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <thread>

#include "tests/world/content_blocks.h"

namespace terrane::world {

namespace {

class BlockEditTest : public testing::Test {
  protected:
    BlockEditTest() { world_.insert({0, 0}, std::make_shared<Chunk>()); }
    std::vector<BlockEdit> change(BlockPos pos, const BlockChange& what) {
        std::vector<BlockEdit> edits;
        applyChange(world_, contentBlocks(), pos, what, edits);
        return edits;
    }
    std::vector<BlockEdit> put(BlockPos pos, std::string_view name) {
        return change(pos, SetBlock{contentBlock(name)});
    }
    World world_;
};

using Edits = std::vector<BlockEdit>;

TEST_F(BlockEditTest, ABlockIsPutAndTaken) {
    EXPECT_EQ(put({1, 2, 3}, "stone"), (Edits{{{1, 2, 3}, kAir, contentBlock("stone")}}));
    EXPECT_EQ(put({1, 2, 3}, "stone"), Edits{}) << "it is there already";
    EXPECT_EQ(put({1, 2, 3}, "air"), (Edits{{{1, 2, 3}, contentBlock("stone"), kAir}}));
}

TEST_F(BlockEditTest, ABlockIsPutWithItsState) {
    EXPECT_EQ(change({1, 2, 3}, SetBlock{contentBlock("stone"), 5}).size(), 1u);
    EXPECT_EQ(world_.blockState({1, 2, 3}), 5);
    EXPECT_EQ(change({1, 2, 3}, SetBlock{contentBlock("stone"), 5}), Edits{}) << "it is there already";
    EXPECT_EQ(change({1, 2, 3}, SetBlock{contentBlock("stone"), 6}).size(), 1u);
    EXPECT_EQ(world_.blockState({1, 2, 3}), 6);
}

TEST_F(BlockEditTest, NothingOutsideOfWhatIsLoaded) {
    EXPECT_EQ(put({100, 2, 3}, "stone"), Edits{});
    EXPECT_EQ(put({1, 2, 256}, "stone"), Edits{});
    EXPECT_EQ(put({1, 2, -1}, "stone"), Edits{});
}

TEST_F(BlockEditTest, APlantFallsWithItsGround) {
    put({1, 2, 3}, "grass");
    put({1, 2, 4}, "poppy");
    const Edits expected = {{{1, 2, 3}, contentBlock("grass"), kAir},
                            {{1, 2, 4}, contentBlock("poppy"), kAir}};
    EXPECT_EQ(put({1, 2, 3}, "air"), expected);
    EXPECT_EQ(world_.block({1, 2, 4}), kAir);
}

TEST_F(BlockEditTest, AChangeHasNoConsequencesWhereItMayNotReach) {
    put({1, 2, 3}, "grass");
    put({1, 2, 4}, "poppy");
    std::vector<std::pair<BlockPos, BlockPos>> asked;
    const MayReach never = [&](BlockPos from, BlockPos to) {
        asked.emplace_back(from, to);
        return false;
    };
    Edits edits;
    applyChange(world_, contentBlocks(), {1, 2, 3}, SetBlock{}, edits, nullptr, &never);
    EXPECT_EQ(edits.size(), 1u);
    EXPECT_EQ(world_.block({1, 2, 4}), contentBlock("poppy"));
    EXPECT_EQ(asked.size(), 6u);
    for (const auto& [from, to] : asked) EXPECT_EQ(from, (BlockPos{1, 2, 3}));
}

TEST_F(BlockEditTest, AColumnOfCactusFallsAndWhatStandsByItselfStays) {
    put({1, 2, 2}, "stone");
    put({1, 2, 3}, "sand");
    for (int z = 4; z < 7; ++z) put({1, 2, z}, "cactus");
    put({1, 2, 7}, "stone");
    EXPECT_EQ(put({1, 2, 4}, "air").size(), 3u);
    EXPECT_EQ(world_.block({1, 2, 6}), kAir);
    EXPECT_EQ(world_.block({1, 2, 7}), contentBlock("stone"));
}

TEST_F(BlockEditTest, ReplacingTheGroundByOtherGroundKeepsThePlant) {
    put({1, 2, 3}, "grass");
    put({1, 2, 4}, "poppy");
    EXPECT_EQ(put({1, 2, 3}, "dirt").size(), 1u);
    EXPECT_EQ(world_.block({1, 2, 4}), contentBlock("poppy"));
}

TEST_F(BlockEditTest, WheatIsPlacedYoungAndOtherBlocksWithoutData) {
    put({1, 2, 3}, "dirt");
    put({1, 2, 4}, "wheat");
    EXPECT_EQ(world_.blockState({1, 2, 3}), 0);
    EXPECT_EQ(world_.blockState({1, 2, 4}), 3);
    put({1, 2, 4}, "poppy");
    EXPECT_EQ(world_.blockState({1, 2, 4}), 0);
}

TEST_F(BlockEditTest, APlantIsNotPlacedWithoutGround) {
    EXPECT_EQ(put({1, 2, 9}, "poppy"), Edits{});
    EXPECT_EQ(world_.block({1, 2, 9}), kAir);
}

// State and data of blocks: events have the same block before and after.
TEST_F(BlockEditTest, DataOfBlocks) {
    const BlockPos pos{5, 7, 100}, above{5, 7, 256};
    const BlockId chest = contentBlock("chest");
    const BlockEntityData text{std::byte{'a'}, std::byte{'b'}};
    put(pos, "chest");
    EXPECT_EQ(change({100, 7, 3}, SetState{1}), Edits{}) << "not loaded";
    EXPECT_EQ(change(above, SetState{1}), Edits{});
    EXPECT_EQ(change(above, SetEntityData{text}), Edits{});
    EXPECT_EQ(change(pos, SetState{7}), (Edits{{pos, chest, chest}}));
    EXPECT_EQ(world_.blockState(pos), 7);
    const ChunkPtr before = world_.maybeChunkAt({0, 0});
    EXPECT_EQ(change(pos, SetEntityData{text}), (Edits{{pos, chest, chest}}));
    ASSERT_NE(world_.blockEntityData(pos), nullptr);
    EXPECT_EQ(*world_.blockEntityData(pos), text);
    EXPECT_EQ(before->blockEntityData(blockIndex(pos)), nullptr) << "a snapshot stays as it is";
    put(pos, "stone");
    EXPECT_EQ(world_.blockEntityData(pos), nullptr) << "gone with the block";
    EXPECT_EQ(world_.blockState(pos), 0);
}

TEST_F(BlockEditTest, SnapshotsStayAsTheyWere) {
    put({1, 1, 1}, "stone");
    const ChunkPtr snapshot = world_.maybeChunkAt({0, 0});
    put({1, 1, 1}, "dirt");
    put({2, 1, 1}, "stone");
    EXPECT_EQ(snapshot->block(blockIndex(1, 1, 1)), contentBlock("stone"));
    EXPECT_EQ(snapshot->block(blockIndex(2, 1, 1)), kAir);
    EXPECT_EQ(world_.block({1, 1, 1}), contentBlock("dirt"));
    EXPECT_NE(world_.maybeChunkAt({0, 0}), snapshot);
}

TEST_F(BlockEditTest, AnUnsharedChunkIsNotCopied) {
    const Chunk* before = world_.maybeChunkAt({0, 0}).get();
    put({1, 1, 1}, "stone");
    EXPECT_EQ(world_.maybeChunkAt({0, 0}).get(), before);
}

// A worker reads a snapshot and releases it; from then on edits write to that chunk. Thread sanitizers check
// that the reads are ordered before the writes: `done` itself orders nothing.
TEST_F(BlockEditTest, EditsOfAChunkThatAWorkerHasRead) {
    for (int round = 1; round <= 200; ++round) {
        std::atomic<bool> done = false;
        std::thread worker([&done, snapshot = world_.maybeChunkAt({0, 0})]() mutable {
            EXPECT_EQ(snapshot->block(0), snapshot->block(1));
            snapshot.reset();
            done.store(true, std::memory_order_relaxed);
        });
        if (round % 2 == 0)
            while (!done.load(std::memory_order_relaxed)) std::this_thread::yield();
        for (const std::int32_t x : {0, 1}) put({x, 0, 0}, round % 2 == 0 ? "stone" : "sand");
        worker.join();
        EXPECT_EQ(world_.block({1, 0, 0}), contentBlock(round % 2 == 0 ? "stone" : "sand"));
    }
}

TEST_F(BlockEditTest, ABlockMovedToItsOwnPlaceStays) {
    change({1, 2, 3}, SetBlock{contentBlock("stone"), 5});
    Edits edits;
    BlockUpdate update(world_, contentBlocks(), edits);
    update.move({1, 2, 3}, {1, 2, 3});
    update.run();
    EXPECT_EQ(edits, Edits{});
    EXPECT_EQ(world_.block({1, 2, 3}), contentBlock("stone"));
    EXPECT_EQ(world_.blockState({1, 2, 3}), 5);
}

}  // namespace
}  // namespace terrane::world

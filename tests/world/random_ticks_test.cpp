#include "terrane/world/changes/random_ticks.h"

#include <gtest/gtest.h>

#include <memory>
#include <set>

#include "terrane/world/changes/block_edit.h"
#include "tests/world/content_blocks.h"
#include "tests/world/put_block.h"

namespace terrane::world {
namespace {

class RandomTicksTest : public testing::Test {
  protected:
    RandomTicksTest() {
        for (int n = 0; n < 9; ++n) world_.insert({n % 3 - 1, n / 3 - 1}, std::make_shared<Chunk>());
    }
    void plantAt(BlockPos ground, std::string_view name) {
        std::vector<BlockEdit> edits;
        const BlockPos above{ground.x, ground.y, ground.z + 1};
        applyChange(world_, contentBlocks(), ground, SetBlock{contentBlock("dirt")}, edits);
        applyChange(world_, contentBlocks(), above, SetBlock{contentBlock(name)}, edits);
    }
    // Runs ticks until `stages` are grown; returns how many were needed.
    std::uint64_t grow(std::uint64_t stages, std::uint64_t timeout) {
        for (std::uint64_t tick = 0; tick < timeout; ++tick) {
            if (stages == 0) return tick;
            for (const BlockPos pos : blocksToTick(world_, contentBlocks(), tick, chunksWithin({0, 0}, 1))) {
                std::vector<BlockEdit> edits;
                applyChange(world_, contentBlocks(), pos, RunTick{}, edits);
                EXPECT_EQ(edits.size(), 1u);
                --stages;
            }
        }
        return timeout;
    }
    World world_;
};

TEST_F(RandomTicksTest, WheatGrowsThroughItsStages) {
    plantAt({4, 5, 60}, "wheat");
    ASSERT_EQ(world_.blockState({4, 5, 61}), 3);
    // Three stages of 4096 / 3 ticks on average.
    const std::uint64_t ticks = grow(3, 60000);
    EXPECT_GT(ticks, 200u);
    EXPECT_LT(ticks, 40000u);
    EXPECT_EQ(world_.block({4, 5, 61}), contentBlock("wheat"));
    EXPECT_EQ(world_.blockState({4, 5, 61}), 0);
}

TEST_F(RandomTicksTest, EveryPlaceHasItsTurn) {
    for (int x = 0; x < 16; ++x)
        for (int y = -16; y < 0; ++y) plantAt({x, y, 30}, "wheat");
    EXPECT_LT(grow(3 * 256, 60000), 60000u);
}

TEST_F(RandomTicksTest, OtherBlocksKeepTheirData) {
    putBlock(world_, {1, 1, 50}, contentBlock("stone"));
    putState(world_, {1, 1, 50}, 7);
    grow(1, 3000);
    EXPECT_EQ(world_.blockState({1, 1, 50}), 7);
}

TEST_F(RandomTicksTest, TheSameTickGrowsTheSamePlantsOnce) {
    for (int x = 0; x < 16; ++x)
        for (int y = 0; y < 16; ++y) plantAt({x, y, 30}, "wheat");
    std::size_t count = 0;
    for (std::uint64_t tick = 0; tick < 200; ++tick) {
        const auto growing = blocksToTick(world_, contentBlocks(), tick, chunksWithin({0, 0}, 1));
        EXPECT_EQ(growing, blocksToTick(world_, contentBlocks(), tick, chunksWithin({0, 0}, 1)));
        EXPECT_EQ(std::set(growing.begin(), growing.end()).size(), growing.size());
        count += growing.size();
    }
    // 200 ticks × 3 picks × 256 / 4096.
    EXPECT_NEAR(static_cast<double>(count), 37.5, 20);
}

}  // namespace
}  // namespace terrane::world

#include "terrane/world/block_update.h"

#include <gtest/gtest.h>

#include <memory>

#include "tests/world/content_blocks.h"

namespace terrane::world {

inline bool operator==(const BlockUpdate& a, const BlockUpdate& b) {
    return a.pos == b.pos && a.before == b.before;
}

namespace {

class BlockUpdateTest : public testing::Test {
  protected:
    BlockUpdateTest() { world_.insert({0, 0}, std::make_shared<Chunk>()); }
    std::vector<BlockUpdate> put(BlockPos pos, std::string_view name) {
        return updateBlock(world_, contentBlocks(), pos, name == "air" ? kAir : contentBlock(name));
    }
    World world_;
};

using Updates = std::vector<BlockUpdate>;

TEST_F(BlockUpdateTest, ABlockIsPutAndTaken) {
    EXPECT_EQ(put({1, 2, 3}, "stone"), (Updates{{{1, 2, 3}, kAir}}));
    EXPECT_EQ(put({1, 2, 3}, "stone"), Updates{}) << "it is there already";
    EXPECT_EQ(put({1, 2, 3}, "air"), (Updates{{{1, 2, 3}, contentBlock("stone")}}));
}

TEST_F(BlockUpdateTest, NothingOutsideOfWhatIsLoaded) {
    EXPECT_EQ(put({100, 2, 3}, "stone"), Updates{});
    EXPECT_EQ(put({1, 2, 256}, "stone"), Updates{});
    EXPECT_EQ(put({1, 2, -1}, "stone"), Updates{});
}

TEST_F(BlockUpdateTest, APlantFallsWithItsGround) {
    put({1, 2, 3}, "grass");
    put({1, 2, 4}, "poppy");
    const Updates expected = {{{1, 2, 3}, contentBlock("grass")}, {{1, 2, 4}, contentBlock("poppy")}};
    EXPECT_EQ(put({1, 2, 3}, "air"), expected);
    EXPECT_EQ(world_.block({1, 2, 4}), kAir);
}

TEST_F(BlockUpdateTest, AColumnOfCactusFallsAndWhatStandsByItselfStays) {
    put({1, 2, 3}, "sand");
    for (int z = 4; z < 7; ++z) put({1, 2, z}, "cactus");
    put({1, 2, 7}, "stone");
    EXPECT_EQ(put({1, 2, 4}, "air").size(), 3u);
    EXPECT_EQ(world_.block({1, 2, 6}), kAir);
    EXPECT_EQ(world_.block({1, 2, 7}), contentBlock("stone"));
}

TEST_F(BlockUpdateTest, ReplacingTheGroundByOtherGroundKeepsThePlant) {
    put({1, 2, 3}, "grass");
    put({1, 2, 4}, "poppy");
    EXPECT_EQ(put({1, 2, 3}, "dirt").size(), 1u);
    EXPECT_EQ(world_.block({1, 2, 4}), contentBlock("poppy"));
}

TEST_F(BlockUpdateTest, WheatIsPlacedYoungAndOtherBlocksWithoutData) {
    put({1, 2, 3}, "dirt");
    put({1, 2, 4}, "wheat");
    EXPECT_EQ(world_.smallData({1, 2, 3}), 0);
    EXPECT_EQ(world_.smallData({1, 2, 4}), 3);
    put({1, 2, 4}, "poppy");
    EXPECT_EQ(world_.smallData({1, 2, 4}), 0);
}

TEST_F(BlockUpdateTest, APlantIsNotPlacedWithoutGround) {
    EXPECT_EQ(put({1, 2, 9}, "poppy"), Updates{});
    EXPECT_EQ(world_.block({1, 2, 9}), kAir);
}

}  // namespace
}  // namespace terrane::world

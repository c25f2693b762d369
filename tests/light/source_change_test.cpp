#include "terrane/light/relight_internal.h"

#include <gtest/gtest.h>

#include "tests/light/test_area.h"

namespace terrane::light {
namespace {

using world::blockIndex;
using world::Chunk;

std::vector<SourceChange> changesOf(const Chunk& chunk, std::vector<BlockChange> changes) {
    return findSourceChanges(chunk, changes, contentTable());
}

TEST(SourceChange, OfALampInTheDarkIsItself) {
    Chunk chunk;
    chunk.setBlock(blockIndex(3, 4, 200), contentBlock("stone"));
    chunk.setBlock(blockIndex(3, 4, 100), contentBlock("lamp_red"));
    const auto changes = changesOf(chunk, {{blockIndex(3, 4, 100), world::kAir}});
    ASSERT_EQ(changes.size(), 1u);
    EXPECT_EQ(changes[0].index, blockIndex(3, 4, 100));
    EXPECT_EQ(changes[0].sourceBefore, 0);
    EXPECT_EQ(changes[0].sourceAfter, 15);
    EXPECT_TRUE(changes[0].moreOpaque);
    EXPECT_TRUE(changes[0].isBlock);
}

TEST(SourceChange, ReachesDownToTheGround) {
    Chunk chunk;
    chunk.setBlock(blockIndex(0, 0, 90), contentBlock("stone"));
    chunk.setBlock(blockIndex(0, 0, 100), contentBlock("oak_leaves"));
    const auto changes = changesOf(chunk, {{blockIndex(0, 0, 100), world::kAir}});
    ASSERT_EQ(changes.size(), 10u);  // z = 100 … 91
    for (const SourceChange& change : changes) {
        EXPECT_EQ(change.sourceBefore, 15 << 12);
        EXPECT_EQ(change.sourceAfter, 12 << 12);
        EXPECT_EQ(change.isBlock, change.index >> 8 == 100);
    }
    EXPECT_EQ(changes.back().index, blockIndex(0, 0, 91));
}

TEST(SourceChange, OfTwoBlocksInAColumnMayCancel) {
    Chunk chunk;  // leaves moved down from 100 to 95
    chunk.setBlock(blockIndex(9, 9, 95), contentBlock("oak_leaves"));
    const auto changes = changesOf(
        chunk, {{blockIndex(9, 9, 95), world::kAir}, {blockIndex(9, 9, 100), contentBlock("oak_leaves")}});
    ASSERT_EQ(changes.size(), 6u);
    EXPECT_EQ(changes.front().sourceAfter, 15 << 12);
    EXPECT_FALSE(changes.front().moreOpaque);
    EXPECT_EQ(changes.back().index, blockIndex(9, 9, 95));
    EXPECT_EQ(changes.back().sourceBefore, changes.back().sourceAfter);
    EXPECT_TRUE(changes.back().moreOpaque);
}

TEST(SourceChange, ReachesTheBottomOfATallWorld) {
    const Chunk chunk({-2048, 2048});
    const auto changes = changesOf(chunk, {{blockIndex(7, 0, 2000), contentBlock("water")}});
    ASSERT_EQ(changes.size(), 2000u + 2048u + 1u);
    EXPECT_EQ(changes.front().index, blockIndex(7, 0, 2000));
    EXPECT_EQ(changes.back().index, blockIndex(7, 0, -2048));
}

// Sections without blocks and the dark below the ground are passed over.
TEST(SourceChange, OfDeepBlocksAreThemselves) {
    Chunk chunk({-1024, 1024});
    chunk.setBlock(blockIndex(3, 4, 17), contentBlock("oak_leaves"));
    chunk.setBlock(blockIndex(3, 4, -300), contentBlock("stone"));
    const auto changes = changesOf(chunk, {{blockIndex(3, 4, -900), contentBlock("lamp_red")},
                                           {blockIndex(3, 4, -400), contentBlock("stone")},
                                           {blockIndex(3, 4, 5), contentBlock("oak_leaves")}});
    ASSERT_EQ(changes.size(), 1 + (5 + 300) - 1 + 2u);
    EXPECT_EQ(changes.front().index, blockIndex(3, 4, 5));
    EXPECT_EQ(changes.front().sourceBefore, 9 << 12);
    EXPECT_EQ(changes.front().sourceAfter, 12 << 12);
    EXPECT_EQ(changes[changes.size() - 2].index, blockIndex(3, 4, -400));
    EXPECT_EQ(changes.back().index, blockIndex(3, 4, -900));
    EXPECT_EQ(changes.back().sourceBefore, 15);
    EXPECT_EQ(changes.back().sourceAfter, kDark);
}

TEST(SourceChange, ReachesTheBottomOfTheWorld) {
    const Chunk chunk;
    const auto changes = changesOf(chunk, {{blockIndex(0, 0, 255), contentBlock("water")}});
    EXPECT_EQ(changes.size(), 256u);
    EXPECT_TRUE(changesOf(chunk, {}).empty());
}

}  // namespace
}  // namespace terrane::light

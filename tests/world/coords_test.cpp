#include "terrane/world/coords.h"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "tests/world/lowest_highest.h"

namespace terrane::world {
namespace {

TEST(Coords, ChunkOfFloors) {
    EXPECT_EQ(chunkOf(BlockPos{0, 15, 0}), (ChunkPos{0, 0}));
    EXPECT_EQ(chunkOf(BlockPos{16, 31, 0}), (ChunkPos{1, 1}));
    EXPECT_EQ(chunkOf(BlockPos{-1, -16, 0}), (ChunkPos{-1, -1}));
    EXPECT_EQ(chunkOf(BlockPos{-17, -32, 255}), (ChunkPos{-2, -2}));
    EXPECT_EQ(chunkOf(BlockPos{kLowest, kHighest, 0}), (ChunkPos{kMinChunk, kMaxChunk}));
}

TEST(Coords, IndexLayout) {
    EXPECT_EQ(blockIndex(1, 0, 0), 1);
    EXPECT_EQ(blockIndex(0, 1, 0), 16);
    EXPECT_EQ(blockIndex(0, 0, 1), 256);
    EXPECT_EQ(blockIndex(15, 15, 255), 65535);
    EXPECT_EQ(blockIndex(BlockPos{-1, -16, 2}), blockIndex(15, 0, 2));
}

TEST(Coords, RoundTripAtEdges) {
    for (const std::int32_t x : {kLowest, kLowest + 1, -17, -16, -1, 0, 1, 15, 16, kHighest - 1, kHighest})
        for (const std::int32_t y : {kLowest, -1, 0, kHighest})
            for (const std::int32_t z : {0, 1, 128, 255}) {
                const BlockPos p{x, y, z};
                EXPECT_EQ(blockPos(chunkOf(p), blockIndex(p)), p) << x << ' ' << y << ' ' << z;
                EXPECT_TRUE(isInWorld(chunkOf(p)));
            }
}

TEST(Coords, RoundTripOfEveryIndex) {
    const BlockIndex lowest = blockIndex(0, 0, kLowestBottom), end = blockIndex(0, 0, kHighestTop);
    for (BlockIndex index = lowest; index < end; ++index) {
        const BlockPos pos = blockPos({-3, 5}, index);
        ASSERT_EQ(blockIndex(pos), index);
        ASSERT_EQ(sectionOf(index), static_cast<int>(std::floor(pos.z / 16.0)));
        ASSERT_EQ(indexInSection(index), index - sectionOf(index) * kBlocksPerSection);
    }
}

TEST(Coords, Limits) {
    EXPECT_FALSE(isInWorld({kMinChunk - 1, 0}));
    EXPECT_FALSE(isInWorld({0, kMaxChunk + 1}));
    EXPECT_TRUE(isInWorld({kMinChunk, kMaxChunk}));
}

TEST(Coords, DistanceDoesNotOverflow) {
    EXPECT_EQ(chunkDistance({0, 0}, {3, -4}), 4);
    EXPECT_EQ(chunkDistance({-5, 0}, {3, -4}), 8);
    EXPECT_EQ(chunkDistance({kLowest, 0}, {kHighest, 0}), (std::int64_t{1} << 32) - 1);
    EXPECT_EQ(chunkDistance({0, kHighest}, {0, kLowest}), (std::int64_t{1} << 32) - 1);
}

TEST(Coords, LevelsDoubleTheWidthOfColumns) {
    EXPECT_EQ(blockPos({1, -1, 0}, blockIndex(3, 2, 7)), (BlockPos{19, -14, 7}));
    EXPECT_EQ(blockPos({1, -1, 1}, blockIndex(3, 2, 7)), (BlockPos{38, -28, 7}));
    EXPECT_EQ(blockPos({1, -1, 4}, blockIndex(3, 2, 7)), (BlockPos{304, -224, 7}));
    EXPECT_EQ(offsetBy({5, 6, 3}, -1, 2), (ChunkPos{4, 8, 3}));
    EXPECT_NE((ChunkPos{1, 2, 0}), (ChunkPos{1, 2, 1}));
}

TEST(Coords, EachLevelCoversTheSameBlocks) {
    for (std::uint8_t level = 0; level <= kMaxLevel; ++level) {
        const ChunkPos first{kMinChunk >> level, kMinChunk >> level, level};
        const ChunkPos last{kMaxChunk >> level, kMaxChunk >> level, level};
        EXPECT_TRUE(isInWorld(first) && isInWorld(last));
        EXPECT_FALSE(isInWorld(offsetBy(first, -1, 0)) || isInWorld(offsetBy(last, 0, 1)));
        EXPECT_EQ(blockPos(first, 0), (BlockPos{kLowest, kLowest, 0}));
        EXPECT_EQ(blockPos(last, blockIndex(15, 15, 0)).x, kHighest - (columnWidth(level) - 1));
    }
}

TEST(Coords, HashTellsLevelsApart) {
    std::set<std::size_t> hashes;
    for (std::uint8_t level = 0; level <= kMaxLevel; ++level)
        for (int x = -8; x < 8; ++x) hashes.insert(ChunkPosHash()({x, kMaxChunk >> level, level}));
    EXPECT_EQ(hashes.size(), 256u);
}

// Tables take the lowest bits or a remainder: these must differ too.
TEST(Coords, HashTellsNeighborsApart) {
    std::set<std::size_t> hashes, low;
    for (int y = -32; y < 32; ++y)
        for (int x = -32; x < 32; ++x) {
            hashes.insert(ChunkPosHash()({x, y}));
            low.insert(ChunkPosHash()({x, y}) % 65536);
        }
    EXPECT_EQ(hashes.size(), 4096u);
    EXPECT_GE(low.size(), 3800u);  // 3,970 by chance
}

TEST(BlockBox, HasEachBlockOnceFromBelow) {
    const BlockBox box{{-1, 5, 70}, {1, 6, 73}};
    std::set<BlockPos> seen;
    int z = box.low.z;
    for (std::int64_t n = 0; n < box.blockCount(); ++n) {
        const BlockPos pos = box.blockAt(n);
        EXPECT_GE(pos.z, z);
        z = pos.z;
        EXPECT_TRUE(seen.insert(pos).second) << n;
        EXPECT_TRUE(pos.x >= -1 && pos.x <= 1 && pos.y >= 5 && pos.y <= 6 && pos.z <= 73) << n;
    }
    EXPECT_EQ(seen.size(), 24u);
}

// Corners may be anywhere: a player selects them at both ends of the world.
TEST(BlockBox, CountsBlocksUpToTheLargestNumber) {
    constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max(), kSide = std::int64_t{1} << 32;
    EXPECT_EQ((BlockBox{{kLowest, kLowest, 0}, {kHighest, kHighest, 0}}.blockCount()), kMost);
    EXPECT_EQ((BlockBox{{kLowest, kLowest, 0}, {kHighest, kHighest, 255}}.blockCount()), kMost);
    EXPECT_EQ((BlockBox{{kLowest, 0, 0}, {kHighest, 0, 255}}.blockCount()), kSide * 256);
    EXPECT_EQ((BlockBox{{kLowest, 0, 0}, {kHighest, kHighest, 0}}.blockCount()), kMost) << "2^63";
    EXPECT_EQ((BlockBox{{kHighest, kLowest, 9}, {kHighest, kLowest, 9}}.blockCount()), 1);
    const BlockBox last{{kHighest - 1, kHighest - 2, 254}, {kHighest, kHighest, 255}};
    EXPECT_EQ(last.blockCount(), 12);
    EXPECT_EQ(last.blockAt(11), last.high);
}

TEST(Coords, AnAreaOfALevelCoversTheChunks) {
    const ChunkArea area{-70, 0, 58, 64};
    const auto expect = [&](int level, const ChunkArea& right) {
        const ChunkArea above = areaOver(area, level);
        EXPECT_TRUE(above.x0 == right.x0 && above.y0 == right.y0 && above.x1 == right.x1 &&
                    above.y1 == right.y1)
            << level;
    };
    expect(0, area);
    expect(1, {-35, 0, 29, 32});
    expect(6, {-2, 0, 1, 1});
    expect(15, {-1, 0, 1, 1});
}

}  // namespace
}  // namespace terrane::world

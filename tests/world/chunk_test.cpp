#include "terrane/world/chunk.h"
#include "tests/support/default_heights.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <stdexcept>
#include <string_view>
#include <vector>

namespace terrane::world {
namespace {

BlockEntityData bytes(std::string_view text) {
    BlockEntityData data;
    for (const char c : text) data.push_back(static_cast<std::byte>(c));
    return data;
}

constexpr BlockIndex kA = blockIndex(1, 2, 3);
constexpr BlockIndex kB = blockIndex(15, 15, 255);
constexpr BlockIndex kC = blockIndex(0, 0, 0);

TEST(Chunk, BlocksOfEverySection) {
    Chunk chunk;
    for (int z = 0; z < kChunkHeight; ++z)
        chunk.setBlock(blockIndex(z % 16, 15 - z % 16, z), static_cast<BlockId>(z + 1));
    for (int z = 0; z < kChunkHeight; ++z) {
        EXPECT_EQ(chunk.block(blockIndex(z % 16, 15 - z % 16, z)), z + 1);
        EXPECT_EQ(chunk.block(blockIndex((z + 1) % 16, 15 - z % 16, z)), kAir);
    }
    EXPECT_EQ(chunk.section(2).get(0 | 15 << 4), 33);
}

TEST(Chunk, HasTheHeightsOfItsWorld) {
    for (const Heights heights :
         {Heights{-64, 320}, Heights{kLowestBottom, kHighestTop}, Heights{512, 528}}) {
        Chunk chunk(heights);
        EXPECT_EQ(chunk.heights(), heights);
        for (int z = heights.bottom; z < heights.top; ++z)
            chunk.setBlock(blockIndex(z & 15, 3, z), static_cast<BlockId>(z - heights.bottom + 1));
        for (int z = heights.bottom; z < heights.top; ++z)
            ASSERT_EQ(chunk.block(blockIndex(z & 15, 3, z)), z - heights.bottom + 1);
        EXPECT_EQ(chunk.section(heights.firstSection()).get(0 | 3 << 4), 1);
        chunk.setBlockEntityData(blockIndex(1, 1, heights.bottom), bytes("lowest"));
        chunk.setBlockState(blockIndex(1, 1, heights.top - 1), 9);
        EXPECT_EQ(chunk.blocksWithBlockEntityData(), std::vector{blockIndex(1, 1, heights.bottom)});
        EXPECT_EQ(chunk.blockStates(heights.endSection() - 1).get(blockIndex(1, 1, 15)), 9);
        chunk.setSection(heights.firstSection(), Section());
        EXPECT_TRUE(chunk.blocksWithBlockEntityData().empty());
    }
    EXPECT_FALSE(Chunk() == Chunk({0, 512})) << "the heights count";
}

TEST(Chunk, IsMadeDeeper) {
    Chunk whole({-64, 64});
    for (int z = -64; z < 64; ++z) whole.setBlock(blockIndex(3, 4, z), static_cast<BlockId>(100 + z));
    whole.setBlockState(blockIndex(3, 4, -50), 7);
    whole.setBlockEntityData(blockIndex(3, 4, -20), bytes("deep"));
    whole.setBlockEntityData(blockIndex(3, 4, 20), bytes("high"));
    Chunk chunk = whole;
    EXPECT_EQ(chunk.lowestMade(), -4);
    chunk.unmakeBelow(1);
    EXPECT_EQ(chunk.lowestMade(), 1);
    EXPECT_TRUE(chunk.isMade(1) && !chunk.isMade(0));
    EXPECT_EQ(chunk.block(blockIndex(3, 4, 15)), kUnmade);
    EXPECT_EQ(chunk.block(blockIndex(3, 4, 16)), 116);
    EXPECT_EQ(chunk.blocksWithBlockEntityData(), std::vector{blockIndex(3, 4, 20)});
    chunk.unmakeBelow(-2);
    EXPECT_EQ(chunk.lowestMade(), 1) << "nothing comes back";
    EXPECT_NE(chunk, whole);
    Chunk half = whole;
    half.unmakeBelow(-2);
    chunk.setBlock(blockIndex(3, 4, 20), 5);  // an edit meanwhile
    chunk.makeDeeper(half);
    EXPECT_EQ(chunk.lowestMade(), -2);
    chunk.makeDeeper(half);
    chunk.makeDeeper(whole);
    Chunk expected = whole;
    expected.setBlock(blockIndex(3, 4, 20), 5);
    EXPECT_EQ(chunk, expected) << "its own blocks stay";
    EXPECT_THROW(chunk.makeDeeper(Chunk()), std::invalid_argument);
}

TEST(Chunk, AnEmptyTallOneIsSmall) {
    EXPECT_LT(Chunk({kLowestBottom, kHighestTop}).memoryBytes(), 4300u);
    EXPECT_LT(Chunk().memoryBytes(), 400u);
}

TEST(Chunk, BlockStateIsResetWithTheBlock) {
    Chunk chunk;
    chunk.setBlock(kA, 5);
    chunk.setBlockState(kA, 65535);
    EXPECT_EQ(chunk.block(kA), 5);
    EXPECT_EQ(chunk.blockState(kA), 65535);
    EXPECT_EQ(chunk.blockStates(0).get(kA), 65535);
    chunk.setBlock(kA, 5);
    EXPECT_EQ(chunk.blockState(kA), 0);
}

TEST(Chunk, BlockEntityDataSetReplaceClear) {
    Chunk chunk;
    EXPECT_EQ(chunk.blockEntityData(kA), nullptr);
    chunk.setBlockEntityData(kA, bytes("first"));
    chunk.setBlockEntityData(kB, bytes("second"));
    ASSERT_NE(chunk.blockEntityData(kA), nullptr);
    EXPECT_EQ(*chunk.blockEntityData(kA), bytes("first"));
    EXPECT_EQ(*chunk.blockEntityData(kB), bytes("second"));
    EXPECT_EQ(chunk.blockEntityData(kC), nullptr) << "it has none";

    chunk.setBlockState(kA, 6);
    chunk.setBlockEntityData(kA, bytes("other"));
    EXPECT_EQ(chunk.blockState(kA), 6) << "a block has both";
    EXPECT_EQ(*chunk.blockEntityData(kA), bytes("other"));

    chunk.clearBlockEntityData(kA);
    EXPECT_EQ(chunk.blockEntityData(kA), nullptr);
    EXPECT_EQ(chunk.blockState(kA), 6);
    EXPECT_EQ(*chunk.blockEntityData(kB), bytes("second"));
    chunk.clearBlockEntityData(kA);
    EXPECT_EQ(*chunk.blockEntityData(kB), bytes("second"));
}

TEST(Chunk, ClearLeavesPlainBlockState) {
    Chunk chunk;
    chunk.setBlockState(kA, 3);
    chunk.clearBlockEntityData(kA);
    EXPECT_EQ(chunk.blockState(kA), 3);
}

TEST(Chunk, EmptyBlockEntityDataIsData) {
    Chunk chunk;
    chunk.setBlockEntityData(kA, {});
    ASSERT_NE(chunk.blockEntityData(kA), nullptr);
    EXPECT_TRUE(chunk.blockEntityData(kA)->empty());
}

TEST(Chunk, SetBlockFreesBlockEntityData) {
    Chunk chunk;
    chunk.setBlockEntityData(kA, BlockEntityData(100000));
    const std::size_t before = chunk.memoryBytes();
    EXPECT_GE(before, 100000u);
    chunk.setBlock(kA, 9);
    EXPECT_EQ(chunk.blockEntityData(kA), nullptr);
    EXPECT_LT(chunk.memoryBytes(), before - 90000);
}

TEST(Chunk, SetBlockStateKeepsBlockEntityData) {
    Chunk chunk;
    chunk.setBlockEntityData(kA, bytes("text"));
    chunk.setBlockState(kA, 7);
    EXPECT_EQ(chunk.blockState(kA), 7);
    ASSERT_NE(chunk.blockEntityData(kA), nullptr);
    EXPECT_EQ(*chunk.blockEntityData(kA), bytes("text"));
}

TEST(Chunk, CopiesAreIndependent) {
    Chunk chunk;
    chunk.setBlock(kA, 4);
    chunk.setBlockEntityData(kB, bytes("text"));
    Chunk copy = chunk;
    copy.setBlock(kA, 5);
    copy.setBlockEntityData(kB, bytes("changed"));
    copy.setBlockEntityData(kC, bytes("added"));
    EXPECT_EQ(chunk.block(kA), 4);
    EXPECT_EQ(*chunk.blockEntityData(kB), bytes("text"));
    EXPECT_EQ(chunk.blockEntityData(kC), nullptr);
    EXPECT_EQ(*copy.blockEntityData(kB), bytes("changed"));
}

TEST(Chunk, SetSectionClearsItsDataOnly) {
    Chunk chunk;
    const BlockIndex inOne = blockIndex(3, 3, 16), inTwo = blockIndex(3, 3, 32);
    chunk.setBlockState(blockIndex(4, 4, 20), 9);
    chunk.setBlockEntityData(inOne, bytes("one"));
    chunk.setBlockEntityData(inTwo, bytes("two"));
    chunk.setSection(1, Section(8));
    EXPECT_EQ(chunk.block(inOne), 8);
    EXPECT_EQ(chunk.block(inTwo), kAir);
    EXPECT_TRUE(chunk.blockStates(1).isUniform());
    EXPECT_EQ(chunk.blockState(blockIndex(4, 4, 20)), 0);
    EXPECT_EQ(chunk.blockEntityData(inOne), nullptr);
    EXPECT_EQ(*chunk.blockEntityData(inTwo), bytes("two"));
}

TEST(Chunk, MemoryBytesOfAnEmptyChunk) {
    EXPECT_EQ(Chunk().memoryBytes(), sizeof(Chunk) + 2 * kSectionsPerChunk * sizeof(Section));
    EXPECT_LE(sizeof(Chunk), 2048u);
}

TEST(Chunk, FullOfBlockEntityData) {
    Chunk chunk;
    for (int i = 0; i < 3000; ++i)
        chunk.setBlockEntityData(static_cast<BlockIndex>(i * 21), BlockEntityData(1, std::byte(i)));
    for (int i = 0; i < 3000; ++i)
        EXPECT_EQ(*chunk.blockEntityData(static_cast<BlockIndex>(i * 21)), BlockEntityData(1, std::byte(i)));
}

TEST(Chunk, SetBlockStateSectionKeepsBlockEntityData) {
    Chunk chunk;
    const BlockIndex inOne = blockIndex(3, 3, 16), inTwo = blockIndex(3, 3, 32);
    chunk.setBlock(inOne, 8);
    chunk.setBlockEntityData(inTwo, bytes("two"));
    chunk.setBlockEntityData(inOne, bytes("one"));
    chunk.setBlockStateSection(1, Section(6));
    EXPECT_EQ(chunk.block(inOne), 8);
    EXPECT_EQ(chunk.blockState(inOne), 6);
    EXPECT_EQ(*chunk.blockEntityData(inOne), bytes("one"));
    EXPECT_EQ(*chunk.blockEntityData(inTwo), bytes("two"));
}

TEST(Chunk, BlocksWithBlockEntityDataAscend) {
    Chunk chunk;
    EXPECT_TRUE(chunk.blocksWithBlockEntityData().empty());
    chunk.setBlockEntityData(kB, bytes("1"));
    chunk.setBlockEntityData(kC, bytes("2"));
    chunk.setBlockEntityData(kA, bytes("3"));
    EXPECT_EQ(chunk.blocksWithBlockEntityData(), (std::vector<BlockIndex>{kC, kA, kB}));
    chunk.setBlock(kC, 1);
    EXPECT_EQ(chunk.blocksWithBlockEntityData(), (std::vector<BlockIndex>{kA, kB}));
    chunk.setSection(15, Section(1));
    EXPECT_EQ(chunk.blocksWithBlockEntityData(), (std::vector<BlockIndex>{kA}));
}

TEST(Chunk, EveryBlockMayHaveBlockEntityData) {
    Chunk chunk;
    for (int i = 0; i < kBlocksPerChunk; ++i)
        chunk.setBlockEntityData(static_cast<BlockIndex>(i), BlockEntityData(1, std::byte(i)));
    EXPECT_EQ(chunk.blocksWithBlockEntityData().size(), 65536u);
    EXPECT_EQ(*chunk.blockEntityData(65535), BlockEntityData(1, std::byte{255}));
}

TEST(Chunk, EqualWhateverTheOrderOfData) {
    Chunk a, b;
    EXPECT_EQ(a, b);
    a.setBlockEntityData(kA, bytes("one"));
    a.setBlockEntityData(kB, bytes("two"));
    b.setBlockEntityData(kB, bytes("two"));
    EXPECT_NE(a, b);
    b.setBlockEntityData(kA, bytes("one"));
    EXPECT_EQ(a, b);
    a.setBlockState(kA, 2);
    EXPECT_NE(a, b) << "state beside data counts";
    b.setBlockState(kA, 2);
    EXPECT_EQ(a, b);
    b.setBlockState(kC, 1);
    EXPECT_NE(a, b);
    a.setBlockState(kC, 1);
    EXPECT_EQ(a, b);
    a.setBlockEntityData(kA, bytes("other"));
    EXPECT_NE(a, b);
    a.clearBlockEntityData(kA);
    EXPECT_NE(a, b);
}

TEST(Chunk, EqualNeedsEqualBlocks) {
    Chunk a, b;
    a.setBlock(kB, 3);
    EXPECT_NE(a, b);
    b.setBlock(kB, 3);
    EXPECT_EQ(a, b);
}

// The plain reference for one block of a chunk.
struct PlainBlock {
    BlockId id = 0;
    std::uint16_t blockState = 0;
    BlockEntityData blockEntityData{};
    bool hasLarge = false;
};

TEST(Chunk, EqualsPlainMap) {
    std::mt19937 random(1);
    Chunk chunk;
    std::map<BlockIndex, PlainBlock> plain;
    for (int step = 0; step < 200000; ++step) {
        const auto i = static_cast<BlockIndex>(random() % 64 * 1023);
        PlainBlock& block = plain[i];
        const auto number = static_cast<std::uint16_t>(random() % 40);
        switch (random() % 4) {
            case 0:
                chunk.setBlock(i, number);
                block = {.id = number};
                break;
            case 1:
                chunk.setBlockState(i, number);
                block.blockState = number;
                break;
            case 2:
                chunk.setBlockEntityData(i, BlockEntityData(number));
                block.blockEntityData = BlockEntityData(number);
                block.hasLarge = true;
                break;
            default:
                chunk.clearBlockEntityData(i);
                block.hasLarge = false;
        }
        const auto seen = static_cast<BlockIndex>(random() % 64 * 1023);
        ASSERT_EQ(chunk.block(seen), plain[seen].id);
        ASSERT_EQ(chunk.blockEntityData(seen) != nullptr, plain[seen].hasLarge);
        if (plain[seen].hasLarge) {
            ASSERT_EQ(*chunk.blockEntityData(seen), plain[seen].blockEntityData);
        }
        ASSERT_EQ(chunk.blockState(seen), plain[seen].blockState);
    }
}

TEST(Chunk, SectionsOutsideAndNoDataAreRefused) {
    Chunk chunk;
    for (const int number : {-1, 16}) {
        EXPECT_THROW(chunk.setSection(number, Section(1)), std::invalid_argument);
        EXPECT_THROW(chunk.setBlockStateSection(number, Section(1)), std::invalid_argument);
    }
    EXPECT_THROW(chunk.shareBlockEntityData(7, nullptr), std::invalid_argument);
    EXPECT_EQ(chunk, Chunk());
}

}  // namespace
}  // namespace terrane::world

#include "terrane/world/chunk.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <string_view>
#include <vector>

namespace terrane::world {
namespace {

LargeData bytes(std::string_view text) {
    LargeData data;
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

TEST(Chunk, SmallDataIsResetWithTheBlock) {
    Chunk chunk;
    chunk.setBlock(kA, 5);
    chunk.setSmallData(kA, 65535);
    EXPECT_EQ(chunk.block(kA), 5);
    EXPECT_EQ(chunk.smallData(kA), 65535);
    EXPECT_EQ(chunk.smallDataSection(0).get(kA), 65535);
    chunk.setBlock(kA, 5);
    EXPECT_EQ(chunk.smallData(kA), 0);
}

TEST(Chunk, LargeDataSetReplaceClear) {
    Chunk chunk;
    EXPECT_EQ(chunk.largeData(kA), nullptr);
    chunk.setLargeData(kA, bytes("first"));
    chunk.setLargeData(kB, bytes("second"));
    ASSERT_NE(chunk.largeData(kA), nullptr);
    EXPECT_EQ(*chunk.largeData(kA), bytes("first"));
    EXPECT_EQ(*chunk.largeData(kB), bytes("second"));
    EXPECT_EQ(chunk.largeData(kC), nullptr) << "small data 0 is no slot of this block";

    const std::uint16_t slot = chunk.smallData(kA);
    chunk.setLargeData(kA, bytes("other"));
    EXPECT_EQ(chunk.smallData(kA), slot) << "replaced in its slot";
    EXPECT_EQ(*chunk.largeData(kA), bytes("other"));

    chunk.clearLargeData(kA);
    EXPECT_EQ(chunk.largeData(kA), nullptr);
    EXPECT_EQ(chunk.smallData(kA), 0);
    EXPECT_EQ(*chunk.largeData(kB), bytes("second"));
    chunk.clearLargeData(kA);
    EXPECT_EQ(*chunk.largeData(kB), bytes("second"));
}

TEST(Chunk, ClearLeavesPlainSmallData) {
    Chunk chunk;
    chunk.setSmallData(kA, 3);
    chunk.clearLargeData(kA);
    EXPECT_EQ(chunk.smallData(kA), 3);
}

TEST(Chunk, EmptyLargeDataIsData) {
    Chunk chunk;
    chunk.setLargeData(kA, {});
    ASSERT_NE(chunk.largeData(kA), nullptr);
    EXPECT_TRUE(chunk.largeData(kA)->empty());
}

TEST(Chunk, SetBlockFreesLargeData) {
    Chunk chunk;
    chunk.setLargeData(kA, LargeData(100000));
    const std::size_t before = chunk.memoryBytes();
    EXPECT_GE(before, 100000u);
    chunk.setBlock(kA, 9);
    EXPECT_EQ(chunk.largeData(kA), nullptr);
    EXPECT_LT(chunk.memoryBytes(), before - 90000);
}

// Else the slot would be taken for ever, and the data come back with the number.
TEST(Chunk, SetSmallDataFreesLargeData) {
    Chunk chunk;
    chunk.setLargeData(kB, bytes("keeps slot 0"));
    chunk.setLargeData(kA, bytes("in slot 1"));
    chunk.setSmallData(kA, 7);
    EXPECT_EQ(chunk.largeData(kA), nullptr);
    chunk.setSmallData(kA, 1);
    EXPECT_EQ(chunk.largeData(kA), nullptr);
    EXPECT_EQ(chunk.smallData(kA), 1);
}

TEST(Chunk, SlotsAreReused) {
    Chunk chunk;
    for (int i = 0; i < 10; ++i) chunk.setLargeData(static_cast<BlockIndex>(i), bytes("x"));
    chunk.clearLargeData(3);
    chunk.setBlock(5, 1);
    chunk.setLargeData(1000, bytes("y"));
    chunk.setLargeData(1001, bytes("z"));
    EXPECT_EQ(chunk.smallData(1000), 3);
    EXPECT_EQ(chunk.smallData(1001), 5);
    chunk.setLargeData(1002, bytes("w"));
    EXPECT_EQ(chunk.smallData(1002), 10);
    EXPECT_EQ(chunk.largeData(3), nullptr);
    EXPECT_EQ(chunk.largeData(5), nullptr);
}

TEST(Chunk, CopiesAreIndependent) {
    Chunk chunk;
    chunk.setBlock(kA, 4);
    chunk.setLargeData(kB, bytes("text"));
    Chunk copy = chunk;
    copy.setBlock(kA, 5);
    copy.setLargeData(kB, bytes("changed"));
    copy.setLargeData(kC, bytes("added"));
    EXPECT_EQ(chunk.block(kA), 4);
    EXPECT_EQ(*chunk.largeData(kB), bytes("text"));
    EXPECT_EQ(chunk.largeData(kC), nullptr);
    EXPECT_EQ(*copy.largeData(kB), bytes("changed"));
}

TEST(Chunk, SetSectionClearsItsDataOnly) {
    Chunk chunk;
    const BlockIndex inOne = blockIndex(3, 3, 16), inTwo = blockIndex(3, 3, 32);
    chunk.setSmallData(blockIndex(4, 4, 20), 9);
    chunk.setLargeData(inOne, bytes("one"));
    chunk.setLargeData(inTwo, bytes("two"));
    chunk.setSection(1, Section(8));
    EXPECT_EQ(chunk.block(inOne), 8);
    EXPECT_EQ(chunk.block(inTwo), kAir);
    EXPECT_TRUE(chunk.smallDataSection(1).isUniform());
    EXPECT_EQ(chunk.smallData(blockIndex(4, 4, 20)), 0);
    EXPECT_EQ(chunk.largeData(inOne), nullptr);
    EXPECT_EQ(*chunk.largeData(inTwo), bytes("two"));
}

TEST(Chunk, MemoryBytesOfAnEmptyChunkIsTheObject) {
    EXPECT_EQ(Chunk().memoryBytes(), sizeof(Chunk));
    EXPECT_LE(sizeof(Chunk), 2048u);
}

TEST(Chunk, FullOfLargeData) {
    Chunk chunk;
    for (int i = 0; i < 3000; ++i)
        chunk.setLargeData(static_cast<BlockIndex>(i * 21), LargeData(1, std::byte(i)));
    for (int i = 0; i < 3000; ++i)
        EXPECT_EQ(*chunk.largeData(static_cast<BlockIndex>(i * 21)), LargeData(1, std::byte(i)));
}

TEST(Chunk, SetSmallDataSectionFreesLargeDataThere) {
    Chunk chunk;
    const BlockIndex inOne = blockIndex(3, 3, 16), inTwo = blockIndex(3, 3, 32);
    chunk.setBlock(inOne, 8);
    chunk.setLargeData(inTwo, bytes("two"));
    chunk.setLargeData(inOne, bytes("one"));
    chunk.setSmallDataSection(1, Section(6));
    EXPECT_EQ(chunk.block(inOne), 8);
    EXPECT_EQ(chunk.smallData(inOne), 6);
    EXPECT_EQ(chunk.largeData(inOne), nullptr);
    EXPECT_EQ(*chunk.largeData(inTwo), bytes("two"));
}

TEST(Chunk, BlocksWithLargeDataAscend) {
    Chunk chunk;
    EXPECT_TRUE(chunk.blocksWithLargeData().empty());
    chunk.setLargeData(kB, bytes("1"));
    chunk.setLargeData(kC, bytes("2"));
    chunk.setLargeData(kA, bytes("3"));
    EXPECT_EQ(chunk.blocksWithLargeData(), (std::vector<BlockIndex>{kC, kA, kB}));
    chunk.setBlock(kC, 1);
    EXPECT_EQ(chunk.blocksWithLargeData(), (std::vector<BlockIndex>{kA, kB}));
    chunk.setSection(15, Section(1));
    EXPECT_EQ(chunk.blocksWithLargeData(), (std::vector<BlockIndex>{kA}));
}

TEST(Chunk, EveryBlockMayHaveLargeData) {
    Chunk chunk;
    for (int i = 0; i < kBlocksPerChunk; ++i)
        chunk.setLargeData(static_cast<BlockIndex>(i), LargeData(1, std::byte(i)));
    EXPECT_EQ(chunk.blocksWithLargeData().size(), 65536u);
    EXPECT_EQ(*chunk.largeData(65535), LargeData(1, std::byte{255}));
}

TEST(Chunk, EqualWhateverTheSlots) {
    Chunk a, b;
    EXPECT_EQ(a, b);
    a.setLargeData(kA, bytes("one"));
    a.setLargeData(kB, bytes("two"));
    b.setLargeData(kB, bytes("two"));
    EXPECT_NE(a, b);
    b.setLargeData(kA, bytes("one"));
    EXPECT_NE(a.smallData(kA), b.smallData(kA));
    EXPECT_EQ(a, b);
    b.setSmallData(kC, 1);
    EXPECT_NE(a, b);
    a.setSmallData(kC, 1);
    EXPECT_EQ(a, b);
    a.setLargeData(kA, bytes("other"));
    EXPECT_NE(a, b);
    a.clearLargeData(kA);
    EXPECT_NE(a, b);
}

TEST(Chunk, EqualNeedsEqualBlocks) {
    Chunk a, b;
    a.setBlock(kB, 3);
    EXPECT_NE(a, b);
    b.setBlock(kB, 3);
    EXPECT_EQ(a, b);
}

// What a chunk must hold, told plainly.
struct PlainBlock {
    BlockId id = 0;
    std::uint16_t smallData = 0;
    LargeData largeData{};
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
                chunk.setSmallData(i, number);
                block = {.id = block.id, .smallData = number};
                break;
            case 2:
                chunk.setLargeData(i, LargeData(number));
                block = {.id = block.id, .largeData = LargeData(number), .hasLarge = true};
                break;
            default:
                chunk.clearLargeData(i);
                if (block.hasLarge) block = {.id = block.id};
        }
        const auto seen = static_cast<BlockIndex>(random() % 64 * 1023);
        ASSERT_EQ(chunk.block(seen), plain[seen].id);
        ASSERT_EQ(chunk.largeData(seen) != nullptr, plain[seen].hasLarge);
        if (plain[seen].hasLarge) {
            ASSERT_EQ(*chunk.largeData(seen), plain[seen].largeData);
        } else {
            ASSERT_EQ(chunk.smallData(seen), plain[seen].smallData);
        }
    }
}

}  // namespace
}  // namespace terrane::world

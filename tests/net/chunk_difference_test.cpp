#include "terrane/net/wire/chunk_difference.h"
#include "tests/support/default_heights.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/net/bytes_of.h"

namespace terrane::net {
namespace {

using world::BlockIndex;
using world::Chunk;

world::BlockEntityDataPtr dataOf(std::size_t size, int value) {
    return std::make_shared<const world::BlockEntityData>(size, static_cast<std::byte>(value));
}

// A chunk with layers of a few blocks, some with states and data.
Chunk someChunk(std::mt19937& random) {
    Chunk chunk;
    for (int i = 0; i < world::kBlocksPerChunk; ++i)
        chunk.setBlock(static_cast<BlockIndex>(i), static_cast<world::BlockId>(i < 20000 ? 1 + i / 7000 : 0));
    for (int k = 0; k < 20; ++k)
        chunk.setBlockState(static_cast<BlockIndex>(random() % 20000),
                            static_cast<std::uint16_t>(random() % 9));
    for (int k = 0; k < 3; ++k)
        chunk.setBlockEntityData(static_cast<BlockIndex>(random() % 20000), {std::byte{7}});
    return chunk;
}

void editSome(Chunk& chunk, std::mt19937& random, int count) {
    for (int k = 0; k < count; ++k) {
        const auto i = static_cast<BlockIndex>(random() % world::kBlocksPerChunk);
        const int length = random() % 3 == 0 ? 1 + static_cast<int>(random() % 40) : 1;
        const auto id = static_cast<world::BlockId>(random() % 5);
        const auto state = static_cast<std::uint16_t>(random() % 3);
        for (int n = i; n < std::min(i + length, world::kBlocksPerChunk); ++n) {
            chunk.setBlock(static_cast<BlockIndex>(n), id);
            chunk.setBlockState(static_cast<BlockIndex>(n), state);
        }
        if (random() % 4 == 0) chunk.setBlockEntityData(i, world::BlockEntityData(random() % 50));
    }
}

Bytes written(std::span<const ChangedBlock> blocks, IndexRange range = IndexRange::Any) {
    Bytes bytes;
    WireWriter wire(bytes);
    writeBlocks(wire, blocks, range);
    return bytes;
}

std::optional<ChunkDifference> read(ByteView bytes, IndexRange range = IndexRange::Any) {
    WireReader wire(bytes);
    ChunkDifference blocks;
    readBlocks(wire, blocks, range);
    return wire.isComplete() ? std::optional(std::move(blocks)) : std::nullopt;
}

TEST(ChunkDifference, AppliedGivesTheEditedChunk) {
    std::mt19937 random(3);
    for (const int edits : {0, 1, 5, 300, 3000}) {
        const Chunk generated = someChunk(random);
        Chunk edited = generated;
        editSome(edited, random, edits);
        const ChunkDifference difference = chunkDifference(generated, edited);
        Chunk made = generated;
        ChunkDifference all;
        for (const auto part : partsOf(difference)) {
            const auto blocks = read(written(part));
            ASSERT_TRUE(blocks) << edits;
            applyDifference(made, *blocks);
            mergeInto(all, *blocks);
        }
        EXPECT_EQ(made, edited) << edits;
        EXPECT_EQ(all, difference) << edits;
    }
}

// Also at the lowest and the highest block of a chunk, of worlds of many heights.
TEST(ChunkDifference, AnyHeights) {
    std::mt19937 random(4);
    for (const world::Heights heights :
         {world::Heights{-64, 320}, {-2048, 2048}, {512, 1024}, {-1024, -512}, {0, 256}, {0, 16}}) {
        const BlockIndex bottom = heights.bottom * world::kBlocksPerLayer,
                         end = heights.top * world::kBlocksPerLayer;
        Chunk generated(heights);
        for (int n = heights.firstSection(); n < heights.endSection(); n += 2)
            generated.setSection(n, world::Section(1));
        Chunk edited = generated;
        for (int k = 0; k < 2000; ++k) {
            const BlockIndex i =
                bottom + static_cast<BlockIndex>(random() % static_cast<unsigned>(end - bottom));
            edited.setBlock(i, static_cast<world::BlockId>(random() % 5));
            edited.setBlockState(i, static_cast<std::uint16_t>(random() % 3));
        }
        for (const BlockIndex i : {bottom, end - 1}) edited.setBlockEntityData(i, {std::byte{9}});
        const ChunkDifference difference = chunkDifference(generated, edited);
        EXPECT_EQ(difference.front().index, bottom);
        EXPECT_EQ(difference.back().index, end - 1);
        EXPECT_TRUE(isWithin(difference, heights));
        EXPECT_FALSE(isWithin(difference, {heights.bottom + 16, std::max(heights.top, heights.bottom + 32)}));
        Chunk made = generated;
        for (const auto part : partsOf(difference)) {
            const auto blocks = read(written(part));
            ASSERT_TRUE(blocks) << describe(heights);
            applyDifference(made, *blocks);
        }
        EXPECT_EQ(made, edited) << describe(heights);
    }
}

// The history of servers keeps these bytes, those of version 2 of the protocol.
TEST(ChunkDifference, LowIndicesHaveTheBytesOfHistories) {
    const ChunkDifference blocks{{5, {3, 1, {}}}, {6, {3, 1, {}}}, {900, {2, 0, dataOf(1, 7)}}};
    const Bytes bytes = written(blocks, IndexRange::Low);
    EXPECT_EQ(bytes, bytesOf({2, 3, 1, 2, 0, 2, 0x0B, 0, 0, 0xFA, 0x0D, 1, 1, 0x84, 0x03, 1, 7}));
    EXPECT_EQ(read(bytes, IndexRange::Low)->back(), blocks.back());
}

TEST(ChunkDifference, IndicesBeyondTheRangeAreRefused) {
    const auto runAt = [](std::uint64_t gap, IndexRange range) {
        Bytes bytes;
        WireWriter wire(bytes);
        for (const std::uint64_t number : {std::uint64_t{1}, std::uint64_t{5}, std::uint64_t{0},
                                           std::uint64_t{1}, gap << 1, std::uint64_t{0}})
            wire.number(number);
        return read(bytes, range);
    };
    EXPECT_EQ(runAt(0, IndexRange::Low)->front().index, 0);
    EXPECT_EQ(runAt(65535, IndexRange::Low)->front().index, 65535);
    EXPECT_FALSE(runAt(65536, IndexRange::Low));
    EXPECT_EQ(runAt(0, IndexRange::Any)->front().index, -2048 * 256);
    EXPECT_EQ(runAt(4096 * 256 - 1, IndexRange::Any)->front().index, 2048 * 256 - 1);
    EXPECT_FALSE(runAt(4096 * 256, IndexRange::Any));
    EXPECT_FALSE(runAt(0x7FFFFFFF, IndexRange::Any));
}

TEST(ChunkDifference, WhatIsEqualIsNotInIt) {
    std::mt19937 random(5);
    const Chunk chunk = someChunk(random);
    EXPECT_TRUE(chunkDifference(chunk, chunk).empty());
    Chunk edited = chunk;
    edited.setBlockEntityData(77, {std::byte{1}});
    const ChunkDifference difference = chunkDifference(chunk, edited);
    ASSERT_EQ(difference.size(), 1u);
    EXPECT_EQ(difference[0].index, 77);
}

TEST(ChunkDifference, IsSmall) {
    const Chunk air;
    Chunk wall;
    for (int z = 60; z < 64; ++z)
        for (int x = 0; x < 16; ++x) wall.setBlock(world::blockIndex(x, 3, z), 5);
    EXPECT_LE(written(chunkDifference(air, wall)).size(), 4u * 3 + 8) << "four runs";
    Chunk one;
    one.setBlock(world::blockIndex(1, 2, 70), 5);
    EXPECT_LE(written(chunkDifference(air, one)).size(), 8u);
}

TEST(ChunkDifference, LargeOnesComeInParts) {
    Chunk edited;
    std::mt19937 random(9);
    for (int i = 0; i < world::kBlocksPerChunk; ++i)
        edited.setBlock(static_cast<BlockIndex>(i), static_cast<world::BlockId>(1 + random() % 500));
    for (int i = 0; i < 8; ++i)
        edited.setBlockEntityData(static_cast<BlockIndex>(i), world::BlockEntityData(30000));
    const ChunkDifference difference = chunkDifference(Chunk(), edited);
    const auto parts = partsOf(difference);
    EXPECT_GE(parts.size(), 8u);
    std::size_t blocks = 0;
    for (const auto part : parts) {
        blocks += part.size();
        EXPECT_LE(written(part).size(), 100000u);
    }
    EXPECT_EQ(blocks, difference.size());
    EXPECT_EQ(partsOf({}).size(), 1u);
}

TEST(ChunkDifference, DataThatIsTooLargeStays) {
    ChunkDifference difference{{3, {1, 0, dataOf(kMaxBlockData, 1)}},
                               {4, {1, 0, dataOf(kMaxBlockData + 1, 1)}}};
    const auto blocks = read(written(difference));
    ASSERT_TRUE(blocks);
    EXPECT_EQ((*blocks)[0], difference[0]);
    EXPECT_EQ((*blocks)[1].value, (world::BlockValue{1, 0, nullptr}));
}

TEST(ChunkDifference, NewerBlocksReplaceOlderOnes) {
    const world::BlockValue old{1, 0, {}}, changed{2, 0, {}};
    ChunkDifference difference{{1, old}, {3, old}, {5, old}};
    mergeInto(difference, ChunkDifference{{0, changed}, {3, changed}, {9, changed}});
    EXPECT_EQ(difference, (ChunkDifference{{0, changed}, {1, old}, {3, changed}, {5, old}, {9, changed}}));
}

TEST(ChunkDifference, KindsDiffer) {
    const auto withIds = [](std::uint64_t first, std::uint64_t second) {
        Bytes bytes;
        WireWriter wire(bytes);
        // Two kinds, one run of one block of the first kind, no data.
        for (const std::uint64_t number : std::vector<std::uint64_t>{2, first, 0, second, 0, 1, 0, 0, 0})
            wire.number(number);
        return bytes;
    };
    EXPECT_TRUE(read(withIds(5, 6)));
    EXPECT_FALSE(read(withIds(5, 5)));
}

// For any input, the blocks read are in order and within the limit.
TEST(ChunkDifference, AnyBytesAreRead) {
    std::mt19937 random(11);
    Chunk edited;
    editSome(edited, random, 50);
    const Bytes good = written(chunkDifference(Chunk(), edited));
    for (int k = 0; k < 20000; ++k) {
        Bytes bytes = good;
        bytes.resize(random() % 4 == 0 ? random() % (bytes.size() + 1) : bytes.size());
        for (std::size_t n = random() % 4; n > 0 && !bytes.empty(); --n)
            bytes[random() % bytes.size()] = static_cast<std::byte>(random());
        const auto blocks = read(bytes);
        if (!blocks) continue;
        EXPECT_LE(blocks->size(), kMaxBlocksInPart);
        for (std::size_t n = 1; n < blocks->size(); ++n)
            EXPECT_LT((*blocks)[n - 1].index, (*blocks)[n].index);
    }
}

}  // namespace
}  // namespace terrane::net

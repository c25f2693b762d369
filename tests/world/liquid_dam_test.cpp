// A dam is broken above a valley: the water settles, and in any order to the same state.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "tests/support/default_heights.h"
#include "tests/world/content_blocks.h"
#include "tests/world/dam.h"

namespace terrane::world {
namespace {

constexpr int kMostTicks = 400;

struct Dam {
    World world;
    std::vector<BlockEdit> edits;

    void load(ChunkPos pos) { world.insert(pos, damChunk(pos, contentBlocks())); }
    std::size_t tick(std::span<const ChunkPos> area = kDamArea) {
        return flowLiquids(world, contentBlocks(), area, edits);
    }
    int settle() {
        int ticks = 0;
        while (ticks < kMostTicks && tick() > 0) ++ticks;
        EXPECT_LT(ticks, kMostTicks);
        return ticks;
    }
    int countFlowing() const {
        int count = 0;
        const BlockId water = contentBlock("water");
        world.forEachChunk([&](ChunkPos, const ChunkPtr& chunk) {
            for (int i = 0; i < kBlocksPerChunk; ++i) {
                const auto index = static_cast<BlockIndex>(i);
                count += chunk->block(index) == water && !isLiquidSource(chunk->blockState(index));
            }
        });
        return count;
    }
};

Dam loadedDam(unsigned order) {
    Dam dam;
    std::vector<ChunkPos> chunks = damChunks();
    std::mt19937 random(order);
    for (std::size_t k = chunks.size(); k > 1; --k) std::swap(chunks[k - 1], chunks[random() % k]);
    for (const ChunkPos pos : chunks) dam.load(pos);
    return dam;
}

// Digests after each tenth tick until all is settled.
std::vector<std::string> digestsOf(Dam& dam) {
    std::vector<std::string> digests;
    for (int ticks = 0; ticks < kMostTicks; ++ticks) {
        if (dam.tick() == 0) break;
        if (ticks % 10 == 0) digests.push_back(damDigest(dam.world));
    }
    digests.push_back(damDigest(dam.world));
    return digests;
}

TEST(LiquidDam, ALakeBehindADamStandsStill) {
    Dam dam = loadedDam(1);
    EXPECT_EQ(dam.tick(), 0u);
    EXPECT_EQ(dam.countFlowing(), 0);
}

TEST(LiquidDam, TheValleyIsFloodedAndSettles) {
    Dam dam = loadedDam(1);
    breakDam(dam.world, contentBlocks(), dam.edits);
    const int ticks = dam.settle();
    EXPECT_GT(ticks, 20);
    EXPECT_GT(dam.countFlowing(), 800);
    bool reachesEnd = false;
    for (int y = 1; y < 63; ++y)
        for (int z = 0; z < 40; ++z)
            reachesEnd = reachesEnd || dam.world.block({62, y, z}) == contentBlock("water");
    EXPECT_TRUE(reachesEnd);
    EXPECT_EQ(dam.tick(), 0u);
}

TEST(LiquidDam, OrderOfLoadingDoesNotMatter) {
    Dam first = loadedDam(1), second = loadedDam(2);
    for (Dam* dam : {&first, &second}) breakDam(dam->world, contentBlocks(), dam->edits);
    EXPECT_EQ(digestsOf(first), digestsOf(second));
}

// Half of the valley is loaded when the other half is already flooded.
TEST(LiquidDam, ChunksThatComeLateEndUpTheSame) {
    Dam whole = loadedDam(1), late;
    breakDam(whole.world, contentBlocks(), whole.edits);
    whole.settle();
    for (const ChunkPos pos : damChunks())
        if (pos.x < 2) late.load(pos);
    breakDam(late.world, contentBlocks(), late.edits);
    for (int ticks = 0; ticks < 80; ++ticks) late.tick();
    for (const ChunkPos pos : damChunks())
        if (pos.x >= 2) late.load(pos);
    late.settle();
    EXPECT_EQ(damDigest(late.world), damDigest(whole.world));
}

TEST(LiquidDam, ACopyOfTheChunksGoesOnTheSame) {
    Dam whole = loadedDam(1), copied;
    breakDam(whole.world, contentBlocks(), whole.edits);
    for (int ticks = 0; ticks < 25; ++ticks) whole.tick();
    whole.world.forEachChunk([&](ChunkPos pos, const ChunkPtr& chunk) {
        copied.world.insert(pos, std::make_shared<Chunk>(*chunk));
    });
    EXPECT_EQ(digestsOf(whole), digestsOf(copied));
}

// When the lake is removed, all flowing water runs dry.
TEST(LiquidDam, RunsDryWithoutTheLake) {
    Dam dam = loadedDam(1);
    breakDam(dam.world, contentBlocks(), dam.edits);
    dam.settle();
    for (int z = 40; z <= kLakeTop; ++z)
        for (int y = 1; y < 63; ++y)
            for (int x = 1; x < kDamX; ++x)
                if (dam.world.block({x, y, z}) == contentBlock("water"))
                    applyChange(dam.world, contentBlocks(), {x, y, z}, SetBlock{kAir}, dam.edits);
    dam.settle();
    EXPECT_EQ(dam.countFlowing(), 0);
}

}  // namespace
}  // namespace terrane::world

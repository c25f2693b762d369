#include "terrane/gen_gpu/pass_plan.h"

#include <gtest/gtest.h>

#include <set>

namespace terrane::gen_gpu {
namespace {

using world::ChunkPos;

std::vector<ChunkPos> row(int first, int count) {
    std::vector<ChunkPos> chunks;
    for (int x = first; x < first + count; ++x) chunks.push_back({x, 0});
    return chunks;
}

TEST(SlotCache, GivesEachChunkASlotOfItsOwn) {
    SlotCache cache(8);
    cache.reserve(row(0, 8));
    std::set<std::uint32_t> slots;
    for (const ChunkPos pos : row(0, 8)) slots.insert(cache.slot(pos));
    EXPECT_EQ(slots.size(), 8u);
    EXPECT_EQ(*slots.rbegin(), 7u);
}

TEST(SlotCache, KeptChunksKeepSlotAndProgress) {
    SlotCache cache(8);
    cache.reserve(row(0, 4));
    cache.setPassesDone({3, 0}, 2);
    const std::uint32_t slot = cache.slot({3, 0});
    cache.reserve(row(3, 5));
    EXPECT_EQ(cache.slot({3, 0}), slot);
    EXPECT_EQ(cache.passesDone({3, 0}), 2);
    EXPECT_EQ(cache.passesDone({4, 0}), 0);
}

TEST(SlotCache, ReplacesTheLeastRecentlyUsed) {
    SlotCache cache(4);
    cache.reserve(row(0, 4));
    cache.setPassesDone({0, 0}, 5);
    cache.reserve(row(0, 1));  // 0 is used again: 1 is the oldest now
    cache.reserve(row(10, 1));
    EXPECT_TRUE(cache.find({0, 0}));
    EXPECT_FALSE(cache.find({1, 0}));
    cache.reserve(row(1, 1));
    EXPECT_EQ(cache.passesDone({1, 0}), 0) << "what was replaced starts again";
}

TEST(SlotCache, LevelsAreChunksOfTheirOwn) {
    SlotCache cache(4);
    cache.reserve({{3, 0, 0}, {3, 0, 1}});
    EXPECT_NE(cache.slot({3, 0, 0}), cache.slot({3, 0, 1}));
    cache.setPassesDone({3, 0, 1}, 2);
    EXPECT_EQ(cache.passesDone({3, 0, 0}), 0);
    EXPECT_FALSE(cache.find({3, 0, 2}));
}

// A batch as large as the cache that shares some chunks with the one before: none of them replaces another.
TEST(SlotCache, OverlappingFullBatches) {
    SlotCache cache(100);
    for (int first = 0; first < 1000; first += 37) {
        cache.reserve(row(first, 100));
        std::set<std::uint32_t> slots;
        for (const ChunkPos pos : row(first, 100)) slots.insert(cache.slot(pos));
        EXPECT_EQ(slots.size(), 100u) << first;
    }
}

}  // namespace
}  // namespace terrane::gen_gpu

#include "terrane/gpu/arena_allocator.h"

#include <gtest/gtest.h>

#include <map>

#include "terrane/shared/hash.h"

namespace terrane::gpu {
namespace {

constexpr std::uint64_t kNoLimit = UINT64_MAX;

// Allocates, and grows the arenas if needed and allowed.
std::optional<std::uint32_t> allocateGrowing(ArenaAllocator& arenas, std::uint32_t size, std::uint64_t most) {
    if (const auto found = arenas.allocate(size)) return found;
    const auto growth = arenas.planGrowth(size, most - arenas.capacity());
    if (!growth) return std::nullopt;
    arenas.grow(*growth);
    return arenas.allocate(size);
}

TEST(ArenaAllocator, DoublesTheLastArenaThenAddsAnother) {
    ArenaAllocator arenas({.arena = 64, .first = 16, .count = 3});
    std::vector<std::size_t> capacities;
    for (int k = 0; k < 24; ++k) {
        ASSERT_TRUE(allocateGrowing(arenas, 8, kNoLimit)) << k;
        if (capacities.empty() || capacities.back() != arenas.capacity())
            capacities.push_back(arenas.capacity());
    }
    EXPECT_EQ(capacities, (std::vector<std::size_t>{16, 32, 64, 80, 96, 128, 144, 160, 192}));
    EXPECT_EQ(arenas.arenas().size(), 3u);
    EXPECT_FALSE(arenas.planGrowth(1, kNoLimit)) << "three arenas are all";
}

TEST(ArenaAllocator, ACopyCountsBesideWhatItReplaces) {
    const ArenaAllocator arenas({.arena = 64, .first = 16, .count = 3});
    ASSERT_TRUE(arenas.planGrowth(4, 32));
    EXPECT_EQ(arenas.planGrowth(4, 32)->arena, 0u);
    EXPECT_EQ(arenas.planGrowth(4, 32)->capacity, 32u);
    EXPECT_EQ(arenas.planGrowth(4, 31)->arena, 1u) << "no room for both: another arena";
    EXPECT_EQ(arenas.planGrowth(4, 31)->capacity, 16u);
    EXPECT_EQ(arenas.planGrowth(4, 10)->capacity, 10u);
    EXPECT_FALSE(arenas.planGrowth(4, 3));
    EXPECT_FALSE(arenas.planGrowth(65, kNoLimit)) << "a range lies in one arena";
    EXPECT_EQ(arenas.planGrowth(60, kNoLimit)->arena, 1u) << "longer than what the first can get";
}

// Ranges of random sizes are allocated and freed: none overlaps another or the end of an arena, none is lost.
TEST(ArenaAllocator, RangesNeverOverlap) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        const ArenaSizes sizes{.arena = 100 + seed, .first = 10 + seed, .count = 1 + seed % 7};
        const std::uint64_t most = 150 + 30 * seed;
        ArenaAllocator arenas(sizes);
        std::map<std::uint32_t, std::uint32_t> used;  // address, size
        std::uint64_t total = 0;
        for (std::uint32_t step = 0; step < 2000; ++step) {
            const std::uint32_t random = shared::hash2(step, 1, seed), size = random / 2 % 40 + 1;
            if (random % 2 == 0 && !used.empty()) {
                const auto it = std::next(used.begin(), static_cast<long>(random / 2 % used.size()));
                arenas.free(it->first, it->second);
                total -= it->second;
                used.erase(it);
            } else if (const auto at = allocateGrowing(arenas, size, most)) {
                const std::uint32_t arena = arenas.arenaOf(*at);
                ASSERT_LT(arena, arenas.arenas().size());
                ASSERT_LE(arenas.offsetOf(*at) + size, arenas.arenas()[arena].capacity());
                const auto next = used.lower_bound(*at);
                ASSERT_TRUE(next == used.end() || *at + size <= next->first);
                ASSERT_TRUE(next == used.begin() || std::prev(next)->first + std::prev(next)->second <= *at);
                used.emplace(*at, size);
                total += size;
            }
            ASSERT_EQ(arenas.capacity() - arenas.freeTotal(), total);
            ASSERT_LE(arenas.capacity(), std::max<std::uint64_t>(most, sizes.first));
            ASSERT_LE(arenas.arenas().size(), sizes.count);
        }
        for (const auto& [address, size] : used) arenas.free(address, size);
        EXPECT_EQ(arenas.freeTotal(), arenas.capacity());
        for (const RangeAllocator& arena : arenas.arenas()) EXPECT_EQ(arena.largestFree(), arena.capacity());
    }
}

}  // namespace
}  // namespace terrane::gpu

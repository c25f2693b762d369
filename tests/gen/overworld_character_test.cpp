// The character of overworlds: how much of them is sea, desert and mountain, rivers that are never
// interrupted, few cave mouths, trees that are whole.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "tests/gen/chunk_area.h"

namespace terrane::gen {
namespace {

// Sanitizers run without optimization.
#ifdef __OPTIMIZE__
constexpr bool kIsOptimized = true;
#else
constexpr bool kIsOptimized = false;
#endif

constexpr int kSampleSide = 18;
constexpr int kSampleStep = 43;  // chunks

struct Shares {
    double sea = 0, desert = 0, mountains = 0, forest = 0;
};

// Shares of the columns of chunks kSampleStep apart, from `corner` on.
Shares sharesFrom(std::uint64_t seed, ChunkPos corner) {
    constexpr int kMountainFoot = 115;  // z
    const Generator generator = overworld(seed);
    const BlockId sand = idOf("sand"), water = idOf("water"), log = idOf("oak_log");
    Shares count;
    for (int k = 0; k < kSampleSide * kSampleSide; ++k) {
        const Area chunk(generator,
                         {corner.x + k % kSampleSide * kSampleStep, corner.y + k / kSampleSide * kSampleStep},
                         1);
        int trunks = 0;
        for (int c = 0; c < 256; ++c) {
            const int x = c % 16, y = c / 16, z = chunk.groundHeight(x, y);
            count.sea += chunk.at(x, y, kSeaLevel) == water;
            count.desert += z > kSeaLevel + 2 && chunk.at(x, y, z) == sand;
            count.mountains += z >= kMountainFoot;
            trunks += chunk.at(x, y, z + 1) == log;
        }
        count.forest += trunks >= 2 ? 256 : 0;
    }
    const double columns = 256.0 * kSampleSide * kSampleSide;
    return {count.sea / columns, count.desert / columns, count.mountains / columns, count.forest / columns};
}

void expectNaturalShares(const Shares& s) {
    EXPECT_GT(s.sea, 0.25);
    EXPECT_LT(s.sea, 0.45);
    EXPECT_GT(s.desert, 0.03);
    EXPECT_LT(s.desert, 0.20);
    EXPECT_GT(s.mountains, 0.04);
    EXPECT_LT(s.mountains, 0.25);
    EXPECT_GT(s.forest, 0.10);
    EXPECT_LT(s.forest, 0.40);
}

TEST(OverworldShares, AreNatural) {
    if (!kIsOptimized) GTEST_SKIP() << "324 chunks take too long without optimization";
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        SCOPED_TRACE(seed);
        expectNaturalShares(sharesFrom(seed, {-400, -400}));
    }
}

TEST(OverworldShares, AreTheSameAtTheWorldsEnds) {
    if (!kIsOptimized) GTEST_SKIP() << "324 chunks take too long without optimization";
    constexpr int kFromEnd = kSampleSide * kSampleStep;
    expectNaturalShares(sharesFrom(4, {world::kMinChunk, world::kMinChunk}));
    expectNaturalShares(sharesFrom(5, {world::kMaxChunk - kFromEnd, world::kMaxChunk - kFromEnd}));
}

// Columns where one can walk from under the sky into a cave: air under a roof of at least two blocks, beside
// air without one.
int mouthColumns(const Area& a) {
    std::vector<int> heights;
    const int side = a.blocks();
    for (int k = 0; k < side * side; ++k) heights.push_back(a.groundHeight(k % side, k / side));
    const auto height = [&](int x, int y) { return heights[static_cast<std::size_t>(y * side + x)]; };
    int count = 0;
    for (int y = 1; y + 1 < side; ++y) {
        for (int x = 1; x + 1 < side; ++x) {
            const int outside = std::min(std::min(height(x - 1, y), height(x + 1, y)),
                                         std::min(height(x, y - 1), height(x, y + 1)));
            bool isMouth = false;
            for (int z = outside + 1; z + 2 < height(x, y); ++z) isMouth |= a.at(x, y, z) == world::kAir;
            count += isMouth;
        }
    }
    return count;
}

TEST(OverworldCaves, HaveFewMouths) {
    constexpr int kMouthSide = kSampleSide;
    int mouths = 0, columns = 0;
    for (const std::uint64_t seed : {1u, 2u, 5u}) {
        const Generator generator = overworld(seed);
        for (const ChunkPos corner : {ChunkPos{-60, -30}, ChunkPos{10, 20}, ChunkPos{40, -50}}) {
            const Area a(generator, corner, kMouthSide);
            mouths += mouthColumns(a);
            columns += a.blocks() * a.blocks();
        }
    }
    EXPECT_LT(mouths, columns / 500);
#ifdef __OPTIMIZE__
    EXPECT_GT(mouths, columns / 50000);
#endif
}

struct RiverCourse {
    std::uint64_t seed;
    ChunkPos corner;
    int chunks;
};

// Whether water at sea level leads from one end of the area to the other along y.
bool waterCrosses(const Area& a) {
    const BlockId water = idOf("water");
    const int side = a.blocks();
    std::vector<bool> isReached(static_cast<std::size_t>(side * side));
    std::vector<int> open;
    const auto reach = [&](int x, int y) {
        if (x < 0 || y < 0 || x >= side || y >= side) return;
        const auto k = static_cast<std::size_t>(y * side + x);
        if (isReached[k] || a.at(x, y, kSeaLevel) != water) return;
        isReached[k] = true;
        open.push_back(y * side + x);
    };
    for (int x = 0; x < side; ++x) reach(x, 0);
    while (!open.empty()) {
        const int x = open.back() % side, y = open.back() / side;
        if (y == side - 1) return true;
        open.pop_back();
        reach(x - 1, y);
        reach(x + 1, y);
        reach(x, y - 1);
        reach(x, y + 1);
    }
    return false;
}

constexpr std::array<RiverCourse, 3> kCourses = {{{3, {-19, 39}, 20}, {1, {35, 55}, 10}, {3, {-30, -2}, 12}}};

// Courses that cross a desert, plains and a forest; from maps.
TEST(OverworldRivers, AreNeverInterrupted) {
    for (const RiverCourse& course : kCourses) {
        SCOPED_TRACE(testing::PrintToString(course.corner));
        EXPECT_TRUE(waterCrosses(Area(overworld(course.seed), course.corner, course.chunks)));
    }
}

// A leaf goes on into the next column as often across a border of chunks as inside of a chunk.
TEST(OverworldTrees, AreNotCutBetweenChunks) {
    const BlockId leaves = idOf("oak_leaves");
    const Area a(overworld(3), {-24, -32}, 8);
    std::array<double, 2> pairs{}, both{};
    for (int z = kSeaLevel; z < 140; ++z) {
        for (int y = 0; y < a.blocks(); ++y) {
            for (int x = 0; x + 1 < a.blocks(); ++x) {
                if (a.at(x, y, z) != leaves) continue;
                const std::size_t isAcross = x % 16 == 15;
                pairs[isAcross] += 1;
                both[isAcross] += a.at(x + 1, y, z) == leaves;
            }
        }
    }
    ASSERT_GT(pairs[1], 200) << "a forest stands here";
    EXPECT_NEAR(both[0] / pairs[0], both[1] / pairs[1], 0.05);
}

}  // namespace
}  // namespace terrane::gen

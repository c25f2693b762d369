#include "terrane/gen/drainage/drainage_maps.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <span>
#include <thread>

#include "tests/gen/drainage_land.h"

namespace terrane::gen {
namespace {

// A region of many rivers.
constexpr std::int32_t kCells = 128, kBlocks = kCells * kDrainageSpec.spacing;

DrainageHeights heightsOf(std::uint64_t seed) {
    return {DrainageRunner(seed).graph.drainages[0], seed};
}

// The distance to the course that counts by plain floats from all segments of a region, without tiles.
struct Reference {
    float distance = kNoRiver, halfWidth = 0, level = 0, flow = 0, fall = 0;
};

// Shorter than courses leave their node's cell.
constexpr float kShortReach = 18.0f;

Reference nearestRiver(const DrainageRegion& region, std::int32_t x, std::int32_t y) {
    Reference best;
    float bestPower = std::numeric_limits<float>::max();
    const float reach2 = kShortReach * kShortReach;
    for (const CourseSegment& s : region.segments) {
        const float dx = static_cast<float>(s.to.x - s.from.x) / 16.0f,
                    dy = static_cast<float>(s.to.y - s.from.y) / 16.0f;
        const float fromX = static_cast<float>(x * 16 - s.from.x) / 16.0f,
                    fromY = static_cast<float>(y * 16 - s.from.y) / 16.0f;
        const float t =
            std::clamp((fromX * dx + fromY * dy) * shared::detDivide(1.0f, dx * dx + dy * dy), 0.0f, 1.0f);
        const float offX = fromX - t * dx, offY = fromY - t * dy, distance2 = offX * offX + offY * offY;
        const float halfWidth = s.from.halfWidth + t * (s.to.halfWidth - s.from.halfWidth);
        const float power = distance2 - halfWidth * halfWidth;
        if (distance2 >= reach2 || power >= bestPower) continue;
        bestPower = power;
        best = {shared::detSqrt(distance2), halfWidth, s.from.level + t * (s.to.level - s.from.level),
                s.from.flow + t * (s.to.flow - s.from.flow),
                (s.from.level - s.to.level) * shared::detSqrt(shared::detDivide(1.0f, dx * dx + dy * dy))};
    }
    return best;
}

TEST(DrainageMaps, ColumnsFindTheRiverThatCounts) {
    const DrainageRegion region = makeDrainageRegion(heightsOf(kTestSeed), {0, 0}, kCells);
    DrainageSpec spec = kDrainageSpec;
    spec.reach = kShortReach;
    DrainageRunner runner(kTestSeed, 0, spec);
    int found = 0;
    const auto isInside = [](std::int32_t v) { return v > 200 && v < kBlocks - 200; };
    onEachTarget([&] {
        for (std::uint32_t k = 0; k < kRandomCases / 4; ++k) {
            // As far from some segment as the map sees, away from the region's border, so that it has all
            // that is near.
            const std::uint32_t h = shared::hash2(k, 0, 5);
            const CourseSegment& s = region.segments[h % region.segments.size()];
            const std::int32_t x = s.from.x / 16 + static_cast<std::int32_t>(h >> 8 & 127) % 37 - 18;
            const std::int32_t y = s.from.y / 16 + static_cast<std::int32_t>(h >> 16 & 127) % 37 - 18;
            if (!isInside(x) || !isInside(y)) continue;
            const DrainageResults results = runner.run({x >> 4, y >> 4});
            for (std::int32_t column = ((x & 15) + 16 * (y & 15)) % 61; column < 256; column += 61) {
                const std::int32_t atX = (x & ~15) + column % 16, atY = (y & ~15) + column / 16;
                const auto lane = static_cast<std::size_t>(column);
                const Reference expected = nearestRiver(region, atX, atY);
                ASSERT_EQ(asFloat(results[0][lane]), expected.distance) << atX << "," << atY;
                ASSERT_EQ(asFloat(results[1][lane]), expected.halfWidth) << atX << "," << atY;
                ASSERT_EQ(asFloat(results[2][lane]), expected.level) << atX << "," << atY;
                ASSERT_EQ(asFloat(results[3][lane]), expected.flow) << atX << "," << atY;
                ASSERT_EQ(asFloat(results[6][lane]), expected.fall) << atX << "," << atY;
                found += expected.distance < kNoRiver;
            }
        }
    });
    EXPECT_GT(found, static_cast<int>(kRandomCases / 2));
}

// Means over all pieces of a region, in double precision.
std::array<double, 3> valleyReference(const DrainageRegion& region, double reach, std::int32_t x,
                                      std::int32_t y) {
    double weights = 0, distances = 0, levels = 0, flows = 0;
    for (const CourseSegment& s : region.segments) {
        const double fromX = x - s.from.x / 16.0, fromY = y - s.from.y / 16.0;
        if (std::abs(fromX) > 2 * reach || std::abs(fromY) > 2 * reach) continue;
        const double dx = (s.to.x - s.from.x) / 16.0, dy = (s.to.y - s.from.y) / 16.0;
        const double t = std::clamp((fromX * dx + fromY * dy) / (dx * dx + dy * dy), 0.0, 1.0);
        const double offX = fromX - t * dx, offY = fromY - t * dy, distance2 = offX * offX + offY * offY;
        if (distance2 >= reach * reach) continue;
        const double part = 1 / (distance2 + 1) - 1 / (reach * reach + 1), weight = part * part;
        weights += weight;
        distances += weight * std::sqrt(distance2 + 1);
        levels += weight * (s.from.level + t * (s.to.level - s.from.level));
        flows += weight * (s.from.flow + t * (s.to.flow - s.from.flow));
    }
    if (weights < 1e-19) return {kNoRiver, 0, 0};
    return {distances / weights, levels / weights, flows / weights};
}

TEST(DrainageMaps, ValleysAreMeansOfTheStreamsAround) {
    DrainageRunner runner(kTestSeed, 0, kDrainageSpec, Valleys::Yes);
    const DrainageRegion region = makeDrainageRegion({runner.graph.drainages[0], kTestSeed}, {0, 0}, kCells);
    const double reach = valleyReach(kDrainageSpec);
    int found = 0, dry = 0;
    for (const CourseSegment& s : region.segments) dry += s.from.halfWidth == 0 && s.to.halfWidth == 0;
    EXPECT_GT(dry, static_cast<int>(region.segments.size() / 4)) << "valleys without a river";
    onEachTarget([&] {
        for (std::uint32_t k = 0; k < 200; ++k) {
            const std::uint32_t h = shared::hash2(k, 1, 5);
            const auto x = static_cast<std::int32_t>(h % (kBlocks - 800)) + 400;
            const auto y = static_cast<std::int32_t>((h >> 8) % (kBlocks - 800)) + 400;
            const DrainageResults results = runner.run({x >> 4, y >> 4});
            const auto lane = static_cast<std::size_t>((x & 15) + 16 * (y & 15));
            const auto at = [&](int dx, int dy) {
                return valleyReference(region, reach,
                                       (x & -shared::kValleyBlocks) + dx * shared::kValleyBlocks,
                                       (y & -shared::kValleyBlocks) + dy * shared::kValleyBlocks);
            };
            std::array<double, 3> expected{};
            const double partX = (x % shared::kValleyBlocks) / double{shared::kValleyBlocks},
                         partY = (y % shared::kValleyBlocks) / double{shared::kValleyBlocks};
            for (std::size_t r = 0; r < 3; ++r) {
                const double low = std::lerp(at(0, 0)[r], at(1, 0)[r], partX),
                             high = std::lerp(at(0, 1)[r], at(1, 1)[r], partX);
                expected[r] = std::lerp(low, high, partY);
            }
            if (expected[0] > 0.98 * reach && expected[0] < kNoRiver) continue;  // next to none
            for (std::size_t r = 0; r < 3; ++r)
                ASSERT_NEAR(asFloat(results[7 + r][lane]), expected[r], 2e-3 + expected[r] * 1e-4)
                    << x << "," << y;
            found += expected[0] < kNoRiver;
        }
    });
    EXPECT_GT(found, 50);
}

// Beside a stream, its level and the distance to it count alone.
TEST(DrainageMaps, ValleysAreTheStreamAtTheStream) {
    DrainageRunner runner(kTestSeed, 0, kDrainageSpec, Valleys::Yes);
    const DrainageRegion region = makeDrainageRegion({runner.graph.drainages[0], kTestSeed}, {0, 0}, kCells);
    for (std::uint32_t k = 0; k < 100; ++k) {
        const CourseSegment& s = region.segments[shared::hash2(k, 2, 5) % region.segments.size()];
        const std::int32_t x = s.from.x / 16, y = s.from.y / 16;
        const DrainageResults results = runner.run({x >> 4, y >> 4});
        const auto lane = static_cast<std::size_t>((x & 15) + 16 * (y & 15));
        EXPECT_LT(asFloat(results[7][lane]), 4.0f);
        EXPECT_NEAR(asFloat(results[8][lane]), s.from.level, 3.0f);
    }
}

TEST(DrainageMaps, LakesHaveTheirShores) {
    DrainageSpec spec = kDrainageSpec;
    spec.lakeDepth = 2.0f;
    DrainageRunner runner(kTestSeed, 0, spec);
    const DrainageRegion region = makeDrainageRegion({runner.graph.drainages[0], kTestSeed}, {0, 0}, kCells);
    ASSERT_GT(region.lakes.size(), 2u);
    const auto isWithin = [](std::int32_t v) { return v > 8192 && v < kBlocks * 16 - 8192; };
    int looked = 0;
    for (const LakeDisc& lake : region.lakes) {
        if (!isWithin(lake.x) || !isWithin(lake.y)) continue;
        const std::int32_t x = lake.x / 16, y = lake.y / 16;
        const DrainageResults results = runner.run({x >> 4, y >> 4});
        const auto column = static_cast<std::size_t>((x & 15) + 16 * (y & 15));
        EXPECT_NEAR(asFloat(results[4][column]), -lake.radius, 1.5f);
        EXPECT_EQ(asFloat(results[5][column]), lake.level);
        ++looked;
    }
    EXPECT_GT(looked, 0);
}

// A river through a lake is as high as the lake, as far as the shore.
TEST(DrainageMaps, RiversInLakesHaveTheirLevel) {
    DrainageSpec spec = kDrainageSpec;
    spec.seaLevel = 20.0f;
    spec.lakeDepth = 2.0f;
    spec.bend = 0.0f;
    const DrainageRegion region =
        makeDrainageRegion({DrainageRunner(7, 0, spec).graph.drainages[0], 7}, {0, 0}, kCells);
    int inside = 0;
    for (const CellCourses& cell : region.cells) {
        if (cell.lake < 0) continue;
        const LakeDisc& lake = region.lakes[static_cast<std::size_t>(cell.lake)];
        for (std::uint32_t k = 0; k < cell.segmentCount; ++k) {
            const CoursePoint& p = region.segments[cell.firstSegment + k].to;
            // The last fifth of a way leads down to the shore where the next node is near.
            if (std::hypot(p.x - lake.x, p.y - lake.y) > 16.0f * 0.22f * 64.0f * 0.5f) continue;
            EXPECT_NEAR(p.level, lake.level, 0.01f);
            ++inside;
        }
    }
    EXPECT_GT(inside, 50);
}

// Water that flows from a segment's end flows on at another's beginning, as wide and as high.
TEST(DrainageMaps, CoursesHaveNoGapsAndNeverRise) {
    const DrainageRegion region = makeDrainageRegion(heightsOf(7), {64, -64}, kCells);
    ASSERT_GT(region.segments.size(), 500u);
    std::multimap<std::pair<std::int32_t, std::int32_t>, const CourseSegment*> begins;
    for (const CourseSegment& s : region.segments) begins.emplace(std::pair(s.from.x, s.from.y), &s);
    int ends = 0, rises = 0;
    const auto isInside = [](std::int32_t v) { return v > 1280 && v < (kBlocks - 80) * 16; };
    const auto isLake = [&](const CoursePoint& p) {
        return std::any_of(region.lakes.begin(), region.lakes.end(),
                           [&](const LakeDisc& l) { return l.x == p.x && l.y == p.y; });
    };
    for (const CourseSegment& s : region.segments) {
        rises += s.to.level > s.from.level;
        EXPECT_GE(s.to.level, kDrainageSpec.seaLevel);
        const auto [first, last] = begins.equal_range({s.to.x, s.to.y});
        if (first == last && isInside(s.to.x) && isInside(s.to.y) && !isLake(s.to)) {
            EXPECT_EQ(s.to.level, kDrainageSpec.seaLevel) << "water ends on land";
            ++ends;
        }
        // Another river may begin a segment where it crosses this one on its way to the same end.
        EXPECT_TRUE(first == last || std::any_of(first, last, [&](const auto& next) {
                        const CoursePoint& from = next.second->from;
                        return from.level == s.to.level && from.halfWidth == s.to.halfWidth &&
                               from.flow == s.to.flow;
                    }));
    }
    EXPECT_EQ(rises, 0);
    EXPECT_GT(ends, 10);
}

TEST(DrainageMaps, RegionsMeetWithoutSeams) {
    DrainageSpec spec = kDrainageSpec;
    spec.seaLevel = 20.0f;  // much land: long rivers
    const DrainageHeights heights(DrainageRunner(7, 0, spec).graph.drainages[0], 7);
    const DrainageRegion whole = makeDrainageRegion(heights, {0, 0}, kCells),
                         shifted = makeDrainageRegion(heights, {32, 24}, kCells);
    ASSERT_GT(whole.segments.size(), 5000u);
    for (std::int32_t y = 24; y < kCells; ++y) {
        for (std::int32_t x = 32; x < kCells; ++x) {
            const CellCourses& a = whole.cells[static_cast<std::size_t>(y * kCells + x)];
            const CellCourses& b = shifted.cells[static_cast<std::size_t>((y - 24) * kCells + x - 32)];
            ASSERT_EQ(a.segmentCount, b.segmentCount) << x << "," << y;
            ASSERT_EQ(a.lake < 0, b.lake < 0) << x << "," << y;
            for (std::uint32_t k = 0; k < a.segmentCount; ++k) {
                const CourseSegment &s = whole.segments[a.firstSegment + k],
                                    &t = shifted.segments[b.firstSegment + k];
                ASSERT_EQ(s.from.x, t.from.x + 32 * 64 * 16);
                ASSERT_EQ(s.to.y, t.to.y + 24 * 64 * 16);
                ASSERT_EQ(s.to.level, t.to.level);
                ASSERT_EQ(s.to.halfWidth, t.to.halfWidth);
            }
        }
    }
}

TEST(DrainageMaps, IsTheSameInAnyOrderAndOnAnyThread) {
    std::vector<ChunkPos> chunks;
    for (int k = 0; k < 12; ++k) chunks.push_back({k * 20 - 120, 250 + k});
    DrainageRunner one(kTestSeed);
    std::vector<DrainageResults> expected;
    for (const ChunkPos c : chunks) expected.push_back(one.run(c));
    DrainageRunner common(kTestSeed);
    std::vector<std::thread> threads;
    std::vector<int> different(4);
    for (std::size_t t = 0; t < different.size(); ++t) {
        threads.emplace_back([&, t] {
            for (std::size_t k = 0; k < chunks.size(); ++k) {
                const std::size_t n = t % 2 == 0 ? chunks.size() - 1 - k : (k * 5 + t) % chunks.size();
                DrainageTile tile, other;
                common.maps.prepare(tile, 0, sampleGrid(chunks[n]));
                one.maps.prepare(other, 0, sampleGrid(chunks[n]));
                const auto bytes = std::as_bytes(std::span(tile.segments));
                const bool same = std::ranges::equal(bytes, std::as_bytes(std::span(other.segments)));
                different[t] += !same;
            }
        });
    }
    for (std::thread& t : threads) t.join();
    EXPECT_EQ(different, std::vector<int>(4));
    DrainageRunner again(kTestSeed);
    for (std::size_t k = chunks.size(); k-- > 0;) EXPECT_EQ(again.run(chunks[k]), expected[k]);
}

TEST(DrainageMaps, LevelsAgree) {
    DrainageRunner near(kTestSeed);
    for (const int level : {2, 5}) {
        DrainageRunner far(kTestSeed, level);
        const auto hasRiver = [&](const DrainageResults& results) {
            return std::ranges::any_of(results[0],
                                       [](Bits distance) { return asFloat(distance) < kNoRiver; });
        };
        ChunkPos at{5, 3, static_cast<std::uint8_t>(level)};
        while (!hasRiver(far.run(at))) ASSERT_LT(++at.x, 1000);
        const int step = 1 << level;
        const DrainageResults tile = far.run(at);
        const SampleGrid grid = sampleGrid(at);
        for (int k = 0; k < 256; k += 5) {
            const std::int32_t x = grid.x + k % 16 * step, y = grid.y + k / 16 * step;
            const DrainageResults chunk = near.run({x >> 4, y >> 4});
            for (std::size_t r = 0; r < kDrainageResultCount; ++r) {
                ASSERT_EQ(chunk[r][static_cast<std::size_t>((x & 15) + 16 * (y & 15))],
                          tile[r][static_cast<std::size_t>(k)])
                    << x << "," << y;
            }
        }
    }
    DrainageRunner tooFar(kTestSeed, 6);
    const DrainageResults beyond = tooFar.run({0, 0, 6});
    for (const Bits distance : beyond[0]) EXPECT_EQ(asFloat(distance), kNoRiver);
}

// Neighbors on both sides of the world's edge, and of region borders, see nearly the same.
TEST(DrainageMaps, NothingBreaksAtTheWorldsEdge) {
    DrainageRunner runner(3);
    int found = 0;
    for (int k = 0; k < 24; ++k) {
        const ChunkPos west = {world::kMaxChunk, world::kMinChunk + k},
                       east = {world::kMinChunk, world::kMinChunk + k};
        const DrainageResults a = runner.run(west), b = runner.run(east);
        for (std::size_t row = 0; row < 16; ++row) {
            const float left = asFloat(a[0][row * 16 + 15]), right = asFloat(b[0][row * 16]);
            if (left > kDrainageSpec.reach - 2 || right > kDrainageSpec.reach - 2) continue;
            // The river that counts may change from one column to the next.
            EXPECT_NEAR(left, right, 4.0f) << "chunk row " << k;
            EXPECT_NEAR(asFloat(a[3][row * 16 + 15]), asFloat(b[3][row * 16]), 40.0f);
            ++found;
        }
    }
    EXPECT_GT(found, 20);
}

TEST(DrainageMaps, KeepsABoundedNumberOfRegions) {
    DrainageMaps maps(DrainageRunner(kTestSeed).graph.drainages, kTestSeed);
    DrainageTile tile;
    constexpr std::int32_t kRegionBlocks = kRegionCells * kDrainageSpec.spacing;
    for (std::size_t k = 0; k < kMaxCachedRegions + 3; ++k) {
        const auto x = static_cast<std::int32_t>(k) * kRegionBlocks + kRegionBlocks / 2;
        maps.prepare(tile, 0, {x, kRegionBlocks / 2, 1});
        EXPECT_LT(maps.bytes(), std::size_t{16} << 20);
        EXPECT_EQ(maps.cachedRegions(), std::min(k + 1, kMaxCachedRegions));
    }
}

// A river at every node makes regions several times as large.
TEST(DrainageMaps, KeepsABoundedNumberOfBytes) {
    std::vector<DrainageGraph> graphs = DrainageRunner(kTestSeed).graph.drainages;
    graphs.front().spec.minFlow = 1;
    DrainageMaps maps(graphs, kTestSeed);
    DrainageTile tile;
    constexpr std::int32_t kRegionBlocks = kRegionCells * kDrainageSpec.spacing;
    for (std::int32_t k = 0; k < static_cast<std::int32_t>(kMaxCachedRegions); ++k) {
        maps.prepare(tile, 0, {k * kRegionBlocks + kRegionBlocks / 2, kRegionBlocks / 2, 1});
        EXPECT_LE(maps.bytes(), kMaxCachedRegionBytes);
    }
    EXPECT_LT(maps.cachedRegions(), kMaxCachedRegions);
    EXPECT_GT(maps.cachedRegions(), 0u);
}

// Every river reaches the sea or a lake, whatever the seed.
TEST(DrainageMaps, RiversReachTheSeaOrALake) {
    for (const std::uint64_t seed : {1u, 2u, 3u}) {
        const DrainageHeights heights = heightsOf(seed);
        constexpr int kMargin = 88, kSide = 2 * kMargin + 48;
        DrainageNetwork n;
        n.side = kSide;
        n.heights = heights.nodes({0, 0}, kSide).heights;
        findDrainage(n, kDrainageSpec);
        const HeightKey sea = heightKey(kDrainageSpec.seaLevel, 0);
        int rivers = 0, arrived = 0, left = 0;
        for (int y = kMargin; y < kSide - kMargin; ++y) {
            for (int x = kMargin; x < kSide - kMargin; ++x) {
                std::size_t node = n.at(x, y);
                if (n.heights[node] < sea || n.flows[node] < kDrainageSpec.minFlow) continue;
                ++rivers;
                while (n.drains[node] != kNoDrain) {
                    EXPECT_TRUE(n.flows[n.drainOf(node)] >= kDrainageSpec.minFlow ||
                                n.heights[n.drainOf(node)] < sea);
                    node = n.drainOf(node);
                }
                const auto column = static_cast<int>(node % kSide), row = static_cast<int>(node / kSide);
                const bool isOutside = column < kFloodReach + 1 || row < kFloodReach + 1 ||
                                       column > kSide - kFloodReach - 2 || row > kSide - kFloodReach - 2;
                arrived += n.heights[node] < sea || n.lakeNodes[node] > 0;
                left += isOutside && n.heights[node] >= sea && n.lakeNodes[node] == 0;
            }
        }
        EXPECT_GT(rivers, 30) << "seed " << seed;
        EXPECT_EQ(arrived + left, rivers) << "seed " << seed;
        EXPECT_GT(arrived * 2, rivers) << "seed " << seed;
    }
}

}  // namespace
}  // namespace terrane::gen

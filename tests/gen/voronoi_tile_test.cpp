#include "terrane/gen/noise/voronoi_tile.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/gen/noise_reference.h"
#include "tests/gen/noise_tile.h"
#include "tests/support/depth.h"

namespace terrane::gen {
namespace {

constexpr std::uint32_t kVoronoiSeed = 0xBEEFu;

NoiseCall cells(int size, int maxPoints) {
    return {NoiseKind::Voronoi2D, "v", size, {}, maxPoints};
}

std::string sizeAndPoints(const NoiseCall& call) {
    return "size " + std::to_string(call.size) + ", " + std::to_string(call.maxPoints) + " points";
}

// 9×9 cells, where the tile looks at 5×5.
constexpr int kReach = 4;

void expectColumn(const NoiseTile& tile, const NoiseCall& call, ChunkPos chunk, int x, int y) {
    const SampleGrid grid = sampleGrid(chunk);
    const std::int64_t blockX = std::int64_t{grid.x} + x * grid.step;
    const std::int64_t blockY = std::int64_t{grid.y} + y * grid.step;
    const reference::VoronoiSample want = reference::voronoi2D(call, kVoronoiSeed, blockX, blockY, kReach);
    SCOPED_TRACE(sizeAndPoints(call) + " at (" + std::to_string(blockX) + ", " + std::to_string(blockY) +
                 ")");
    ASSERT_EQ(tile.at(x, y, kVoronoiDistance), bitsOf(want.distance));
    ASSERT_EQ(tile.at(x, y, kVoronoiRatio), bitsOf(want.ratio));
    ASSERT_EQ(asInt(tile.at(x, y, kVoronoiOffsetX)), want.offsetX);
    ASSERT_EQ(asInt(tile.at(x, y, kVoronoiOffsetY)), want.offsetY);
}

TEST(Voronoi2D, EverySampleIsThatOfASearchOfMoreCells) {
    onEachTarget([] {
        for (const int size : {1, 2, 3, 10, 56, 512, kMaxVoronoiSize}) {
            for (int maxPoints = 1; maxPoints <= 4; ++maxPoints) {
                NoiseTile tile(cells(size, maxPoints), kVoronoiSeed);
                for (const ChunkPos chunk : kPlaces) {
                    tile.moveTo(chunk);
                    tile.run();
                    // Steps without a factor in common with 16 meet every row and every column.
                    for (int lane = 0; lane < kTileLanes; lane += 7) {
                        ASSERT_NO_FATAL_FAILURE(
                            expectColumn(tile, cells(size, maxPoints), chunk, lane % 16, lane / 16));
                    }
                }
            }
        }
    });
}

// Columns lie 2^level blocks apart; cells are as wide as a column at least.
TEST(Voronoi2D, EverySampleOfATileIsThatOfASearchOfMoreCells) {
    onEachTarget([] {
        for (const int level : {1, 2, 3, 7, 11, 14}) {
            const std::int32_t step = 1 << level;
            for (const int size : {step, step * 3 / 2, step * 7, kMaxVoronoiSize}) {
                if (size > kMaxVoronoiSize) continue;
                const NoiseCall call = cells(size, 1 + level % 4);
                NoiseTile tile(call, kVoronoiSeed);
                for (const ChunkPos chunk : placesOf(level)) {
                    tile.moveTo(chunk);
                    tile.run();
                    for (int lane = 0; lane < kTileLanes; lane += 7) {
                        ASSERT_NO_FATAL_FAILURE(expectColumn(tile, call, chunk, lane % 16, lane / 16));
                    }
                }
            }
        }
    });
}

TEST(Voronoi2D, ManyTilesAgreeWithASearchOfMoreCells) {
    for (const int size : {3, 10, 64}) {
        for (const int maxPoints : {1, 2, 4}) {
            const NoiseCall call = cells(size, maxPoints);
            NoiseTile tile(call, kVoronoiSeed);
            for (std::int32_t k = -40; k < 40; ++k) {
                const ChunkPos chunk = {k, 13 * k};
                tile.moveTo(chunk);
                tile.run();
                for (int lane = 0; lane < kTileLanes; lane += 37) {
                    ASSERT_NO_FATAL_FAILURE(expectColumn(tile, call, chunk, lane % 16, lane / 16));
                }
            }
        }
    }
}

// With one point a cell the second nearest lies two cells away for one column in 10,000.
TEST(Voronoi2D, PointsTwoCellsAwayAreFound) {
    const NoiseCall call = cells(16, 1);
    NoiseTile tile(call, kVoronoiSeed);
    for (std::int32_t k = 0; k < 1500; ++k) {
        const ChunkPos chunk = {k, -7 * k};
        tile.moveTo(chunk);
        tile.run();
        for (int lane = 0; lane < kTileLanes; ++lane) {
            const int x = lane % 16, y = lane / 16;
            const auto want = reference::voronoi2D(call, kVoronoiSeed, chunk.x * 16 + x, chunk.y * 16 + y, 2);
            ASSERT_EQ(tile.at(x, y, kVoronoiRatio), bitsOf(want.ratio))
                << "chunk (" << chunk.x << ", " << chunk.y << "), column " << lane;
        }
    }
}

TEST(Voronoi2D, ResultsAreInRange) {
    for (const int size : {1, 10, 100}) {
        NoiseTile tile(cells(size, 3), kVoronoiSeed);
        for (std::int32_t k = 0; k < 60; ++k) {
            tile.moveTo({k, -k});
            tile.run();
            for (int lane = 0; lane < kTileLanes; ++lane) {
                const float distance = tile.floatAt(lane % 16, lane / 16, kVoronoiDistance);
                const float ratio = tile.floatAt(lane % 16, lane / 16, kVoronoiRatio);
                ASSERT_GE(distance, 0.0f);
                ASSERT_LE(distance, 1.5f * static_cast<float>(size)) << "the own cell has a point";
                ASSERT_GE(ratio, 0.0f);
                ASSERT_LE(ratio, 1.0f);
            }
        }
    }
}

TEST(Voronoi2D, AtAPointTheDistanceIsZero) {
    NoiseTile tile(cells(10, 1), kVoronoiSeed);
    int points = 0;
    for (std::int32_t k = 0; k < 40; ++k) {
        tile.moveTo({k, k});
        tile.run();
        for (int lane = 0; lane < kTileLanes; ++lane) {
            const int x = lane % 16, y = lane / 16;
            if (tile.at(x, y, kVoronoiOffsetX) != 0 || tile.at(x, y, kVoronoiOffsetY) != 0) continue;
            ++points;
            ASSERT_EQ(tile.at(x, y, kVoronoiDistance), bitsOf(0.0f));
            ASSERT_EQ(tile.at(x, y, kVoronoiRatio), bitsOf(0.0f));
        }
    }
    EXPECT_NEAR(points, 40 * 256 / 100, 15) << "one a cell of 100 columns";
}

// In small cells many columns have two points at equal distance: the search order decides.
TEST(Voronoi2D, OfEquallyNearPointsTheFirstCounts) {
    NoiseTile tile(cells(2, 4), kVoronoiSeed);
    tile.moveTo({0, 0});
    tile.run();
    for (int lane = 0; lane < kTileLanes; ++lane) {
        ASSERT_NO_FATAL_FAILURE(expectColumn(tile, cells(2, 4), {0, 0}, lane % 16, lane / 16));
    }
}

TEST(Voronoi2D, APointIsTheSameForAllWhoSeeIt) {
    std::set<std::pair<int, int>> seen;
    NoiseTile tile(cells(40, 1), kVoronoiSeed);
    for (std::int32_t cy = 0; cy < 10; ++cy) {
        for (std::int32_t cx = 0; cx < 10; ++cx) {
            tile.moveTo({cx, cy});
            tile.run();
            for (int lane = 0; lane < kTileLanes; ++lane) {
                const int x = lane % 16, y = lane / 16;
                seen.emplace(16 * cx + x + asInt(tile.at(x, y, kVoronoiOffsetX)),
                             16 * cy + y + asInt(tile.at(x, y, kVoronoiOffsetY)));
            }
        }
    }
    // 160 × 160 blocks are 4 × 4 cells; of the ring around them some points are near too.
    EXPECT_GE(seen.size(), 14u);
    EXPECT_LE(seen.size(), 36u);
}

// The purpose of the tile: far points are not searched for every column.
TEST(Voronoi2D, OnlyPointsThatMayBeNearAreKept) {
    NoiseTile large(cells(512, 2), kVoronoiSeed), small(cells(10, 1), kVoronoiSeed);
    large.moveTo({5, 5});
    small.moveTo({5, 5});
    EXPECT_LE(large.pointCount(), 8u);
    EXPECT_LE(small.pointCount(), 49u) << "25 cells and what the tile spans";
}

NoiseCall solidCells(int size, int maxPoints, int exponent) {
    return {NoiseKind::Voronoi3D, "v", size, {}, maxPoints, exponent};
}

void expectVoxel(const NoiseTile& tile, const NoiseCall& call, std::array<std::int64_t, 3> block, int reach) {
    const reference::Voronoi3DSample want = reference::voronoi3D(call, kVoronoiSeed, block, reach);
    const int level = tile.chunk().level;
    const int x = static_cast<int>(block[0] >> level & 15), y = static_cast<int>(block[1] >> level & 15);
    SCOPED_TRACE(sizeAndPoints(call) + ", exponent " + std::to_string(call.exponent) + " at (" +
                 std::to_string(block[0]) + ", " + std::to_string(block[1]) + ", " +
                 std::to_string(block[2]) + ")");
    ASSERT_EQ(tile.at(x, y, kVoronoi3DNearest), bitsOf(want.nearest));
    ASSERT_EQ(tile.at(x, y, kVoronoi3DSecond), bitsOf(want.second));
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
        ASSERT_EQ(asInt(tile.at(x, y, kVoronoi3DOffsetX + axis)), want.offset[axis]);
    }
}

const std::size_t kPlaceStep = atDepth<std::size_t>(4, 1);  // one of so many places

// 7³ cells, where the tile looks at 5³. Layers in an order that goes back and jumps.
TEST(Voronoi3D, EverySampleIsThatOfASearchOfMoreCells) {
    onEachTarget([] {
        for (const int size : {1, 5, 32, 200}) {
            for (const auto& [maxPoints, exponent] : {std::pair(1, 2), {3, 4}, {2, 8}, {4, 3}}) {
                const NoiseCall call = solidCells(size, maxPoints, exponent);
                NoiseTile tile(call, kVoronoiSeed);
                for (std::size_t place = 0; place < kPlaces.size(); place += kPlaceStep) {
                    const ChunkPos chunk = kPlaces[place];
                    tile.moveTo(chunk);
                    for (const std::int32_t z : {0, 1, 40, 39, 255, 100}) {
                        tile.run(z);
                        for (int lane = z % 29; lane < kTileLanes; lane += 83) {
                            const std::array<std::int64_t, 3> block = {std::int64_t{chunk.x} * 16 + lane % 16,
                                                                       std::int64_t{chunk.y} * 16 + lane / 16,
                                                                       z};
                            ASSERT_NO_FATAL_FAILURE(expectVoxel(tile, call, block, 3));
                        }
                    }
                }
            }
        }
    });
}

TEST(Voronoi3D, EverySampleOfATileIsThatOfASearchOfMoreCells) {
    for (const int level : {1, 3, 5}) {
        for (const int size : {1 << level, 5 << level}) {
            const NoiseCall call = solidCells(size, 2, 3);
            NoiseTile tile(call, kVoronoiSeed);
            for (const ChunkPos chunk : placesOf(level)) {
                tile.moveTo(chunk);
                const SampleGrid grid = sampleGrid(chunk);
                for (const std::int32_t z : {0, 41, 255}) {
                    tile.run(z);
                    for (int lane = z % 29; lane < kTileLanes; lane += 83) {
                        const std::array<std::int64_t, 3> block = {
                            std::int64_t{grid.x} + lane % 16 * grid.step,
                            std::int64_t{grid.y} + lane / 16 * grid.step, z};
                        ASSERT_NO_FATAL_FAILURE(expectVoxel(tile, call, block, 3));
                    }
                }
            }
        }
    }
}

}  // namespace
}  // namespace terrane::gen

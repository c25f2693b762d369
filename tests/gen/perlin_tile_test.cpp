#include "terrane/gen/noise/perlin_tile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/gen/noise_reference.h"
#include "tests/gen/noise_tile.h"

namespace terrane::gen {
namespace {

constexpr std::uint32_t kPerlinSeed = 0xC0FFEEu;

NoiseCall call2D(int size, std::vector<float> weights) {
    return {NoiseKind::Perlin2D, "n", size, std::move(weights)};
}

NoiseCall call3D(int size, std::vector<float> weights) {
    return {NoiseKind::Perlin3D, "n", size, std::move(weights)};
}

// The largest lattices and most octaves, lattices that do not divide a chunk, and those of one block.
std::vector<NoiseCall> calls(NoiseKind kind) {
    std::vector<NoiseCall> result;
    for (const int size : {1, 2, 3, 5, 7, 8, 16, 17, 64, 1000}) result.push_back({kind, "n", size, {1.0f}});
    result.push_back({kind, "n", 1, {0.5f, 0.25f, -2.0f}});
    result.push_back({kind, "n", 3, {1.0f, 0.0f, 0.3f, 7.5f}});
    result.push_back({kind, "n", 16, {.02f, .02f, .05f, .05f, .2f, .3f, 2.0f}});
    result.push_back({kind, "n", 65536, {0.7f, 1.0f, 3.0f, 1.0f, 1.0f}});
    result.push_back({kind, "n", 512, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}});
    return result;
}

std::string sizeAndOctaves(const NoiseCall& call) {
    return "size " + std::to_string(call.size) + ", " + std::to_string(call.weights.size()) + " octaves";
}

// The block that stands for a column.
std::int64_t sampleOf(std::int32_t chunk, int column, int level) {
    return ((std::int64_t{chunk} * 16 + column) << level) + (1 << level) / 2;
}

void expectTile2D(const NoiseCall& call, ChunkPos chunk) {
    NoiseTile tile(call, kPerlinSeed);
    tile.moveTo(chunk);
    tile.run();
    for (int y = 0; y < kTileSize; ++y) {
        for (int x = 0; x < kTileSize; ++x) {
            const std::int64_t blockX = sampleOf(chunk.x, x, chunk.level);
            const std::int64_t blockY = sampleOf(chunk.y, y, chunk.level);
            ASSERT_EQ(tile.at(x, y), bitsOf(reference::perlin2D(call, kPerlinSeed, blockX, blockY)))
                << sizeAndOctaves(call) << " at (" << blockX << ", " << blockY << ")";
        }
    }
}

TEST(Perlin2D, EverySampleIsThatOfTheDescription) {
    onEachTarget([] {
        for (const NoiseCall& call : calls(NoiseKind::Perlin2D)) {
            for (const ChunkPos chunk : kPlaces) ASSERT_NO_FATAL_FAILURE(expectTile2D(call, chunk));
        }
    });
}

void expectLayer(const NoiseTile& tile, const NoiseCall& call, ChunkPos chunk, std::int32_t z) {
    for (int y = 0; y < kTileSize; y += 3) {
        for (int x = 0; x < kTileSize; ++x) {
            const std::int64_t blockX = sampleOf(chunk.x, x, chunk.level);
            const std::int64_t blockY = sampleOf(chunk.y, y, chunk.level);
            ASSERT_EQ(tile.at(x, y), bitsOf(reference::perlin3D(call, kPerlinSeed, {blockX, blockY, z})))
                << sizeAndOctaves(call) << " at (" << blockX << ", " << blockY << ", " << z << ")";
        }
    }
}

// Layers of a branch that is not always taken come with gaps; tiles are used for chunk after chunk.
TEST(Perlin3D, EverySampleIsThatOfTheDescription) {
    onEachTarget([] {
        for (const NoiseCall& call : calls(NoiseKind::Perlin3D)) {
            NoiseTile tile(call, kPerlinSeed);
            for (const ChunkPos chunk : kPlaces) {
                tile.moveTo(chunk);
                for (const std::int32_t z : {0, 1, 2, 3, 4, 8, 9, 64, 65, 200, 255}) {
                    tile.run(z);
                    ASSERT_NO_FATAL_FAILURE(expectLayer(tile, call, chunk, z));
                }
            }
        }
    });
}

// Columns lie 2^level blocks apart; lattices are as wide as a column at least.
TEST(Perlin, EverySampleOfATileIsThatOfTheDescription) {
    for (const int level : {1, 2, 3, 7, 12, world::kMaxLevel}) {
        for (const std::int32_t size : {1 << level, (3 << level) / 2, (7 << level) / 3, 5 << level}) {
            const NoiseCall flat = call2D(size, {1.0f, 0.5f}), solid = call3D(size, {1.0f, 0.5f});
            for (const ChunkPos chunk : placesOf(level)) {
                ASSERT_NO_FATAL_FAILURE(expectTile2D(flat, chunk)) << level;
                NoiseTile tile(solid, kPerlinSeed);
                tile.moveTo(chunk);
                for (const std::int32_t z : {0, 77, 255}) {
                    tile.run(z);
                    ASSERT_NO_FATAL_FAILURE(expectLayer(tile, solid, chunk, z)) << level;
                }
            }
        }
    }
}

TEST(FadedWeights, FallFromTwoStepsToOne) {
    const std::vector<float> weights = {1, 1, 1, -2};
    EXPECT_EQ(fadedWeights(weights, 3, 1), weights);
    EXPECT_EQ(fadedWeights({1.0f}, 1, 1), std::vector<float>{1.0f}) << "at step 1 nothing fades";
    EXPECT_EQ(fadedWeights(weights, 3, 2), (std::vector<float>{0.5f, 1, 1, -2}));
    EXPECT_EQ(fadedWeights(weights, 3, 4), (std::vector<float>{0, 0.5f, 1, -2}));
    EXPECT_EQ(fadedWeights(weights, 3, 16), (std::vector<float>{0, 0, 0, -1}));
    EXPECT_EQ(fadedWeights(weights, 8, 8), (std::vector<float>{0, 1, 1, -2}));
}

TEST(Perlin3D, LayersMayComeInAnyOrder) {
    for (const int size : {1, 3, 8, 64}) {
        const NoiseCall call = call3D(size, {1.0f, 0.5f});
        NoiseTile tile(call, kPerlinSeed);
        tile.moveTo({3, -2});
        for (const std::int32_t z : {255, 0, 17, 16, 15, 15, 8, 9, 7, 100, 0}) {
            tile.run(z);
            ASSERT_NO_FATAL_FAILURE(expectLayer(tile, call, {3, -2}, z));
        }
    }
}

// Zeros are zeros of either sign: both compare equal to 0.
TEST(Perlin, IsZeroAtTheNodes) {
    for (const int size : {1, 3, 8, 16}) {
        NoiseTile flat(call2D(size, {1.0f}), kPerlinSeed), solid(call3D(size, {1.0f}), kPerlinSeed);
        flat.moveTo({0, 0});
        solid.moveTo({0, 0});
        flat.run();
        for (std::int32_t z = 0; z < 64; z += size) {
            solid.run(z);
            for (int y = 0; y < kTileSize; y += size) {
                for (int x = 0; x < kTileSize; x += size) {
                    ASSERT_EQ(flat.floatAt(x, y), 0.0f) << size << ": " << x << ", " << y;
                    ASSERT_EQ(solid.floatAt(x, y), 0.0f) << size << ": " << x << ", " << y << ", " << z;
                }
            }
        }
    }
}

struct Range {
    float low = 0, high = 0;
    double squares = 0;
    int count = 0;

    void add(float v) {
        low = std::min(low, v);
        high = std::max(high, v);
        squares += double{v} * double{v};
        ++count;
    }
    double deviation() const { return std::sqrt(squares / count); }
};

TEST(Perlin2D, FillsMinusOneToOne) {
    Range range;
    for (const int size : {8, 13, 64}) {
        NoiseTile tile(call2D(size, {1.0f}), kPerlinSeed);
        for (std::int32_t k = 0; k < 600; ++k) {
            tile.moveTo({k, -7 * k});
            tile.run();
            for (int i = 0; i < kTileLanes; ++i) range.add(tile.floatAt(i % 16, i / 16));
        }
    }
    EXPECT_GE(range.low, -1.0f);
    EXPECT_LE(range.high, 1.0f);
    EXPECT_LT(range.low, -0.85f);
    EXPECT_GT(range.high, 0.85f);
    EXPECT_NEAR(range.deviation(), 0.3, 0.08);
}

TEST(Perlin3D, FillsAboutMinusOneToOne) {
    Range range;
    for (const int size : {8, 13, 32}) {
        NoiseTile tile(call3D(size, {1.0f}), kPerlinSeed);
        for (std::int32_t k = 0; k < 40; ++k) {
            tile.moveTo({k, -7 * k});
            for (std::int32_t z = 0; z < 256; z += 5) {
                tile.run(z);
                for (int i = 0; i < kTileLanes; ++i) range.add(tile.floatAt(i % 16, i / 16));
            }
        }
    }
    EXPECT_GE(range.low, -1.05f);
    EXPECT_LE(range.high, 1.05f);
    EXPECT_LT(range.low, -0.75f);
    EXPECT_GT(range.high, 0.75f);
    EXPECT_NEAR(range.deviation(), 0.27, 0.08);
}

// From block to block the noise changes by no more than its steepest slope (measured: 2.9 a lattice), also
// from chunk to chunk.
TEST(Perlin2D, GoesOnSmoothlyAcrossChunks) {
    constexpr int kSize = 64;
    constexpr float kStep = 3.0f / kSize;
    NoiseTile tile(call2D(kSize, {1.0f}), kPerlinSeed), next(call2D(kSize, {1.0f}), kPerlinSeed);
    for (std::int32_t chunk = -200; chunk < 200; ++chunk) {
        tile.moveTo({chunk, chunk / 3});
        next.moveTo({chunk + 1, chunk / 3});
        tile.run();
        next.run();
        for (int y = 0; y < kTileSize; ++y) {
            ASSERT_LE(std::abs(next.floatAt(0, y) - tile.floatAt(15, y)), kStep) << "chunk " << chunk;
            for (int x = 0; x < 15; ++x) {
                ASSERT_LE(std::abs(tile.floatAt(x + 1, y) - tile.floatAt(x, y)), kStep) << "chunk " << chunk;
            }
        }
    }
}

double correlation(const NoiseCall& call, std::uint32_t seedA, std::uint32_t seedB) {
    double product = 0, squareA = 0, squareB = 0;
    NoiseTile a(call, seedA), b(call, seedB);
    for (std::int32_t chunk = 0; chunk < 600; ++chunk) {
        a.moveTo({chunk, 11 * chunk});
        b.moveTo({chunk, 11 * chunk});
        a.run(8);
        b.run(8);
        for (int lane = 0; lane < kTileLanes; ++lane) {
            const double va = a.floatAt(lane % 16, lane / 16), vb = b.floatAt(lane % 16, lane / 16);
            product += va * vb;
            squareA += va * va;
            squareB += vb * vb;
        }
    }
    return product / std::sqrt(squareA * squareB);
}

TEST(Perlin, DifferentSeedsHaveNothingInCommon) {
    for (const NoiseCall& call : {call2D(5, {1.0f}), call3D(5, {1.0f})}) {
        EXPECT_NEAR(correlation(call, 1, 1), 1.0, 1e-9);
        for (const std::uint32_t seed : {2u, 3u, 0x80000001u, 0x9E3779B9u + 1u}) {
            EXPECT_NEAR(correlation(call, 1, seed), 0.0, 0.05) << seed;
        }
    }
}

}  // namespace
}  // namespace terrane::gen

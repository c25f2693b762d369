// The overworld seen from afar: tiles of each level against the chunks under them, and the same tiles from
// every machine.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "bench/level_figures.h"
#include "terrane/gen/level_generators.h"
#include "tests/gen/chunk_area.h"

namespace terrane::gen {
namespace {

constexpr std::uint64_t kSeed = 1;

const LevelGenerators& generators() {
    static const LevelGenerators all(
        [](int level) { return makeGenerator("overworld", contentBlocks(), level); }, kSeed);
    return all;
}

// Mountains, coast, plains, desert, forest and hills; sanitizers run without optimization.
bench::FigureArea figureArea() {
#ifdef __OPTIMIZE__
    return {16,
            {{-1824, -1920},
             {-1344, -2304},
             {-1056, -2112},
             {-1536, -2208},
             {-2112, -2304},
             {0, -2208},
             {-1056, -192}}};
#else
    return {16, {{-1344, -2304}, {-1056, -192}}};
#endif
}

void expectSimilar(const bench::LevelFigures& f) {
    for (std::size_t k = 0; k < f.heightBias.size(); ++k) {
        EXPECT_LT(std::abs(f.heightBias[k]), 0.5) << "blocks, land " << k << " in " << f.areas[k] << " areas";
    }
    for (std::size_t k = 0; k < f.tileCover.size(); ++k) {
        EXPECT_NEAR(f.tileCover[k], f.chunkCover[k], 0.03) << "share of the area, cover " << k;
    }
    EXPECT_GT(f.waterInBoth, 0.95 * f.waterInAny);
    const auto leaves = static_cast<std::size_t>(bench::Cover::Leaves);
    EXPECT_NEAR(f.tileCover[leaves] / f.chunkCover[leaves], 1.0, 0.08);
    EXPECT_NEAR(f.tileCrownHeight, f.chunkCrownHeight, 0.5);
}

TEST(OverworldLevels, TilesLookLikeTheChunksUnderThem) {
    const bench::LevelComparison comparison(generators(), contentBlocks(), figureArea());
    for (int level = 1; level <= 4; ++level) {
        SCOPED_TRACE(level);
        expectSimilar(comparison.of(level));
    }
}

// A column of a tile shows the tree that stands at its block at level 0: crowns do not jump between levels.
TEST(OverworldLevels, TreesStandAtTheSamePlaces) {
    const BlockId leaves = idOf("oak_leaves");
    const ChunkPos forest = {-2112, -2304};
    for (const int level : {1, 2}) {
        const int side = 1 << level;  // chunks below a tile
        int both = 0, any = 0;
        for (int tile = 0; tile < 8; ++tile) {
            const auto far = static_cast<std::uint8_t>(level);
            const auto blocks =
                blocksOf(generators().generate({(forest.x >> level) + tile, forest.y >> level, far}));
            const Area area(**generators().at(0), {forest.x + tile * side, forest.y}, side);
            for (int k = 0; k < 256; ++k) {
                const int x = ((k % 16) << level) + side / 2, y = ((k / 16) << level) + side / 2;
                bool isTile = false, isChunk = false;
                for (int z = kSeaLevel; z < 160; ++z) {
                    isTile = isTile || blocks[world::blockIndex(k % 16, k / 16, z)] == leaves;
                    isChunk = isChunk || area.at(x, y, z) == leaves;
                }
                both += isTile && isChunk;
                any += isTile || isChunk;
            }
        }
        ASSERT_GT(any, 200) << "a forest stands here";
        // Leaves at the rim of a crown are random by height, and a trunk may stand a block higher or lower.
        // Other trees at this density would agree in a fifth of the columns.
        EXPECT_GT(both, any * 0.65) << "level " << level;
    }
}

// Wherever crowns are drawn from the ground up, and where trunks carry them.
TEST(OverworldLevels, NoCrownFloats) {
    const BlockId leaves = idOf("oak_leaves");
    for (const int level : {3, 4, 6}) {
        const auto blocks = blocksOf(
            generators().generate({-2112 >> level, -2304 >> level, static_cast<std::uint8_t>(level)}));
        int crowns = 0;
        for (std::size_t k = 256; k < blocks.size(); ++k) {
            if (blocks[k] != leaves) continue;
            ++crowns;
            ASSERT_NE(blocks[k - 256], world::kAir) << "level " << level << " z " << k / 256;
        }
        EXPECT_GT(crowns, 0);
    }
}

TEST(OverworldLevels, WaterIsNoHigherThanTheSea) {
    const BlockId water = idOf("water");
    for (int level = 1; level <= world::kMaxLevel; ++level) {
        for (const ChunkPos pos : placesOf(level)) {
            const auto blocks = blocksOf(generators().generate(pos));
            for (std::size_t k = 256 * (kSeaLevel + 1); k < blocks.size(); ++k)
                ASSERT_NE(blocks[k], water) << level;
        }
    }
}

using Tiles = std::vector<std::vector<BlockId>>;

std::vector<ChunkPos> somePlaces() {
    std::vector<ChunkPos> places;
    for (const int level : {1, 2, 3, 6, 11, world::kMaxLevel}) {
        for (const ChunkPos pos : placesOf(level)) places.push_back(pos);
        places.push_back({1, 0, static_cast<std::uint8_t>(level)});
    }
    return places;
}

Tiles tilesOf(const LevelGenerators& all, const std::vector<ChunkPos>& places, unsigned threadCount) {
    Tiles tiles(places.size());
    std::atomic<std::size_t> next = 0;
    std::vector<std::thread> threads;
    for (unsigned t = 0; t < threadCount; ++t) {
        threads.emplace_back([&] {
            for (std::size_t k = next++; k < places.size(); k = next++)
                tiles[k] = blocksOf(all.generate(places[k]));
        });
    }
    for (std::thread& t : threads) t.join();
    return tiles;
}

LevelGenerators freshGenerators() {
    return LevelGenerators([](int level) { return makeGenerator("overworld", contentBlocks(), level); },
                           kSeed);
}

TEST(OverworldLevels, InstructionSetsGiveTheSameTiles) {
    const Tiles first = tilesOf(freshGenerators(), somePlaces(), 1);
    onEachTarget([&] { ASSERT_TRUE(tilesOf(freshGenerators(), somePlaces(), 1) == first); });
}

TEST(OverworldLevels, ThreadsAndOrderDoNotMatter) {
    std::vector<ChunkPos> places = somePlaces();
    Tiles first = tilesOf(freshGenerators(), places, 1);
    std::reverse(places.begin(), places.end());
    std::reverse(first.begin(), first.end());
    EXPECT_TRUE(tilesOf(freshGenerators(), places, 4) == first);
}

}  // namespace
}  // namespace terrane::gen

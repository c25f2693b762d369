// Invariants of land with rivers and trees, continents and wilderness: nothing floats, plants stand on
// ground, water is held by its banks, the bottom is solid, worlds begin on land, levels are as high as the
// land.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "tests/gen/chunk_area.h"

namespace terrane::gen {
namespace {

constexpr int kLandChunks = 4;
constexpr int kLandBlocks = kLandChunks * world::kChunkSize;
// Near the edge of an area, within this many blocks, the support of a tree may lie outside.
constexpr int kEdge = 18;
constexpr int kHighestFall = 28;  // blocks

struct Land {
    const char *generator, *name;
    std::uint64_t seed;
    ChunkPos corner;
};
void PrintTo(const Land& place, std::ostream* out) {
    *out << place.generator << " " << place.name;
}

constexpr Land kLands[] = {{"continents", "mountains", 1, {231, -118}},
                           {"continents", "canyons", 1, {-158, 160}},
                           {"continents", "dunes", 1, {92, 167}},
                           {"continents", "rain_forest", 1, {55, 374}},
                           {"continents", "river", 1, {-56, 173}},
                           {"continents", "shore", 1, {178, -95}},
                           {"continents", "corner", 31, {world::kMinChunk, world::kMinChunk}},
                           {"continents",
                            "far_corner",
                            32,
                            {world::kMaxChunk - kLandChunks + 1, world::kMaxChunk - kLandChunks + 1}},
                           {"wilderness", "range", 1, {20, 60}},
                           {"wilderness", "canyons", 1, {-88, 30}},
                           {"wilderness", "volcano", 1, {48, 3}},
                           {"wilderness", "valley", 1, {30, 55}},
                           {"wilderness", "falls", 1, {-57, 216}},
                           {"wilderness", "karst", 1, {-14, 40}},
                           {"wilderness", "caves", 1, {-27, 52}},
                           {"wilderness", "shafts", 1, {-31, 43}},
                           {"wilderness", "sinkhole", 1, {-24, 54}},
                           {"wilderness", "springs", 1, {272, 52}},
                           {"wilderness", "sea_arch", 1, {342, -149}},
                           {"wilderness", "corner", 31, {world::kMinChunk, world::kMinChunk}},
                           {"wilderness",
                            "far_corner",
                            32,
                            {world::kMaxChunk - kLandChunks + 1, world::kMaxChunk - kLandChunks + 1}}};

class Lands : public testing::TestWithParam<Land> {
  protected:
    Lands() : area(generatorOf(GetParam().generator, GetParam().seed), GetParam().corner, kLandChunks) {}

    template <class Function>
    void forEachBlock(int edge, Function f) const {
        for (int z = bottom + 1; z < top; ++z) {
            for (int y = edge; y < kLandBlocks - edge; ++y) {
                for (int x = edge; x < kLandBlocks - edge; ++x) {
                    if (const BlockId block = area.at(x, y, z); block != world::kAir) f(x, y, z, block);
                    if (HasFatalFailure()) return;
                }
            }
        }
    }

    bool isLiquid(BlockId block) const { return block == water || block == white || block == lava; }

    const BlockId water = idOf("water"), white = idOf("white_water"), lava = idOf("lava"), ice = idOf("ice");
    Area area;
    const int bottom = area.heights().bottom, top = area.heights().top;
};
INSTANTIATE_TEST_SUITE_P(Places, Lands, testing::ValuesIn(kLands), [](const auto& place) {
    return std::string(place.param.generator) + "_" + place.param.name;
});

// Every block is connected to the bottom, or to rock beside the area, by faces, edges or corners: branches
// grow aslant.
TEST_P(Lands, NothingFloats) {
    const auto index = [&](int x, int y, int z) {
        return static_cast<std::size_t>(x + kLandBlocks * (y + kLandBlocks * (z - bottom)));
    };
    std::vector<bool> held(index(0, 0, top));
    std::deque<std::array<int, 3>> open;
    const auto hold = [&](int x, int y, int z) {
        if (x < 0 || y < 0 || z < bottom || x >= kLandBlocks || y >= kLandBlocks || z >= top) return;
        const BlockId block = area.at(x, y, z);
        if (held[index(x, y, z)] || block == world::kAir || isLiquid(block)) return;
        held[index(x, y, z)] = true;
        open.push_back({x, y, z});
    };
    for (int y = 0; y < kLandBlocks; ++y) {
        for (int x = 0; x < kLandBlocks; ++x) {
            hold(x, y, bottom);
            const bool isSide = x == 0 || y == 0 || x == kLandBlocks - 1 || y == kLandBlocks - 1;
            for (int z = area.groundHeight(x, y) - 8; isSide && z > bottom; --z) hold(x, y, z);
        }
    }
    while (!open.empty()) {
        const auto [x, y, z] = open.front();
        open.pop_front();
        for (int n = 0; n < 27; ++n) hold(x + n % 3 - 1, y + n / 3 % 3 - 1, z + n / 9 - 1);
    }
    // Ice floats on water, and blocks under the ground may be connected outside of the area.
    forEachBlock(kEdge, [&](int x, int y, int z, BlockId block) {
        if (isLiquid(block) || block == ice) return;
        ASSERT_TRUE(held[index(x, y, z)]) << area.where(x, y, z);
    });
}

TEST_P(Lands, PlantsStandOnGround) {
    forEachBlock(0, [&](int x, int y, int z, BlockId block) {
        const world::BlockType& type = contentBlocks().type(block);
        if (type.shape != world::Shape::Cross && type.shape != world::Shape::Hash) return;
        const BlockId below = area.at(x, y, z - 1);
        ASSERT_TRUE(below == block || (below != world::kAir && !isLiquid(below))) << area.where(x, y, z);
    });
}

// Beside water there is no air, but over lower water: rivers come down in steps and falls.
TEST_P(Lands, WaterIsHeld) {
    forEachBlock(1, [&](int x, int y, int z, BlockId block) {
        if (!isLiquid(block)) return;
        ASSERT_NE(area.at(x, y, z - 1), world::kAir) << area.where(x, y, z);
        if (block == white) return;  // does not flow
        for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
            if (area.at(x + dx, y + dy, z) != world::kAir) continue;
            int below = z - 1;
            while (below > z - kHighestFall && area.at(x + dx, y + dy, below) == world::kAir) --below;
            ASSERT_TRUE(isLiquid(area.at(x + dx, y + dy, below))) << area.where(x, y, z);
        }
    });
}

TEST_P(Lands, TheBottomIsSolid) {
    for (int y = 0; y < kLandBlocks; ++y)
        for (int x = 0; x < kLandBlocks; ++x)
            ASSERT_TRUE(isOpaqueCube(area.at(x, y, bottom))) << area.where(x, y, bottom);
}

TEST(LandsWithSeas, BeginOnLand) {
    for (const auto& [name, sea] : {std::pair{"continents", kSeaLevel}, {"wilderness", 0}}) {
        for (std::uint64_t seed = 1; seed <= 16; ++seed) {
            const Area area(generatorOf(name, seed), {0, 0}, 1);
            EXPECT_NE(area.at(8, 8, sea), idOf("water")) << name << ", seed " << seed;
        }
    }
}

// Mean height of the ground, under water too.
double meanGround(const world::Chunk& chunk, const std::set<BlockId>& notGround) {
    double sum = 0;
    for (int column = 0; column < world::kBlocksPerLayer; ++column) {
        int z = chunk.heights().top - 1;
        while (z > chunk.heights().bottom &&
               notGround.contains(chunk.block(world::blockIndex(column % 16, column / 16, z))))
            --z;
        sum += z;
    }
    return sum / world::kBlocksPerLayer;
}

// A tile's ground is on average as high as that of the chunks under it, in mountains too.
TEST(LandsLevels, AreAsHighAsTheLand) {
    std::set<BlockId> notGround = {world::kAir, idOf("water")};
    for (const world::BlockType& type : contentBlocks().types()) {
        const bool isTree =
            type.name.find("leaves") != std::string::npos || type.name.find("_log") != std::string::npos;
        if (isTree || !type.opaqueCube) notGround.insert(type.id);
    }
    // Mountains of wilderness are some ten times as high, and as steep.
    constexpr double kContinents = 0.4, kWilderness = 2.5;
    for (const auto& [name, first, tolerance] : {std::tuple{"continents", ChunkPos{232, -120}, kContinents},
                                                 {"continents", ChunkPos{-160, 160}, kContinents},
                                                 {"continents", ChunkPos{200, -104}, kContinents},
                                                 {"wilderness", ChunkPos{24, 64}, kWilderness},
                                                 {"wilderness", ChunkPos{-160, 248}, kWilderness},
                                                 {"wilderness", ChunkPos{-88, 32}, kWilderness}}) {
        const Generator land = generatorOf(name, 1);
        double chunks = 0;
        for (int k = 0; k < 64; ++k)
            chunks += meanGround(land.generate({first.x + k % 8, first.y + k / 8}), notGround) / 64;
        const Generator tiles = generatorOf(name, 1, 3);
        const ChunkPos tile = {first.x >> 3, first.y >> 3, 3};
        EXPECT_NEAR(meanGround(tiles.generate(tile), notGround), chunks, tolerance)
            << name << " " << first.x << " " << first.y;
    }
}

}  // namespace
}  // namespace terrane::gen

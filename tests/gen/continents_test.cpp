// Invariants of every continent: nothing floats, plants stand on ground, water is held by its banks, the
// bottom is solid, worlds begin on land, levels are as high as the land.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <deque>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "terrane/gen/generators/continents.h"
#include "tests/gen/chunk_area.h"
#include "tests/support/default_heights.h"

namespace terrane::gen {
namespace {

constexpr int kAreaChunks = 4;
constexpr int kAreaBlocks = kAreaChunks * world::kChunkSize;
// Near the edge of an area, within this many blocks, the support of a tree may lie outside.
constexpr int kEdge = 18;

struct Land {
    const char* name;
    std::uint64_t seed;
    ChunkPos corner;
};
void PrintTo(const Land& place, std::ostream* out) {
    *out << place.name;
}

constexpr Land kLands[] = {
    {"mountains", 1, {231, -118}},
    {"canyons", 1, {-158, 160}},
    {"dunes", 1, {92, 167}},
    {"rain_forest", 1, {55, 374}},
    {"river", 1, {-56, 173}},
    {"shore", 1, {178, -95}},
    {"corner", 31, {world::kMinChunk, world::kMinChunk}},
    {"far_corner", 32, {world::kMaxChunk - kAreaChunks + 1, world::kMaxChunk - kAreaChunks + 1}}};

class Continents : public testing::TestWithParam<Land> {
  protected:
    Continents() : area(generatorOf("continents", GetParam().seed), GetParam().corner, kAreaChunks) {}

    template <class Function>
    void forEachBlock(int edge, Function f) const {
        for (int z = 1; z < world::kChunkHeight; ++z) {
            for (int y = edge; y < kAreaBlocks - edge; ++y) {
                for (int x = edge; x < kAreaBlocks - edge; ++x) {
                    if (const BlockId block = area.at(x, y, z); block != world::kAir) f(x, y, z, block);
                    if (HasFatalFailure()) return;
                }
            }
        }
    }

    bool isLiquid(BlockId block) const { return block == water; }

    const BlockId water = idOf("water"), ice = idOf("ice");
    Area area;
};
INSTANTIATE_TEST_SUITE_P(Places, Continents, testing::ValuesIn(kLands),
                         [](const auto& place) { return place.param.name; });

// Every block is connected to the bottom by faces, edges or corners: branches grow aslant.
TEST_P(Continents, NothingFloats) {
    const auto index = [](int x, int y, int z) {
        return static_cast<std::size_t>(x + kAreaBlocks * (y + kAreaBlocks * z));
    };
    std::vector<bool> held(std::size_t{kAreaBlocks} * kAreaBlocks * world::kChunkHeight);
    std::deque<std::array<int, 3>> open;
    const auto hold = [&](int x, int y, int z) {
        if (x < 0 || y < 0 || z < 0 || x >= kAreaBlocks || y >= kAreaBlocks || z >= world::kChunkHeight)
            return;
        const BlockId block = area.at(x, y, z);
        if (held[index(x, y, z)] || block == world::kAir || isLiquid(block)) return;
        held[index(x, y, z)] = true;
        open.push_back({x, y, z});
    };
    for (int y = 0; y < kAreaBlocks; ++y)
        for (int x = 0; x < kAreaBlocks; ++x) hold(x, y, 0);
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

TEST_P(Continents, PlantsStandOnGround) {
    forEachBlock(0, [&](int x, int y, int z, BlockId block) {
        const world::BlockType& type = contentBlocks().type(block);
        if (type.shape != world::Shape::Cross && type.shape != world::Shape::Hash) return;
        const BlockId below = area.at(x, y, z - 1);
        ASSERT_TRUE(below == block || (below != world::kAir && !isLiquid(below))) << area.where(x, y, z);
    });
}

// Beside water there is no air, but over lower water: rivers come down in steps of a block.
TEST_P(Continents, WaterIsHeld) {
    forEachBlock(1, [&](int x, int y, int z, BlockId block) {
        if (!isLiquid(block)) return;
        ASSERT_NE(area.at(x, y, z - 1), world::kAir) << area.where(x, y, z);
        for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
            if (area.at(x + dx, y + dy, z) != world::kAir) continue;
            ASSERT_TRUE(isLiquid(area.at(x + dx, y + dy, z - 1))) << area.where(x, y, z);
        }
    });
}

TEST_P(Continents, TheBottomIsSolid) {
    for (int y = 0; y < kAreaBlocks; ++y)
        for (int x = 0; x < kAreaBlocks; ++x)
            ASSERT_TRUE(isOpaqueCube(area.at(x, y, 0))) << area.where(x, y, 0);
}

TEST(ContinentsLand, IsWhereWorldsBegin) {
    for (std::uint64_t seed = 1; seed <= 16; ++seed) {
        const Area area(generatorOf("continents", seed), {0, 0}, 1);
        EXPECT_NE(area.at(8, 8, kSeaLevel), idOf("water")) << "seed " << seed;
    }
}

// Mean height of the ground, under water too.
double meanGround(const std::vector<BlockId>& blocks, const std::set<BlockId>& notGround) {
    double sum = 0;
    for (std::size_t column = 0; column < 256; ++column) {
        int z = world::kChunkHeight - 1;
        while (z > 0 && notGround.contains(blocks[static_cast<std::size_t>(z) * 256 + column])) --z;
        sum += z;
    }
    return sum / 256;
}

// A tile's ground is on average as high as that of the chunks under it, in mountains too.
TEST(ContinentsLevels, AreAsHighAsTheLand) {
    std::set<BlockId> notGround = {world::kAir, idOf("water")};
    for (const world::BlockType& type : contentBlocks().types()) {
        const bool isTree =
            type.name.find("leaves") != std::string::npos || type.name.find("_log") != std::string::npos;
        if (isTree || !type.opaqueCube) notGround.insert(type.id);
    }
    const Generator land = generatorOf("continents", 1);
    for (const ChunkPos first : {ChunkPos{232, -120}, ChunkPos{-160, 160}, ChunkPos{200, -104}}) {
        double chunks = 0;
        for (int k = 0; k < 64; ++k)
            chunks += meanGround(blocksOf(land.generate({first.x + k % 8, first.y + k / 8})), notGround) / 64;
        const Generator tiles = generatorOf("continents", 1, 3);
        const ChunkPos tile = {first.x / 8, first.y / 8 - (first.y % 8 < 0 ? 1 : 0), 3};
        EXPECT_NEAR(meanGround(blocksOf(tiles.generate(tile)), notGround), chunks, 0.4)
            << first.x << " " << first.y;
    }
}

}  // namespace
}  // namespace terrane::gen

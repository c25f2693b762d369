// Invariants of every overworld: the bottom is solid, nothing floats, water is no higher than the sea, there
// are no seams.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "tests/gen/chunk_area.h"
#include "tests/support/default_heights.h"

namespace terrane::gen {
namespace {

constexpr int kAreaChunks = 5;  // along x and along y
constexpr int kAreaBlocks = kAreaChunks * world::kChunkSize;

struct Place {
    std::uint64_t seed;
    ChunkPos corner;
};
// The last two are corners of the world, at ±2^31 blocks.
constexpr std::array<Place, 6> kAreas = {
    {{1, {0, 0}},
     {2, {-300, 120}},
     {0xFFFFFFFFFFu, {2000, -503}},
     {77, {-57, -4000}},
     {31, {world::kMinChunk, world::kMinChunk}},
     {32, {world::kMaxChunk - kAreaChunks + 1, world::kMaxChunk - kAreaChunks + 1}}}};

Area areaAt(const Place& place) {
    return Area(overworld(place.seed), place.corner, kAreaChunks);
}

class Overworld : public testing::TestWithParam<Place> {
  protected:
    static const Area& area() {
        // The areas of one program run: tests that run apart generate only their own.
        static std::array<std::unique_ptr<Area>, kAreas.size()> areas;
        for (std::size_t k = 0; k < kAreas.size(); ++k) {
            if (kAreas[k].seed != GetParam().seed) continue;
            if (!areas[k]) areas[k] = std::make_unique<Area>(areaAt(kAreas[k]));
            return *areas[k];
        }
        std::abort();
    }

    // Calls f(x, y, z, block) for every block that is not air.
    template <class Function>
    static void forEachBlock(const Area& a, Function f) {
        for (int z = 0; z < world::kChunkHeight; ++z) {
            for (int y = 0; y < kAreaBlocks; ++y) {
                for (int x = 0; x < kAreaBlocks; ++x) {
                    if (const BlockId block = a.at(x, y, z); block != world::kAir) f(x, y, z, block);
                    if (testing::Test::HasFatalFailure()) return;
                }
            }
        }
    }
};

TEST_P(Overworld, TheBottomIsSolid) {
    const Area& a = area();
    for (int y = 0; y < kAreaBlocks; ++y) {
        for (int x = 0; x < kAreaBlocks; ++x) ASSERT_TRUE(isOpaqueCube(a.at(x, y, 0))) << a.where(x, y, 0);
    }
}

TEST_P(Overworld, WaterIsNoHigherThanTheSea) {
    const Area& a = area();
    const BlockId water = idOf("water");
    forEachBlock(a, [&](int x, int y, int z, BlockId block) {
        if (block != water) return;
        ASSERT_LE(z, kSeaLevel) << a.where(x, y, z);
    });
}

// Water has no walls of its own: ground or more water lies beside and below it.
TEST_P(Overworld, WaterIsHeldByGround) {
    const Area& a = area();
    const BlockId water = idOf("water");
    const auto isHeld = [&](int x, int y, int z) {
        if (x < 0 || y < 0 || x >= kAreaBlocks || y >= kAreaBlocks) return true;
        const BlockId block = a.at(x, y, z);
        return block == water || isOpaqueCube(block);
    };
    forEachBlock(a, [&](int x, int y, int z, BlockId block) {
        if (block != water) return;
        ASSERT_TRUE(isHeld(x - 1, y, z) && isHeld(x + 1, y, z) && isHeld(x, y - 1, z) &&
                    isHeld(x, y + 1, z) && isHeld(x, y, z - 1))
            << a.where(x, y, z);
    });
}

TEST_P(Overworld, SandLiesOnGround) {
    const Area& a = area();
    const BlockId sand = idOf("sand");
    forEachBlock(a, [&](int x, int y, int z, BlockId block) {
        if (block != sand) return;
        ASSERT_TRUE(isOpaqueCube(a.at(x, y, z - 1))) << a.where(x, y, z) << " on " << a.where(x, y, z - 1);
    });
}

// The line is at z = 160 on average, 40 lower in the cold, with an edge of 12 blocks.
TEST_P(Overworld, SnowLiesHigh) {
    const Area& a = area();
    const BlockId snow = idOf("snow");
    forEachBlock(a, [&](int x, int y, int z, BlockId block) {
        if (block != snow) return;
        ASSERT_GE(z, 160 - 40 - 12) << a.where(x, y, z);
    });
}

TEST_P(Overworld, OnlyBlocksOfGeneratedTerrain) {
    const Area& a = area();
    forEachBlock(a, [&](int x, int y, int z, BlockId block) {
        ASSERT_LT(block, contentBlocks().missing()) << a.where(x, y, z);
        ASSERT_TRUE(contentBlocks().type(block).generated) << a.where(x, y, z);
    });
}

TEST_P(Overworld, PlantsStandOnSolidGround) {
    const Area& a = area();
    std::set<BlockId> plants;
    for (const world::BlockType& type : contentBlocks().types()) {
        if (type.shape == world::Shape::Cross || type.shape == world::Shape::Hash) plants.insert(type.id);
    }
    EXPECT_TRUE(plants.contains(idOf("grass_tuft")) && plants.contains(idOf("wheat")));
    forEachBlock(a, [&](int x, int y, int z, BlockId block) {
        if (!plants.contains(block)) return;
        ASSERT_TRUE(isOpaqueCube(a.at(x, y, z - 1))) << a.where(x, y, z) << " on " << a.where(x, y, z - 1);
    });
}

TEST_P(Overworld, CactiStandOnSandOrCacti) {
    const Area& a = area();
    const BlockId cactus = idOf("cactus"), sand = idOf("sand");
    forEachBlock(a, [&](int x, int y, int z, BlockId block) {
        if (block != cactus) return;
        const BlockId below = a.at(x, y, z - 1);
        ASSERT_TRUE(below == cactus || below == sand) << a.where(x, y, z) << " on " << a.where(x, y, z - 1);
    });
}

TEST_P(Overworld, TrunksStandOnGroundOrTrunks) {
    const Area& a = area();
    const BlockId log = idOf("oak_log");
    forEachBlock(a, [&](int x, int y, int z, BlockId block) {
        if (block != log) return;
        ASSERT_TRUE(isOpaqueCube(a.at(x, y, z - 1))) << a.where(x, y, z) << " on " << a.where(x, y, z - 1);
    });
}

bool isNear(const Area& a, std::array<int, 3> center, BlockId wanted, int reach) {
    const auto [x, y, z] = center;
    for (int dz = -reach; dz <= reach; ++dz) {
        if (z + dz < 0 || z + dz >= world::kChunkHeight) continue;
        for (int dy = -reach; dy <= reach; ++dy) {
            for (int dx = -reach; dx <= reach; ++dx) {
                if (a.at(x + dx, y + dy, z + dz) == wanted) return true;
            }
        }
    }
    return false;
}

// In the 3×3 inner chunks: leaves at their edge may belong to a tree of the next chunk.
TEST_P(Overworld, LeavesAreNearATrunk) {
    const Area& a = area();
    const BlockId log = idOf("oak_log"), leaves = idOf("oak_leaves");
    const auto isInner = [](int v) { return v >= 16 && v < kAreaBlocks - 16; };
    forEachBlock(a, [&](int x, int y, int z, BlockId block) {
        if (block != leaves || !isInner(x) || !isInner(y)) return;
        ASSERT_TRUE(isNear(a, {x, y, z}, log, 8)) << a.where(x, y, z);
    });
}

// Mean step of the ground from block to block, within chunks and from one to the next.
struct Steps {
    double inside = 0, across = 0;
};

Steps meanSteps() {
    Steps sum;
    int insideCount = 0, acrossCount = 0;
    for (const Place& place : kAreas) {
        const Area a = areaAt(place);
        std::vector<int> heights;
        for (int k = 0; k < kAreaBlocks * kAreaBlocks; ++k) {
            heights.push_back(a.groundHeight(k % kAreaBlocks, k / kAreaBlocks));
        }
        const auto add = [&](int from, int to, bool isAcross) {
            const auto height = [&](int k) { return heights[static_cast<std::size_t>(k)]; };
            const double step = std::abs(height(to) - height(from));
            (isAcross ? sum.across : sum.inside) += step;
            ++(isAcross ? acrossCount : insideCount);
        };
        for (int v = 0; v < kAreaBlocks; ++v) {
            for (int u = 0; u + 1 < kAreaBlocks; ++u) {
                add(v * kAreaBlocks + u, v * kAreaBlocks + u + 1, u % 16 == 15);
                add(u * kAreaBlocks + v, (u + 1) * kAreaBlocks + v, u % 16 == 15);
            }
        }
    }
    return {sum.inside / insideCount, sum.across / acrossCount};
}

TEST(OverworldGround, HasNoSeamsBetweenChunks) {
    const Steps steps = meanSteps();
    EXPECT_GT(steps.inside, 0.01) << "the ground is not flat";
    EXPECT_LT(steps.across, steps.inside * 1.5 + 0.05);
    EXPECT_GT(steps.across, steps.inside / 1.5 - 0.05);
}

// In chunks all over the world, as many as it takes and four hundred at most.
TEST(OverworldGround, EveryKindOfBlockIsSomewhere) {
    std::set<std::string> missing{
        "air",         "stone",   "dirt",         "grass",          "sand",        "snow",
        "glowing_ore", "oak_log", "oak_leaves",   "grass_tuft",     "blue_orchid", "poppy",
        "oxeye_daisy", "wheat",   "red_mushroom", "brown_mushroom", "cactus",      "glowing_mushroom",
        "water"};
    const Generator generator = overworld(5);
    for (int k = 0; k < 400 && !missing.empty(); ++k) {
        const ChunkPos pos = {(k % 20 - 10) * 61, (k / 20 - 10) * 53};
        for (const BlockId block : blocksOf(generator.generate(pos))) {
            missing.erase(contentBlocks().type(block).name);
        }
    }
    EXPECT_THAT(missing, testing::IsEmpty());
}

TEST(OverworldGround, InstructionSetsGiveTheSameChunks) {
    std::vector<std::vector<BlockId>> first;
    onEachTarget([&] {
        const Generator generator = overworld(9);
        std::vector<std::vector<BlockId>> chunks;
        for (const ChunkPos pos : {ChunkPos{3, 4}, ChunkPos{world::kMaxChunk, world::kMinChunk}}) {
            chunks.push_back(blocksOf(generator.generate(pos)));
        }
        if (first.empty()) first = chunks;
        ASSERT_TRUE(chunks == first);
    });
}

std::string areaName(const testing::TestParamInfo<Place>& place) {
    return "seed" + std::to_string(place.param.seed);
}
INSTANTIATE_TEST_SUITE_P(Areas, Overworld, testing::ValuesIn(kAreas), areaName);

}  // namespace
}  // namespace terrane::gen

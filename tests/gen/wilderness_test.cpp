// Caves, climate, water and places of wilderness: great rooms, caves of ice where it is cold alone, belts by
// seed, banks that hold rivers and lakes, and every kind of place near enough to be found.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/gen/generators/wilderness.h"
#include "tests/gen/chunk_area.h"

namespace terrane::gen {
namespace {

using wilderness::Place;

// Fields by column of one chunk or tile.
class Columns {
  public:
    explicit Columns(int level = 0, std::uint64_t seed = 1)
        : level_(static_cast<std::uint8_t>(level)),
          graph_(*makeGenerator("wilderness", contentBlocks(), level)),
          generator_(graph_, seed) {}

    auto of(std::string_view field, int chunkX, int chunkY) const {
        const auto found = std::ranges::find(graph_.fields, field, &FieldInfo::name);
        EXPECT_NE(found, graph_.fields.end()) << field;
        return generator_.columns({chunkX, chunkY, level_},
                                  static_cast<std::uint32_t>(found - graph_.fields.begin()));
    }
    Bits at(std::string_view field, int x, int y) const {
        return of(field, x >> 4, y >> 4)[static_cast<std::size_t>((x & 15) + 16 * (y & 15))];
    }

  private:
    std::uint8_t level_;
    GeneratorGraph graph_;
    Generator generator_;
};

int asInt(Bits bits) {
    return static_cast<int>(bits);
}

// Near 369, 914 the middle storey has a room of more than 100 blocks.
TEST(WildernessCaves, HaveGreatRooms) {
    const Columns columns;
    int highest = 0, x = 0, y = 0, floor = 0;
    for (int chunkY = 55; chunkY < 60; ++chunkY) {
        for (int chunkX = 20; chunkX < 26; ++chunkX) {
            const auto floors = columns.of("middle floor", chunkX, chunkY),
                       roofs = columns.of("middle roof", chunkX, chunkY);
            for (int k = 0; k < 256; ++k) {
                const auto column = static_cast<std::size_t>(k);
                const int gap = asInt(roofs[column]) - asInt(floors[column]) - 1;
                if (gap <= highest) continue;
                highest = gap, x = chunkX * 16 + k % 16, y = chunkY * 16 + k / 16;
                floor = asInt(floors[column]);
            }
        }
    }
    ASSERT_GE(highest, 80);
    const Area area(generatorOf("wilderness", 1), {x >> 4, y >> 4}, 1);
    const BlockId water = idOf("water");
    for (int z = floor + 3; z < floor + highest; ++z) {
        const BlockId block = area.at(x & 15, y & 15, z);
        ASSERT_TRUE(block == world::kAir || block == water) << area.where(x & 15, y & 15, z);
    }
}

// Light at all heights of the room near 369, 914, from crystals beside open ground.
TEST(WildernessCaves, GreatRoomsHaveCrystalsUpToTheirRoofs) {
    const Area area(generatorOf("wilderness", 1), {20, 54}, 6);
    const BlockId crystal = idOf("crystal_rock");
    int lowest = 0, highest = -512, count = 0;
    for (int y = 1; y < 95; ++y) {
        for (int x = 1; x < 95; ++x) {
            for (int z = -200; z < -30; ++z) {
                const bool isOpen =
                    area.at(x - 1, y, z) == world::kAir || area.at(x + 1, y, z) == world::kAir ||
                    area.at(x, y, z - 1) == world::kAir || area.at(x, y, z + 1) == world::kAir;
                if (area.at(x, y, z) != crystal || !isOpen) continue;
                ++count;
                lowest = std::min(lowest, z);
                highest = std::max(highest, z);
            }
        }
    }
    EXPECT_GT(count, 200);
    EXPECT_GT(highest - lowest, 60);
}

TEST(WildernessCaves, AreOfIceOnlyWhereItIsCold) {
    const Columns columns;
    const BlockId ice = idOf("ice");
    int cold = 0, icy = 0;
    for (int chunkY = -420; chunkY < 60; chunkY += 12) {
        for (int chunkX = 100; chunkX < 340; chunkX += 12) {
            const auto walls = columns.of("upper wall", chunkX, chunkY);
            const auto temperatures = columns.of("cold", chunkX, chunkY);
            for (std::size_t column = 0; column < walls.size(); ++column) {
                const bool isIce = static_cast<BlockId>(walls[column]) == ice;
                EXPECT_TRUE(!isIce || asFloat(temperatures[column]) < -0.45f);
                icy += isIce;
                cold += asFloat(temperatures[column]) < -0.45f;
            }
        }
    }
    EXPECT_GT(cold, 0);
    EXPECT_GT(icy, 0);
}

// Belts of climate lie elsewhere with each seed, but for the land where worlds begin.
TEST(WildernessClimate, FollowsFromTheSeedAndIsTemperateAtTheOrigin) {
    constexpr int kLevel = 6, kTilesFromOrigin = 8;  // 1,024 blocks a tile
    float coldest = 1, warmest = -1;
    for (std::uint64_t seed = 1; seed <= 8; ++seed) {
        const Columns columns(kLevel, seed);
        EXPECT_LT(std::abs(asFloat(columns.of("temperature", 0, 0)[0])), 0.45f) << "seed " << seed;
        const float far = asFloat(columns.of("temperature", 0, kTilesFromOrigin)[0]);
        coldest = std::min(coldest, far);
        warmest = std::max(warmest, far);
    }
    EXPECT_LT(coldest, -0.3f);
    EXPECT_GT(warmest, 0.3f);
}

// Fields of the land of a tile of level 4, column by column.
struct WaterLand {
    static constexpr int kSide = 256;
    std::vector<int> surface, water;

    WaterLand(const Columns& fine, int tileX, int tileY) : surface(kSide * kSide), water(kSide * kSide) {
        for (int chunk = 0; chunk < 256; ++chunk) {
            const int x = tileX * 16 + chunk % 16, y = tileY * 16 + chunk / 16;
            const auto surfaces = fine.of("surface", x, y), waters = fine.of("water", x, y);
            for (int k = 0; k < 256; ++k) {
                const auto column = static_cast<std::size_t>(k);
                const auto at =
                    static_cast<std::size_t>((chunk / 16 * 16 + k / 16) * kSide + chunk % 16 * 16 + k % 16);
                surface[at] = asInt(surfaces[column]);
                water[at] = asInt(waters[column]);
            }
        }
    }
    bool isWater(std::size_t at) const { return surface[at] < water[at]; }
};

// Rivers and lakes are held: beside their water is ground as high, or water, lower by a waterfall at most.
TEST(WildernessWater, IsHeldByItsBanks) {
    constexpr int kHighestFall = 28, kTiles = 5, kReach = 24;
    for (const std::uint64_t seed : {1, 2, 3, 4}) {
        const Columns wide(4, seed), fine(0, seed);
        int found = 0, columns = 0;
        for (int tile = 0; tile < 4 * kReach * kReach && found < kTiles; ++tile) {
            const int tileX = tile % (2 * kReach) - kReach, tileY = tile / (2 * kReach) - kReach;
            const auto waters = wide.of("water", tileX, tileY);
            if (std::ranges::count_if(waters, [](Bits water) { return asInt(water) > 0; }) < 8) continue;
            ++found;
            const WaterLand land(fine, tileX, tileY);
            for (int y = 1; y < WaterLand::kSide - 1; ++y) {
                for (int x = 1; x < WaterLand::kSide - 1; ++x) {
                    const auto at = static_cast<std::size_t>(y * WaterLand::kSide + x);
                    if (!land.isWater(at) || land.water[at] <= 0) continue;
                    ++columns;
                    for (const int offset : {1, -1, WaterLand::kSide, -WaterLand::kSide}) {
                        const auto beside = static_cast<std::size_t>(static_cast<int>(at) + offset);
                        const int level = land.isWater(beside) ? land.water[beside] : land.surface[beside];
                        const int lowest =
                            land.isWater(beside) ? land.water[at] - kHighestFall : land.water[at];
                        ASSERT_GE(level, lowest)
                            << "seed " << seed << ", column " << tileX * 256 + x << ", " << tileY * 256 + y;
                    }
                }
            }
        }
        EXPECT_GT(columns, 1000) << "seed " << seed;
    }
}

// White water falls from pool to pool: below each block of it is more, water or ground. Foam is below the
// surface.
TEST(WildernessWater, FallsAreWhiteDownToTheirPools) {
    const Area area(generatorOf("wilderness", 1), {-57, 216}, 3);
    const BlockId white = idOf("white_water"), water = idOf("water");
    int blocks = 0, onWater = 0, foam = 0;
    for (int y = 0; y < 48; ++y) {
        for (int x = 0; x < 48; ++x) {
            for (int z = 1; z < 400; ++z) {
                if (area.at(x, y, z) != white) continue;
                const BlockId below = area.at(x, y, z - 1), above = area.at(x, y, z + 1);
                ASSERT_NE(below, world::kAir) << area.where(x, y, z);
                ASSERT_TRUE(below == white || above == white || above == water) << area.where(x, y, z);
                ++blocks;
                onWater += below == water;
                foam += above == water;
            }
        }
    }
    EXPECT_GT(blocks, 60);
    EXPECT_GT(onWater, 6) << "foam, and falls that end in their pools";
    EXPECT_GT(foam, 6);
}

// A column of each kind of place that shows that it is there, within 8 km.
TEST(WildernessPlaces, AreAllWithinReach) {
    constexpr int kLevel = 4, kTiles = 32;  // 16 blocks a column, 256 a tile
    const Columns wide(kLevel), fine;
    std::map<int, int> found;
    std::set<std::pair<int, int>> seen;
    for (int tile = 0; tile < 4 * kTiles * kTiles; ++tile) {
        const int tileX = tile % (2 * kTiles) - kTiles, tileY = tile / (2 * kTiles) - kTiles;
        const auto kinds = wide.of("place", tileX, tileY), xs = wide.of("place x", tileX, tileY),
                   ys = wide.of("place y", tileX, tileY);
        for (int k = 0; k < 256; k += 85) {
            const auto column = static_cast<std::size_t>(k);
            const int kind = asInt(kinds[column]);
            if (kind < 0 || found[kind] >= 1) continue;
            const int x = (tileX * 16 + k % 16) * 16 + 8 + asInt(xs[column]),
                      y = (tileY * 16 + k / 16) * 16 + 8 + asInt(ys[column]);
            if (!seen.insert({x, y}).second) continue;
            bool isThere = false;
            switch (static_cast<Place>(kind)) {
                case Place::Arch:
                case Place::SeaArch:
                    isThere = asInt(fine.at("arch high", x, y)) > asInt(fine.at("surface", x, y)) + 8;
                    break;
                case Place::Sinkhole:
                    isThere = asInt(fine.at("surface", x, y)) < 0 && asFloat(fine.at("base", x, y)) > 8;
                    break;
                case Place::HotSprings:
                    isThere = asFloat(fine.at("spring", x, y)) > 0;
                    break;
                default:
                    isThere = asInt(fine.at("tree", x, y)) >= 0;
                    break;
            }
            found[kind] += isThere;
        }
    }
    for (int kind = 0; kind < static_cast<int>(Place::Count); ++kind)
        EXPECT_GE(found[kind], 1) << "kind " << kind;
}

// Levels agree where the point of a square is and what is there.
TEST(WildernessPlaces, AreTheSameAtAllLevels) {
    const Columns fine;
    for (const int level : {1, 3, 5}) {
        const Columns coarse(level);
        for (int x = -3000; x < 3000; x += 700) {
            const int step = 1 << level, column = (x >> level) * step + step / 2;
            const int wide = x >> level;
            EXPECT_EQ(asInt(coarse.at("place", wide, wide)), asInt(fine.at("place", column, column)));
            EXPECT_EQ(asInt(coarse.at("place x", wide, wide)), asInt(fine.at("place x", column, column)));
        }
    }
}

}  // namespace
}  // namespace terrane::gen

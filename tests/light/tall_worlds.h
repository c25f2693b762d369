// Random worlds of many heights: sky with an island, ground, bands of rock, caves and halls down to the
// bottom, shafts from top to bottom, and lamps at borders of chunks and sections and in the lowest and
// highest layers.
#pragma once

#include <array>
#include <cstdint>

#include "tests/light/test_area.h"

namespace terrane::light {

struct TallWorld {
    world::Heights heights;
    std::uint32_t seed = 0;

    world::BlockId operator()(int x, int y, int z) const {
        const std::uint32_t hash = hashAt(x, y, z, seed);
        if ((z == heights.bottom || z == heights.top - 1) && hash % 30 == 0) return lamp(hash / 30);
        if (isShaft(x, y)) return world::kAir;
        const bool isAtBorder = ((x + 1) & 15) < 2 && ((y + 1) & 15) < 2 && ((z + 1) & 15) < 2;
        if (isAtBorder && hash % 12 == 0) return lamp(hash / 12);
        const int bump = static_cast<int>(hashAt(x / 5, y / 4, 0, seed) % 6);
        if (z >= ground() + bump) return isIsland(x, z) ? contentBlock("stone") : world::kAir;
        return underground(x, y, z, hash);
    }

  private:
    int ground() const { return heights.bottom + heights.layers() * static_cast<int>(4 + seed % 4) / 10; }
    // One of 1×1 and one of 2×2, across the border of two chunks.
    bool isShaft(int x, int y) const {
        const int at = static_cast<int>(2 + seed % 11);
        return (x == at && y == at) || ((x == 15 || x == 16) && (y == at + 3 || y == at + 4));
    }
    bool isIsland(int x, int z) const {
        const int bottom = ground() + (heights.top - ground()) / 2;
        return x >= 5 && x < 24 && z >= bottom && z < bottom + 3;
    }
    static world::BlockId lamp(std::uint32_t hash) {
        static const std::array kLamps = {contentBlock("lamp_white"), contentBlock("lamp_red"),
                                          contentBlock("lamp_green"), contentBlock("lamp_blue"),
                                          contentBlock("glowing_mushroom")};
        return kLamps[hash % kLamps.size()];
    }
    world::BlockId underground(int x, int y, int z, std::uint32_t hash) const {
        static const world::BlockId kStone = contentBlock("stone"), kOre = contentBlock("glowing_ore"),
                                    kWater = contentBlock("water");
        switch (hashAt(0, 0, z >> 5, seed) % 5) {
            case 0:  // caves with holes in their walls
            case 1: {
                const bool isWall = x % 7 == 0 || y % 6 == 0 || z % 5 == 0;
                if (isWall) return hash % 12 == 0 ? world::kAir : kStone;
                return hash % 90 == 0 ? anyBlock(hash / 90) : world::kAir;
            }
            case 2:  // a hall
                return x % 11 == 0 && y % 11 == 0 ? kStone : world::kAir;
            case 3:
                return hash % 4 != 0 ? kWater : kStone;
            default:
                return hash % 300 == 0 ? kOre : kStone;
        }
    }
};

// Ten worlds: tall ones, one of a single section at each end of the heights that there are, and others.
inline TallWorld tallWorld(std::uint32_t seed) {
    constexpr std::array<world::Heights, 10> kHeights = {{{-64, 320},
                                                          {512, 1024},
                                                          {2032, 2048},
                                                          {-2048, 2048},
                                                          {-2048, -2032},
                                                          {-512, 0},
                                                          {-256, 768},
                                                          {-1024, 1024},
                                                          {0, 512},
                                                          {16, 272}}};
    return {kHeights[seed % kHeights.size()], seed};
}

}  // namespace terrane::light

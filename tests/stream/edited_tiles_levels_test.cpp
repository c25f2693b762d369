// Remains of buildings, level by level, on flat land: grass at 80.
#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "tests/stream/edited_world.h"

namespace terrane::stream {
namespace {

using world::BlockPos;

constexpr int kTop = 6;
constexpr int kSpacing = 256;  // of the sites: none shares a column with the next at any level

// The same building at many places: the remains of one are random, their mean is not.
class Sites : public testing::Test {
  protected:
    void build(int perSide, int spacing, auto buildAt) {
        std::mt19937 random(3);
        for (int k = 0; k < perSide * perSide; ++k) {
            const auto jitter = [&] { return static_cast<int>(random() % 64); };
            const BlockPos site{(k % perSide - perSide / 2) * spacing + jitter(),
                                (k / perSide - perSide / 2) * spacing + jitter(), 81};
            sites_.push_back(site);
            buildAt(site);
        }
        world_.update();
    }
    // The mean area around a site, in blocks, of columns for which `holds` is true.
    double meanArea(int level, auto holds) {
        std::int64_t columns = 0;
        for (const BlockPos& site : sites_) {
            for (int y = (site.y - 64) >> level; y <= (site.y + 127) >> level; ++y)
                for (int x = (site.x - 64) >> level; x <= (site.x + 127) >> level; ++x)
                    columns += holds(x, y);
        }
        return std::ldexp(static_cast<double>(columns), 2 * level) / static_cast<double>(sites_.size());
    }
    // Each column of the level stays by chance, by the share of it that was covered: the variance of their
    // number is below its mean.
    void expectArea(int level, double area, double expected) const {
        const double columns = std::ldexp(expected * static_cast<double>(sites_.size()), -2 * level);
        EXPECT_NEAR(area / expected, 1, 3 / std::sqrt(columns)) << "level " << level;
    }
    std::string blockAt(int level, int x, int y, int z) {
        return contentBlocks().type(world_.block(level, x, y, z)).name;
    }
    // The block of the column that covers a place.
    std::string blockOver(int level, BlockPos pos) {
        return blockAt(level, pos.x >> level, pos.y >> level, pos.z);
    }

    gen::LevelGenerators flat_ = generatorsOf("flat");
    EditedWorld world_{flat_, kTop};
    std::vector<BlockPos> sites_;
};

TEST_F(Sites, PlatformsKeepTheirArea) {
    build(6, kSpacing, [&](BlockPos at) {
        world_.fill({{at.x, at.y, 120}, {at.x + 63, at.y + 63, 122}}, "stone");
    });
    for (int level = 1; level <= kTop; ++level) {
        const double area = meanArea(level, [&](int x, int y) {
            const std::string block = blockAt(level, x, y, 121);
            EXPECT_EQ(blockAt(level, x, y, 120), block) << "whole or gone";
            EXPECT_EQ(blockAt(level, x, y, 122), block);
            EXPECT_EQ(blockAt(level, x, y, 119), "air");
            EXPECT_EQ(blockAt(level, x, y, 80), "grass");
            return block == "stone";
        });
        expectArea(level, area, 4096);
    }
}

TEST_F(Sites, LampsOnPlatformsShineAtEveryLevel) {
    const auto lampsOf = [](BlockPos site) {
        std::vector<BlockPos> lamps;
        for (int k = 0; k < 16; ++k) lamps.push_back({site.x + k % 4 * 16 + 5, site.y + k / 4 * 16 + 5, 126});
        return lamps;
    };
    build(2, kSpacing, [&](BlockPos at) {
        world_.fill({{at.x, at.y, 120}, {at.x + 63, at.y + 63, 122}}, "stone");
        for (const BlockPos lamp : lampsOf(at)) {
            world_.fill({{lamp.x, lamp.y, 123}, lamp}, "oak_log");
            world_.set(lamp, "lamp_white");
        }
    });
    for (int level = 1; level <= kTop; ++level) {
        for (const BlockPos& site : sites_) {
            for (const BlockPos lamp : lampsOf(site)) ASSERT_EQ(blockOver(level, lamp), "lamp_white");
        }
        const double area =
            meanArea(level, [&](int x, int y) { return blockAt(level, x, y, 126) == "lamp_white"; });
        EXPECT_LE(area, 16 * std::ldexp(1.0, 2 * level)) << "no more than a column a lamp";
    }
}

TEST_F(Sites, PitsKeepTheirArea) {
    build(6, kSpacing, [&](BlockPos at) {
        world_.fill({{at.x, at.y, 61}, {at.x + 47, at.y + 47, 80}}, "air");
    });
    for (int level = 1; level <= kTop; ++level) {
        const double area = meanArea(level, [&](int x, int y) {
            const bool isPit = blockAt(level, x, y, 70) == "air";
            EXPECT_EQ(blockAt(level, x, y, 61), isPit ? "air" : "stone") << "whole or gone";
            EXPECT_EQ(blockAt(level, x, y, 80), isPit ? "air" : "grass");
            EXPECT_EQ(blockAt(level, x, y, 60), "stone");
            return isPit;
        });
        expectArea(level, area, 48 * 48);
    }
}

// Nine houses with walls of one block, a roof, and a lamp under it.
TEST_F(Sites, VillagesKeepTheirRoofsAndLights) {
    const auto housesOf = [](BlockPos site) {
        std::vector<BlockPos> houses;
        for (int k = 0; k < 9; ++k) houses.push_back({site.x + k % 3 * 13, site.y + k / 3 * 13, 81});
        return houses;
    };
    build(6, kSpacing, [&](BlockPos at) {
        for (const BlockPos house : housesOf(at)) {
            world_.fill({house, {house.x + 7, house.y + 7, 86}}, "oak_log");
            world_.fill({{house.x + 1, house.y + 1, 81}, {house.x + 6, house.y + 6, 85}}, "air");
            world_.set({house.x + 3, house.y + 3, 84}, "lamp_white");
        }
    });
    for (int level = 1; level <= kTop; ++level) {
        const double area = meanArea(level, [&](int x, int y) {
            EXPECT_EQ(blockAt(level, x, y, 87), "air");
            return blockAt(level, x, y, 86) == "oak_log";
        });
        expectArea(level, area, 9 * 64);
        for (const BlockPos& site : sites_) {
            for (const BlockPos house : housesOf(site))
                ASSERT_EQ(blockOver(level, {house.x + 3, house.y + 3, 84}), "lamp_white");
        }
    }
}

TEST_F(Sites, ThinTowersStayWholeOrGo) {
    build(24, 64, [&](BlockPos at) { world_.fill({at, {at.x, at.y, 140}}, "stone"); });
    for (int level = 1; level <= kTop; ++level) {
        int left = 0;
        for (const BlockPos& site : sites_) {
            const bool isLeft = blockOver(level, site) == "stone";
            for (int z = 81; z < 256; ++z) {
                ASSERT_EQ(blockOver(level, {site.x, site.y, z}), isLeft && z <= 140 ? "stone" : "air");
            }
            left += isLeft;
        }
        // Each level keeps a quarter of them, four times as wide in area.
        const double share = std::ldexp(1.0, -2 * level), count = static_cast<double>(sites_.size());
        EXPECT_NEAR(left, share * count, 4 * std::sqrt(share * (1 - share) * count)) << "level " << level;
    }
}

}  // namespace
}  // namespace terrane::stream

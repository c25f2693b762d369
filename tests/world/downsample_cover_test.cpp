// The mean cover of many columns stays the same.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

#include "tests/world/downsample_columns.h"

namespace terrane::world {
namespace {

TEST(DownsampleCover, EachThresholdHasAQuarterOfTheColumns) {
    for (const std::uint8_t level : {1, 2, 6, 15}) {
        std::array<int, 5> counts{};
        forEachParent(level, [&](ColumnPos at) { ++counts[static_cast<std::size_t>(coverThreshold(at))]; });
        for (int t = 1; t <= 4; ++t) {
            EXPECT_NEAR(counts[static_cast<std::size_t>(t)], 1600, 5 * std::sqrt(1200.0)) << int{level};
        }
    }
}

// Columns of a square, level by level; a tower of a block's width is 1.
std::vector<BlockColumn> parentsOf(const std::vector<BlockColumn>& columns, int width, std::uint8_t level,
                                   int origin) {
    std::vector<BlockColumn> parents;
    const auto at = [&](int x, int y) { return columns[static_cast<std::size_t>(y * width + x)]; };
    for (int y = 0; y < width; y += 2) {
        for (int x = 0; x < width; x += 2) {
            const Children children{at(x, y), at(x + 1, y), at(x, y + 1), at(x + 1, y + 1)};
            parents.push_back(down(children, {origin + x / 2, y / 2 - origin, level}));
        }
    }
    return parents;
}

TEST(DownsampleCover, ThinTowersKeepTheirMeanCoverAndStayWhole) {
    constexpr int kWidth = 64, kSquares = 100;
    const BlockColumn ground = landOf(80);
    BlockColumn tower = ground;
    fill(tower, 81, 140, "oak_log");
    std::mt19937 random(4);
    std::array<double, 7> sum{}, squares{};
    for (int square = 0; square < kSquares; ++square) {
        std::vector<BlockColumn> columns(kWidth * kWidth, ground);
        for (BlockColumn& column : columns)
            if (random() % 20 == 0) column = tower;
        for (int level = 0, width = kWidth; level <= 6; ++level, width /= 2) {
            if (level > 0)
                columns = parentsOf(columns, width * 2, static_cast<std::uint8_t>(level), square * width);
            const auto towers = std::count(columns.begin(), columns.end(), tower);
            const auto others = std::count(columns.begin(), columns.end(), ground);
            ASSERT_EQ(towers + others, width * width) << "whole or gone";
            const double cover = static_cast<double>(towers) / (width * width);
            sum[static_cast<std::size_t>(level)] += cover;
            squares[static_cast<std::size_t>(level)] += cover * cover;
        }
    }
    for (std::size_t level = 0; level <= 6; ++level) {
        const double mean = sum[level] / kSquares;
        const double deviation = std::sqrt((squares[level] / kSquares - mean * mean) / kSquares);
        EXPECT_NEAR(mean, 0.05, 4 * deviation + 1e-9) << "level " << level;
    }
}

TEST(DownsampleCover, CrownsKeepTheirCover) {
    std::mt19937 random(5);
    double children = 0, parents = 0;
    forEachParent(1, [&](ColumnPos at) {
        Children four;
        for (BlockColumn& column : four) {
            column = landOf(80);
            if (random() % 3 > 0) continue;
            fill(column, 85, 88, "oak_leaves");
            children += 0.25;
        }
        const BlockColumn out = down(four, at);
        EXPECT_EQ(out[85], out[87]);
        parents += out[85] == contentBlock("oak_leaves");
    });
    EXPECT_NEAR(parents / children, 1, 0.05);
}

TEST(DownsampleCover, ACoastKeepsItsCoverOfWaterAndHasNoWallsOfIt) {
    double children = 0, parents = 0;
    std::mt19937 random(6);
    forEachParent(1, [&](ColumnPos at) {
        Children four;
        for (BlockColumn& column : four) {
            const bool isSea = random() % 2 == 0;
            column = isSea ? seaOf(50 + static_cast<int>(random() % 10))
                           : landOf(63 + static_cast<int>(random() % 9));
            children += isSea * 0.25;
        }
        const BlockColumn out = down(four, at);
        const auto water = contentBlock("water");
        parents += out[62] == water;
        ASSERT_EQ(std::count(out.begin() + 63, out.end(), water), 0);
        // From the bottom to the surface: no air under water.
        for (std::size_t z = 0; z < 63; ++z) ASSERT_NE(out[z], kAir);
    });
    EXPECT_NEAR(parents / children, 1, 0.03);
}

}  // namespace
}  // namespace terrane::world

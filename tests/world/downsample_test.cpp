#include "terrane/world/downsample.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "tests/world/content_blocks.h"

namespace terrane::world {
namespace {

using Children = std::array<BlockColumn, 4>;

const DownsampleRule& rule() {
    static const DownsampleRule rule = downsampleRule(contentBlocks());
    return rule;
}

BlockColumn down(const Children& children, ColumnPos parent) {
    BlockColumn out;
    downsampleColumn(rule(), children, parent, out);
    return out;
}

BlockColumn columnOf(BlockId id) {
    BlockColumn column;
    column.fill(id);
    return column;
}

void fill(BlockColumn& column, int from, int to, std::string_view name) {
    std::fill(column.begin() + from, column.begin() + to, contentBlock(name));
}

// Stone, three dirt, grass at top; air above, or water up to 62.
BlockColumn landOf(int top) {
    BlockColumn column = columnOf(kAir);
    fill(column, 0, 63, "water");
    fill(column, 0, top + 1, "stone");
    fill(column, top - 3, top + 1, "dirt");
    fill(column, top, top + 1, "grass");
    return column;
}

BlockColumn seaOf(int bottom) {
    BlockColumn column = columnOf(kAir);
    fill(column, 0, 63, "water");
    fill(column, 0, bottom, "sand");
    return column;
}

int heightOf(const BlockColumn& column) {
    int z = kChunkHeight;
    while (z > 0 && column[static_cast<std::size_t>(z - 1)] == kAir) --z;
    return z;
}

// The first position with the threshold.
ColumnPos posWith(int threshold) {
    ColumnPos pos{.x = -3, .y = 5, .level = 1};
    while (coverThreshold(pos) != threshold) ++pos.x;
    return pos;
}

// Calls use(parent) for some thousand positions about the origin.
void forEachParent(std::uint8_t level, auto use) {
    for (int x = -40; x < 40; ++x)
        for (int y = -40; y < 40; ++y) use(ColumnPos{x, y, level});
}

TEST(Downsample, WhatIsEqualStays) {
    for (const BlockType& type : contentBlocks().types()) {
        const DownsampleKind& kind = rule().kind(type.id);
        const bool stays = kind.fill != DownsampleKind::Fill::Open || kind.glow > 0;
        Children children;
        children.fill(columnOf(type.id));
        forEachParent(3, [&](ColumnPos at) {
            ASSERT_EQ(down(children, at), columnOf(stays ? type.id : kAir)) << type.name;
        });
    }
}

TEST(Downsample, FlatLandAndSeaStayToTheBlock) {
    for (const BlockColumn& column : {landOf(80), landOf(40), seaOf(30)}) {
        Children children;
        children.fill(column);
        forEachParent(2, [&](ColumnPos at) { ASSERT_EQ(down(children, at), column); });
    }
}

TEST(Downsample, EachThresholdHasAQuarterOfTheColumns) {
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

TEST(Downsample, ThinTowersKeepTheirMeanCoverAndStayWhole) {
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

TEST(Downsample, CrownsKeepTheirCover) {
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

TEST(Downsample, ACoastKeepsItsCoverOfWaterAndHasNoWallsOfIt) {
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

TEST(Downsample, AFewColumnsWithoutWaterMakeNoHoleInTheSea) {
    Children four;
    four.fill(seaOf(30));
    four[2] = columnOf(kAir);
    forEachParent(1, [&](ColumnPos at) { ASSERT_EQ(down(four, at)[62], contentBlock("water")); });
    four[0] = four[1] = columnOf(kAir);
    forEachParent(1, [&](ColumnPos at) { ASSERT_EQ(down(four, at)[62], kAir) << "one of four"; });
}

TEST(Downsample, TheTopOfASlopeIsWhatIsSeenFromAbove) {
    std::mt19937 random(7);
    forEachParent(2, [&](ColumnPos at) {
        Children four;
        std::array<int, 4> heights;
        for (std::size_t i = 0; i < 4; ++i) {
            heights[i] = 70 + static_cast<int>(random() % 6);
            four[i] = landOf(heights[i]);
            fill(four[i], heights[i] + 1, heights[i] + 2, "poppy");
        }
        std::sort(heights.begin(), heights.end());
        const BlockColumn out = down(four, at);
        ASSERT_EQ(heightOf(out), heights[static_cast<std::size_t>(4 - coverThreshold(at))] + 1);
        ASSERT_EQ(out[static_cast<std::size_t>(heightOf(out) - 1)], contentBlock("grass"));
    });
}

TEST(Downsample, WhatIsSeenFromTheSideComesBeforeWhatIsHidden) {
    Children four;
    four.fill(columnOf(contentBlock("stone")));  // the one at (1, 1) touches no open one
    fill(four[1], 0, 256, "dirt");
    fill(four[2], 0, 256, "sand");
    std::fill(four[0].begin() + 90, four[0].end(), kAir);
    std::fill(four[3].begin() + 100, four[3].end(), kAir);
    for (int threshold = 1; threshold <= 3; ++threshold) {
        const BlockColumn out = down(four, posWith(threshold));
        EXPECT_NE(out[98], contentBlock("stone")) << "hidden";
        EXPECT_EQ(out[99], contentBlock("stone")) << "seen from above";
        EXPECT_EQ(out[80], contentBlock("stone")) << "all hidden: the most frequent";
        EXPECT_EQ(out[98], out[97]);
    }
}

TEST(Downsample, TheStrongestLightStays) {
    for (int lit = 0; lit < 4; ++lit) {
        Children four;
        four.fill(landOf(80));
        auto& column = four[static_cast<std::size_t>(lit)];
        fill(column, 81, 90, "oak_log");
        fill(column, 90, 91, "lamp_red");
        fill(four[static_cast<std::size_t>(lit ^ 3)], 90, 91, "glowing_mushroom");
        fill(four[static_cast<std::size_t>(lit ^ 1)], 95, 96, "glowing_mushroom");
        fill(four[static_cast<std::size_t>(lit ^ 1)], 79, 80, "glowing_ore");
        for (int threshold = 1; threshold <= 4; ++threshold) {
            const BlockColumn out = down(four, posWith(threshold));
            EXPECT_EQ(out[90], contentBlock("lamp_red"));
            EXPECT_EQ(out[95], contentBlock("glowing_mushroom")) << "no cube, but it glows";
            EXPECT_EQ(out[85], threshold == 1 ? contentBlock("oak_log") : kAir);
            EXPECT_NE(out[79], contentBlock("glowing_ore")) << "too weak to be seen, and hidden";
        }
    }
}

// The rule of downsample.h once more, block by block: what the slice may become. Several where the hash
// decides.
std::set<BlockId> slowSlice(const Children& c, std::size_t z, ColumnPos at) {
    const auto kind = [&](std::size_t i, std::size_t height) {
        return height < kChunkHeight ? rule().kind(c[i][height]) : DownsampleKind{};
    };
    int solid = 0, liquid = 0, glow = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        solid += kind(i, z).fill == DownsampleKind::Fill::Solid;
        liquid += kind(i, z).fill == DownsampleKind::Fill::Liquid;
        glow = std::max<int>(glow, kind(i, z).glow);
    }
    const bool isSolid = solid >= coverThreshold(at);
    std::vector<std::pair<int, BlockId>> candidates;
    for (std::size_t i = 0; i < 4; ++i) {
        const bool isSeen = !kind(i ^ 1, z).isOpaque || !kind(i ^ 2, z).isOpaque;
        const int place = !kind(i, z + 1).isOpaque ? 2 : isSeen ? 1 : 0;
        if (glow > 0) {
            if (kind(i, z).glow == glow) candidates.emplace_back(0, c[i][z]);
        } else if (isSolid) {
            if (kind(i, z).fill == DownsampleKind::Fill::Solid) candidates.emplace_back(place, c[i][z]);
        } else if (liquid > 0 && liquid >= 4 - solid - liquid) {
            if (kind(i, z).fill == DownsampleKind::Fill::Liquid) candidates.emplace_back(0, c[i][z]);
        }
    }
    if (candidates.empty()) return {kAir};
    const int best = std::max_element(candidates.begin(), candidates.end())->first;
    std::erase_if(candidates, [&](const auto& candidate) { return candidate.first != best; });
    const auto count = [&](const auto& candidate) {
        return std::count(candidates.begin(), candidates.end(), candidate);
    };
    std::ptrdiff_t most = 0;
    for (const auto& candidate : candidates) most = std::max(most, count(candidate));
    std::set<BlockId> allowed;
    for (const auto& candidate : candidates)
        if (count(candidate) == most) allowed.insert(candidate.second);
    return allowed;
}

TEST(Downsample, RandomColumnsFollowTheRule) {
    std::mt19937 random(8);
    const auto blocks = static_cast<std::uint32_t>(contentBlocks().types().size());
    std::size_t ties = 0;
    for (int n = 0; n < 500; ++n) {
        const std::uint32_t kinds = n % 3 == 0 ? blocks + 2 : 1 + random() % 6, first = random() % blocks;
        const std::uint32_t runs = 1 + random() % 20;
        Children four;
        for (BlockColumn& column : four) {
            BlockId id = kAir;
            for (BlockId& block : column) {
                if (random() % runs == 0)
                    id = static_cast<BlockId>((first + random() % kinds) % (blocks + 2));
                block = id;
            }
        }
        const ColumnPos at{static_cast<std::int32_t>(random()), static_cast<std::int32_t>(random()),
                           static_cast<std::uint8_t>(1 + random() % 15)};
        const BlockColumn out = down(four, at);
        ASSERT_EQ(out, down(four, at));
        for (std::size_t z = 0; z < kChunkHeight; ++z) {
            const std::set<BlockId> allowed = slowSlice(four, z, at);
            ASSERT_TRUE(allowed.contains(out[z])) << "z " << z << ", is " << out[z];
            ties += allowed.size() > 1;
        }
    }
    EXPECT_GT(ties, 1000u);
}

// The hash must be the same on every machine and forever: tiles are saved.
TEST(Downsample, ThresholdsOfSomePlaces) {
    std::vector<int> thresholds;
    for (int x = -4; x < 4; ++x) thresholds.push_back(coverThreshold({x, 3 * x + 1, 2}));
    EXPECT_EQ(thresholds, (std::vector<int>{1, 4, 4, 1, 2, 3, 2, 3}));
}

}  // namespace
}  // namespace terrane::world

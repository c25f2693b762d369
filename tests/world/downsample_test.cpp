#include "terrane/world/downsample.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <vector>

#include "tests/support/default_heights.h"
#include "tests/world/downsample_columns.h"

namespace terrane::world {
namespace {

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

// The rule of downsample.h once more, block by block: the possible blocks of the slice, several if the hash
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
            column.resize(kChunkHeight);
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

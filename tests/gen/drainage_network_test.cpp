#include "terrane/gen/drainage/drainage_network.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <limits>

#include "tests/gen/drainage_land.h"

namespace terrane::gen {
namespace {

// Blocks, by the place of a node.
using HeightOf = std::function<float(int x, int y)>;

std::uint32_t hashAt(int x, int y) {
    return shared::hash2(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y), 77);
}

DrainageNetwork networkOf(int cornerX, int cornerY, int side, const DrainageSpec& spec,
                          const HeightOf& height, const HeightOf& gradient = {}) {
    DrainageNetwork n;
    n.side = side;
    for (int y = cornerY; y < cornerY + side; ++y) {
        for (int x = cornerX; x < cornerX + side; ++x) {
            n.heights.push_back(heightKey(height(x, y), hashAt(x, y)));
            if (gradient) n.gradients.push_back(gradient(x, y));
        }
    }
    findDrainage(n, spec);
    return n;
}

// Sea in the west, land that rises to the east, rough enough for many pits.
float roughLand(int x, int y) {
    return 50.0f + 0.3f * static_cast<float>(x) + static_cast<float>(hashAt(x / 2, y / 2) >> 24) * 0.06f +
           static_cast<float>(hashAt(x, y) >> 24) * 0.03f;
}

float roughGradient(int x, int y) {
    return static_cast<float>(hashAt(x + 7, y) >> 24) * 0.002f;
}

constexpr int kInside = kNetworkMargin - 2;

TEST(DrainageNetwork, WaysFallToTheSeaOrALake) {
    const DrainageNetwork n = networkOf(0, 0, 220, kDrainageSpec, roughLand);
    const HeightKey sea = heightKey(kDrainageSpec.seaLevel, 0);
    int ends = 0, pits = 0;
    for (int y = 1; y < n.side - 1; ++y) {
        for (int x = 1; x < n.side - 1; ++x) {
            const std::size_t node = n.at(x, y);
            const bool isInside = x >= kFloodReach + 1 && y >= kFloodReach + 1 &&
                                  x < n.side - kFloodReach - 1 && y < n.side - kFloodReach - 1;
            if (n.heights[node] < sea) {
                EXPECT_EQ(n.drains[node], kNoDrain);
            } else if (n.drains[node] != kNoDrain) {
                EXPECT_LT(n.levels[n.drainOf(node)], n.levels[node])
                    << "a ring is possible at " << x << "," << y;
                pits += n.heights[n.drainOf(node)] > n.heights[node];
            } else if (isInside) {
                EXPECT_GT(n.lakeNodes[node], 0) << "water ends on land at " << x << "," << y;
                ++ends;
            }
        }
    }
    EXPECT_GT(pits, 50) << "this land is to have pits that are cut open";
    EXPECT_LT(ends, 10);
}

TEST(DrainageNetwork, IsTheSameFromAnyWindow) {
    const int side = 2 * kInside + 20;
    const DrainageNetwork a = networkOf(100, 40, side, kDrainageSpec, roughLand, roughGradient);
    const DrainageNetwork b = networkOf(107, 29, side, kDrainageSpec, roughLand, roughGradient);
    for (int y = 40 + kInside; y < 29 + side - kInside; ++y) {
        for (int x = 107 + kInside; x < 100 + side - kInside; ++x) {
            const std::size_t inA = a.at(x - 100, y - 40), inB = b.at(x - 107, y - 29);
            ASSERT_EQ(a.levels[inA], b.levels[inB]) << x << "," << y;
            ASSERT_EQ(a.drains[inA], b.drains[inB]) << x << "," << y;
            ASSERT_EQ(a.flows[inA], b.flows[inB]) << x << "," << y;
            ASSERT_EQ(a.lakeNodes[inA], b.lakeNodes[inB]) << x << "," << y;
        }
    }
}

// Nodes upstream within some steps, by recursion.
int upstream(const DrainageNetwork& n, std::size_t node, int steps) {
    int count = 1;
    for (const auto& [dx, dy] : kDirections) {
        const std::size_t other = node + static_cast<std::size_t>(dy * n.side + dx);
        if (steps > 0 && n.drains[other] != kNoDrain && n.drainOf(other) == node) {
            count += upstream(n, other, steps - 1);
        }
    }
    return count;
}

TEST(DrainageNetwork, FlowCountsNodesUpstream) {
    const DrainageNetwork n = networkOf(0, 0, 120, kDrainageSpec, roughLand);
    int largest = 0;
    for (int y = 40; y < 80; ++y) {
        for (int x = 40; x < 80; ++x) {
            ASSERT_EQ(n.flows[n.at(x, y)], upstream(n, n.at(x, y), kMaxUpstream));
            largest = std::max<int>(largest, n.flows[n.at(x, y)]);
        }
    }
    EXPECT_GT(largest, 100);
}

// From the sea and large rivers up, each stream is higher than the next by what its gradient and flow say.
TEST(DrainageNetwork, StreamsRiseByTheirGradient) {
    const DrainageNetwork n = networkOf(0, 0, 220, kDrainageSpec, roughLand, roughGradient);
    const DrainageNetwork cut = networkOf(0, 0, 220, kDrainageSpec, roughLand);
    EXPECT_EQ(n.drains, cut.drains);
    const HeightKey sea = heightKey(kDrainageSpec.seaLevel, 0);
    int trunks = 0, streams = 0;
    for (int y = 1; y < n.side - 1; ++y) {
        for (int x = 1; x < n.side - 1; ++x) {
            const std::size_t node = n.at(x, y);
            if (n.drains[node] == kNoDrain || n.flows[node] >= kTrunkFlow) {
                ASSERT_EQ(n.levels[node], cut.levels[node]);
                ++trunks;
                continue;
            }
            const std::size_t next = n.drainOf(node);
            const bool isDiagonal = next != node + 1 && next + 1 != node &&
                                    next != node + static_cast<std::size_t>(n.side) &&
                                    next + static_cast<std::size_t>(n.side) != node;
            const double length = kDrainageSpec.spacing * (isDiagonal ? std::sqrt(2.0) : 1.0);
            const double rise = roughGradient(x, y) * length / std::sqrt(n.flows[node]);
            EXPECT_NEAR(heightOf(n.levels[node]) - heightOf(std::max(n.levels[next], sea)), rise, 1e-3);
            EXPECT_GT(n.levels[node], n.levels[next]) << "every stream falls";
            ++streams;
        }
    }
    EXPECT_GT(trunks, 500);
    EXPECT_GT(streams, 10000);
}

// A slope to the west with a hollow of 5×5 nodes, of which the bottom is in the middle.
HeightOf slopeWithHollow(float depth) {
    return [depth](int x, int y) {
        const float slope = 70.0f + 2.0f * static_cast<float>(x),
                    away = static_cast<float>(std::max(std::abs(x - 40), std::abs(y - 40)));
        return away > 2 ? slope : 150.0f - depth + away;
    };
}

TEST(DrainageNetwork, DeepWideHollowsHoldLakesThatWaterLeaves) {
    DrainageSpec spec = kDrainageSpec;
    spec.lakeDepth = 8.0f;
    const DrainageNetwork shallow = networkOf(0, 0, 80, spec, slopeWithHollow(7.0f));
    const DrainageNetwork deep = networkOf(0, 0, 80, spec, slopeWithHollow(15.0f));
    const std::size_t bottom = deep.at(40, 40);
    EXPECT_EQ(shallow.lakeNodes[bottom], 0);
    EXPECT_EQ(deep.lakeNodes[bottom], 25);
    for (const DrainageNetwork* n : {&shallow, &deep}) {
        std::size_t node = bottom;
        for (int k = 0; k < 8; ++k) {
            ASSERT_NE(n->drains[node], kNoDrain);
            node = n->drainOf(node);
        }
        EXPECT_LT(n->heights[node], n->heights[bottom]) << "the way out leads to lower land";
    }
}

TEST(DrainageNetwork, WaterStaysInHollowsTooDeepToCut) {
    DrainageSpec spec = kDrainageSpec;
    spec.maxCut = 5.0f;
    const DrainageNetwork n = networkOf(0, 0, 80, spec, slopeWithHollow(15.0f));
    EXPECT_EQ(n.drains[n.at(40, 40)], kNoDrain);
    EXPECT_GT(n.lakeNodes[n.at(40, 40)], 0);
}

TEST(DrainageNetwork, HeightKeysAreInTheOrderOfHeights) {
    EXPECT_LT(heightKey(61.99f, ~0u), heightKey(62.0f, 0));
    EXPECT_LT(heightKey(-3.0f, 5u << 28), heightKey(-3.0f, 6u << 28));
    EXPECT_EQ(heightOf(heightKey(-17.25f, ~0u)), -17.25f);
    EXPECT_EQ(heightOf(heightKey(std::numeric_limits<float>::quiet_NaN(), 0)), -8192.0f);
    EXPECT_EQ(heightOf(heightKey(1e30f, 0)), 8192.0f);
}

// Flat land: ties are broken by hashes, and still everything drains.
TEST(DrainageNetwork, FlatLandDrains) {
    const DrainageNetwork n =
        networkOf(0, 0, 90, kDrainageSpec, [](int x, int) { return x < 30 ? 60.0f : 70.0f; });
    for (int x = 31; x < 36; ++x) {
        std::size_t node = n.at(x, 45);
        while (n.drains[node] != kNoDrain) node = n.drainOf(node);
        EXPECT_TRUE(heightOf(n.heights[node]) < 62.0f || n.lakeNodes[node] > 0);
    }
}

}  // namespace
}  // namespace terrane::gen

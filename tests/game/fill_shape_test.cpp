// Each shape against a slow definition, in boxes of any size and at both ends of the world's coordinates.
#include "terrane/game/fill_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

namespace terrane::game {
namespace {

using world::BlockBox;
using world::BlockPos;

constexpr std::int32_t kFirst = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kLast = std::numeric_limits<std::int32_t>::max();

// Boxes with sides up to `most` blocks: anywhere, and with a corner at each corner of the world.
std::vector<BlockBox> boxes(int most) {
    std::mt19937 random(7);
    const auto upTo = [&](int count) {
        return static_cast<std::int32_t>(random() % static_cast<unsigned>(count));
    };
    std::vector<BlockBox> boxes;
    for (int k = 0; k < 120; ++k) {
        const std::int32_t width = upTo(most), depth = upTo(most), height = upTo(most), z = upTo(200);
        const auto add = [&](std::int32_t x, std::int32_t y) {
            boxes.push_back({{x, y, z}, {x + width, y + depth, z + height}});
        };
        add(upTo(1000) - 500, upTo(1000) - 500);
        add(kFirst, kFirst);
        add(kLast - width, kLast - depth);
        add(kFirst, kLast - depth);
        add(kLast - width, kFirst);
    }
    return boxes;
}

void forEachBlock(const BlockBox& box, const std::function<void(BlockPos)>& function) {
    for (std::int64_t k = 0; k < box.blockCount(); ++k) function(box.blockAt(k));
}

bool isIn(const BlockBox& box, std::int64_t x, std::int64_t y, std::int64_t z) {
    return x >= box.low.x && x <= box.high.x && y >= box.low.y && y <= box.high.y && z >= box.low.z &&
           z <= box.high.z;
}

std::vector<BlockPos> blocksOf(const FillShape& shape, const BlockBox& box) {
    std::vector<BlockPos> blocks;
    forEachBlock(box, [&](BlockPos pos) {
        if (contains(shape, box, pos)) blocks.push_back(pos);
    });
    return blocks;
}

TEST(FillShape, SolidIsTheBox) {
    for (const BlockBox& box : boxes(6)) EXPECT_EQ(std::ssize(blocksOf({}, box)), box.blockCount());
}

// The box without the box inside it.
TEST(FillShape, HollowLeavesTheBoxInside) {
    for (const BlockBox& box : boxes(9))
        forEachBlock(box, [&](BlockPos pos) {
            bool isInside = true;
            for (int dz = -1; dz <= 1; ++dz)
                for (int dy = -1; dy <= 1; ++dy)
                    for (int dx = -1; dx <= 1; ++dx)
                        isInside &= isIn(box, std::int64_t{pos.x} + dx, std::int64_t{pos.y} + dy, pos.z + dz);
            ASSERT_EQ(contains({ShapeKind::Hollow}, box, pos), !isInside);
        });
}

// As hollow, but each layer for itself: floor and ceiling have only their rims.
TEST(FillShape, WallsHaveNoFloorAndNoCeiling) {
    for (const BlockBox& box : boxes(9))
        forEachBlock(box, [&](BlockPos pos) {
            const BlockBox layer{{box.low.x, box.low.y, pos.z}, {box.high.x, box.high.y, pos.z}};
            bool isInside = true;
            for (int dy = -1; dy <= 1; ++dy)
                for (int dx = -1; dx <= 1; ++dx)
                    isInside &= isIn(layer, std::int64_t{pos.x} + dx, std::int64_t{pos.y} + dy, pos.z);
            ASSERT_EQ(contains({ShapeKind::Walls}, box, pos), !isInside);
        });
}

TEST(FillShape, ASphereIsWhatIsNear) {
    for (const BlockBox& box : boxes(14))
        forEachBlock(box, [&](BlockPos pos) {
            const auto part = [](std::int64_t at, std::int64_t low, std::int64_t high) {
                const long double size = static_cast<long double>(high - low + 1);
                return (static_cast<long double>(at - low) + 0.5L - size / 2) / (size / 2);
            };
            const long double x = part(pos.x, box.low.x, box.high.x), y = part(pos.y, box.low.y, box.high.y),
                              z = part(pos.z, box.low.z, box.high.z);
            ASSERT_EQ(contains({ShapeKind::Sphere}, box, pos), x * x + y * y + z * z <= 1 + 1e-12L);
        });
    const BlockBox cube{{-5, -5, 10}, {5, 5, 20}};
    for (const BlockPos pos : blocksOf({ShapeKind::Sphere}, cube))
        EXPECT_LE(std::hypot(pos.x, pos.y, pos.z - 15), 5.5);
    EXPECT_EQ(blocksOf({ShapeKind::Sphere}, {{1, 1, 1}, {1, 1, 1}}).size(), 1u);
}

// The largest boxes of a fill, at both ends.
TEST(FillShape, LargeSpheresAreRoundToo) {
    for (const std::int32_t x : {kFirst, kLast - 499'999}) {
        const BlockBox row{{x, kLast, 0}, {x + 499'999, kLast, 0}};
        EXPECT_TRUE(contains({ShapeKind::Sphere}, row, row.low));
        EXPECT_TRUE(contains({ShapeKind::Sphere}, row, row.high));
        const BlockBox plate{{x, kLast - 706, 0}, {x + 706, kLast, 0}};
        EXPECT_FALSE(contains({ShapeKind::Sphere}, plate, plate.low));
        EXPECT_FALSE(contains({ShapeKind::Sphere}, plate, plate.high));
        EXPECT_TRUE(contains({ShapeKind::Sphere}, plate, {x + 353, kLast - 706, 0}));
    }
}

std::int64_t apart(BlockPos a, BlockPos b) {
    return std::max({std::abs(std::int64_t{a.x} - b.x), std::abs(std::int64_t{a.y} - b.y),
                     std::abs(std::int64_t{a.z} - b.z)});
}

// One block per step of the longest axis, each beside the last, none farther than half a block from the
// exact line along any axis; the same from either corner.
TEST(FillShape, ALineGoesFromCornerToCornerWithoutGaps) {
    for (const BlockBox& box : boxes(12))
        for (int corner = 0; corner < 8; ++corner) {
            const auto pick = [&](int bit, std::int32_t low, std::int32_t high) {
                return (corner & bit) != 0 ? high : low;
            };
            const BlockPos from{pick(1, box.low.x, box.high.x), pick(2, box.low.y, box.high.y),
                                pick(4, box.low.z, box.high.z)};
            const BlockPos to{pick(1, box.high.x, box.low.x), pick(2, box.high.y, box.low.y),
                              pick(4, box.high.z, box.low.z)};
            std::vector<BlockPos> line = blocksOf(lineBetween(from, to), box);
            ASSERT_EQ(std::ssize(line), apart(from, to) + 1);
            ASSERT_EQ(line, blocksOf(lineBetween(to, from), box));
            std::ranges::sort(line, {}, [&](BlockPos pos) { return apart(from, pos); });
            EXPECT_EQ(line.front(), from);
            EXPECT_EQ(line.back(), to);
            for (std::size_t k = 1; k < line.size(); ++k) {
                ASSERT_EQ(apart(line[k - 1], line[k]), 1);
                const double share = static_cast<double>(k) / static_cast<double>(line.size() - 1);
                const auto off = [&](std::int32_t at, std::int32_t a, std::int32_t b) {
                    return std::abs(static_cast<double>(std::int64_t{at} - a) -
                                    share * static_cast<double>(std::int64_t{b} - a));
                };
                ASSERT_LE(off(line[k].x, from.x, to.x), 0.5 + 1e-9);
                ASSERT_LE(off(line[k].y, from.y, to.y), 0.5 + 1e-9);
                ASSERT_LE(off(line[k].z, from.z, to.z), 0.5 + 1e-9);
            }
        }
}

}  // namespace
}  // namespace terrane::game

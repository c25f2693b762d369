#include "terrane/light/light_field.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

namespace terrane::light {
namespace {

using Rows = std::set<std::pair<int, int>>;  // brick, row

Rows takeAll(LightField& field) {
    Rows rows;
    for (int index = field.popDirty(); index != 0; index = field.popDirty()) {
        for (int row = 0; row < kRowsPerBrick; ++row) {
            if (field.brick(index).dirty[static_cast<std::size_t>(row / 64)] >> (row % 64) & 1)
                rows.emplace(index, row);
        }
    }
    return rows;
}

// Brick 7 of the middle chunk and the six beside it. The middle one is added between them.
struct Cross {
    explicit Cross(int number = 7) {
        west = field.add(3, number);
        south = field.add(1, number);
        above = field.add(kCenterChunk, number + 1);
        center = field.add(kCenterChunk, number);
        east = field.add(5, number);
        north = field.add(7, number);
        below = field.add(kCenterChunk, number - 1);
    }
    LightField field;
    int west, south, above, center, east, north, below;
};

TEST(LightField, BricksLieBesideEachOther) {
    for (const int number : {7, 0, -100, world::kLowestSection + 1}) {
        Cross cross(number);
        const auto beside = [&](int index) { return cross.field.brick(index).beside; };
        EXPECT_EQ(beside(cross.center),
                  (std::array{cross.west, cross.east, cross.south, cross.north, cross.below, cross.above}));
        EXPECT_EQ(beside(cross.west)[kEast], cross.center);
        EXPECT_EQ(beside(cross.north)[kSouth], cross.center);
        EXPECT_EQ(beside(cross.below)[kAbove], cross.center);
        EXPECT_EQ(beside(cross.west)[kWest], 0);
        EXPECT_EQ(beside(cross.west)[kNorth], 0) << "chunk 6 is not in the field";
        EXPECT_EQ(cross.field.find(kCenterChunk, number), cross.center);
        EXPECT_EQ(cross.field.find(kCenterChunk, number + 2), 0);
    }
}

TEST(LightField, EndsAtTheHeightsThatWorldsCanHave) {
    LightField field;
    const int low = field.add(kCenterChunk, world::kLowestSection);
    const int high = field.add(kCenterChunk, world::kLowestSection + world::kMostSections - 1);
    EXPECT_EQ(field.brick(low).beside[kBelow], 0);
    EXPECT_EQ(field.brick(high).beside[kAbove], 0);
}

TEST(LightField, IsEmptyAfterReset) {
    LightField field;
    field.markAll(field.add(2, -5));
    field.reset();
    EXPECT_EQ(field.find(2, -5), 0);
    EXPECT_EQ(field.brickCount(), 1);
    EXPECT_EQ(field.popDirty(), 0);
    const int above = field.add(2, -4);
    EXPECT_EQ(field.brick(above).beside[kBelow], 0);
    EXPECT_TRUE(takeAll(field).empty());
}

TEST(LightField, MarksTheRowsOfAVoxelAndItsNeighbors) {
    Cross cross;
    cross.field.markAround(cross.center, 5 + 16 * 6 + 256 * 7);
    const int row = 6 + 16 * 7, center = cross.center;
    EXPECT_EQ(
        takeAll(cross.field),
        (Rows{{center, row}, {center, row - 1}, {center, row + 1}, {center, row - 16}, {center, row + 16}}));
}

TEST(LightField, MarksAcrossBricks) {
    Cross low;
    low.field.markAround(low.center, 0);  // the lowest corner
    EXPECT_EQ(takeAll(low.field), (Rows{{low.center, 0},
                                        {low.center, 1},
                                        {low.center, 16},
                                        {low.west, 0},
                                        {low.south, 15},
                                        {low.below, 240}}));
    Cross high;
    high.field.markAround(high.center, 4095);  // the highest
    EXPECT_EQ(takeAll(high.field), (Rows{{high.center, 255},
                                         {high.center, 254},
                                         {high.center, 239},
                                         {high.east, 255},
                                         {high.north, 240},
                                         {high.above, 15}}));
}

TEST(LightField, MarksNothingOutside) {
    LightField field;
    const int index = field.add(0, 0);
    field.markAround(index, 0);
    const Rows rows = takeAll(field);
    EXPECT_FALSE(rows.empty());
    for (const auto& [brick, row] : rows) EXPECT_EQ(brick, index) << row;
    field.markAll(0);
    field.markLayer(0, 3);
    EXPECT_EQ(field.popDirty(), 0);
}

TEST(LightField, MarksLayers) {
    LightField field;
    const int index = field.add(0, 0);
    field.markLayer(index, 15);
    const Rows rows = takeAll(field);
    EXPECT_EQ(rows.size(), 16u);
    EXPECT_EQ(*rows.begin(), (std::pair{index, 240}));
    field.markAll(index);
    EXPECT_EQ(takeAll(field).size(), 256u);
}

TEST(LightField, WritesToACopyOfWhatOthersKeep) {
    LightField field;
    FieldBrick& brick = field.brick(field.add(4, 3));
    const LightValue* shared = brick.light.values;
    LightValue* own = field.writable(brick);
    EXPECT_NE(own, shared);
    own[9] = 5;
    EXPECT_EQ(shared[9], kDark);
    EXPECT_EQ(brick.light.values[9], 5);
    EXPECT_EQ(field.writable(brick), own);
}

}  // namespace
}  // namespace terrane::light

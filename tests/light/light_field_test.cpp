#include "terrane/light/light_field.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

namespace terrane::light {
namespace {

using Rows = std::set<std::pair<int, int>>;  // brick, row

Rows takeAll(LightField& field) {
    Rows rows;
    for (int index = field.popDirty(); index >= 0; index = field.popDirty()) {
        for (int row = 0; row < kRowsPerBrick; ++row) {
            if (field.brick(index).dirty[static_cast<std::size_t>(row / 64)] >> (row % 64) & 1)
                rows.emplace(index, row);
        }
    }
    return rows;
}

void putInside(LightField& field) {
    for (int chunk = 0; chunk < kFieldChunks; ++chunk) {
        for (int brick = 0; brick < world::kSectionsPerChunk; ++brick)
            field.brick(chunk, brick).isInside = true;
    }
}

TEST(LightField, NeighborsLieOneStepAway) {
    const int center = LightField::indexOf(kCenterChunk, 7);
    EXPECT_EQ(center - LightField::kStepX, LightField::indexOf(3, 7));
    EXPECT_EQ(center + LightField::kStepX, LightField::indexOf(5, 7));
    EXPECT_EQ(center - LightField::kStepY, LightField::indexOf(1, 7));
    EXPECT_EQ(center + LightField::kStepY, LightField::indexOf(7, 7));
    EXPECT_EQ(center + LightField::kStepZ, LightField::indexOf(kCenterChunk, 8));
}

TEST(LightField, MarksTheRowsOfAVoxelAndItsNeighbors) {
    LightField field;
    putInside(field);
    const int index = LightField::indexOf(kCenterChunk, 7);
    field.markAround(index, 5 + 16 * 6 + 256 * 7);
    const int row = 6 + 16 * 7;
    EXPECT_EQ(takeAll(field),
              (Rows{{index, row}, {index, row - 1}, {index, row + 1}, {index, row - 16}, {index, row + 16}}));
}

TEST(LightField, MarksAcrossBricks) {
    LightField field;
    putInside(field);
    const int index = LightField::indexOf(kCenterChunk, 7);
    field.markAround(index, 0);  // the lowest corner
    EXPECT_EQ(takeAll(field), (Rows{{index, 0},
                                    {index, 1},
                                    {index, 16},
                                    {index - LightField::kStepX, 0},
                                    {index - LightField::kStepY, 15},
                                    {index - LightField::kStepZ, 240}}));
    field.reset();
    putInside(field);
    field.markAround(index, 4095);  // the highest
    EXPECT_EQ(takeAll(field), (Rows{{index, 255},
                                    {index, 254},
                                    {index, 239},
                                    {index + LightField::kStepX, 255},
                                    {index + LightField::kStepY, 240},
                                    {index + LightField::kStepZ, 15}}));
}

TEST(LightField, MarksNothingOutside) {
    LightField field;
    field.brick(0, 0).isInside = true;
    field.markAround(LightField::indexOf(0, 0), 0);
    const Rows rows = takeAll(field);
    EXPECT_FALSE(rows.empty());
    for (const auto& [index, row] : rows) EXPECT_EQ(index, LightField::indexOf(0, 0)) << row;
    field.markAll(LightField::indexOf(1, 0));
    field.markLayer(LightField::indexOf(1, 0), 3);
    EXPECT_EQ(field.popDirty(), -1);
}

TEST(LightField, MarksLayers) {
    LightField field;
    putInside(field);
    const int index = LightField::indexOf(0, 0);
    field.markLayer(index, 15);
    const Rows rows = takeAll(field);
    EXPECT_EQ(rows.size(), 16u);
    EXPECT_EQ(*rows.begin(), (std::pair{index, 240}));
    field.markAll(index);
    EXPECT_EQ(takeAll(field).size(), 256u);
}

TEST(LightField, WritesToACopyOfWhatOthersKeep) {
    LightField field;
    FieldBrick& brick = field.brick(4, 3);
    brick.isInside = true;
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

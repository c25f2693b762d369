#include "terrane/mesh/greedy_merge.h"

#include <gtest/gtest.h>

#include "terrane/shared/hash.h"

namespace terrane::mesh {
namespace {

BitSlice randomSlice(unsigned seed, unsigned density) {
    BitSlice rows{};
    for (unsigned row = 0; row < 16; ++row) {
        for (unsigned bit = 0; bit < 16; ++bit) {
            if (shared::hash2(row, bit, seed) % 8 < density)
                rows[row] = static_cast<std::uint16_t>(rows[row] | 1u << bit);
        }
    }
    return rows;
}

// Puts the rectangles together again; none may overlap another.
BitSlice covered(std::span<const Rectangle> rectangles) {
    BitSlice rows{};
    for (const Rectangle& r : rectangles) {
        EXPECT_LE(r.bit + r.bits, 16);
        EXPECT_LE(r.row + r.rows, 16);
        const unsigned run = ((1u << r.bits) - 1) << r.bit;
        for (std::size_t row = r.row; row < std::size_t{r.row} + r.rows; ++row) {
            EXPECT_EQ(rows[row] & run, 0u) << "covered twice";
            rows[row] = static_cast<std::uint16_t>(rows[row] | run);
        }
    }
    return rows;
}

TEST(GreedyMerge, CoversEachBitOnce) {
    RectangleBuffer buffer;
    for (unsigned seed = 0; seed < 200; ++seed) {
        const BitSlice rows = randomSlice(seed, 1 + seed % 8);
        for (const Merge merge : {Merge::None, Merge::Full}) {
            EXPECT_EQ(covered(mergeRows(rows, merge, buffer)), rows);
        }
    }
}

TEST(GreedyMerge, FullPlaneIsOneRectangle) {
    RectangleBuffer buffer;
    const auto full = mergeRows(filledSlice(), Merge::Full, buffer);
    ASSERT_EQ(full.size(), 1u);
    EXPECT_EQ(full[0].bits, 16);
    EXPECT_EQ(full[0].rows, 16);
    EXPECT_EQ(mergeRows(filledSlice(), Merge::None, buffer).size(), 256u);
}

TEST(GreedyMerge, GrowsAlongTheRowFirst) {
    BitSlice rows{};
    rows[2] = 0b0111;
    rows[3] = 0b1111;
    RectangleBuffer buffer;
    const auto found = mergeRows(rows, Merge::Full, buffer);
    ASSERT_EQ(found.size(), 2u);
    EXPECT_EQ(found[0].row, 2);
    EXPECT_EQ(found[0].bits, 3);
    EXPECT_EQ(found[0].rows, 2);
    EXPECT_EQ(found[1].row, 3);
    EXPECT_EQ(found[1].bit, 3);
}

TEST(GreedyMerge, CheckerboardCannotMerge) {
    BitSlice rows;
    for (std::size_t row = 0; row < rows.size(); ++row) rows[row] = row % 2 == 0 ? 0x5555 : 0xAAAA;
    RectangleBuffer buffer;
    EXPECT_EQ(mergeRows(rows, Merge::Full, buffer).size(), 128u);
}

}  // namespace
}  // namespace terrane::mesh

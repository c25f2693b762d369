#include "terrane/mesh/face_writer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "terrane/mesh/bit_cube.h"
#include "terrane/shared/hash.h"

namespace terrane::mesh {
namespace {

constexpr MergeMethod kMergeMethods[] = {MergeMethod::None, MergeMethod::Lines, MergeMethod::Squares,
                                         MergeMethod::SquaresExt, MergeMethod::Greedy};

struct Rectangle {
    unsigned bit, row, bits, rows;
    bool operator==(const Rectangle&) const = default;
};

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

// Random, but in lumps: there is more to merge.
BitSlice lumpySlice(unsigned seed) {
    BitSlice rows{};
    for (unsigned lump = 0; lump < 6; ++lump) {
        const unsigned hash = shared::hash2(lump, 0, seed);
        const unsigned bit = hash % 16, row = hash / 16 % 16, bits = 1 + hash / 256 % 9,
                       height = 1 + hash / 4096 % 9;
        const unsigned run = (((1u << bits) - 1) << bit) & 0xFFFFu;
        for (unsigned r = row; r < std::min(16u, row + height); ++r)
            rows[r] = static_cast<std::uint16_t>(rows[r] | run);
    }
    return rows;
}

BitSlice sliceOf(std::initializer_list<std::uint16_t> lowest) {
    BitSlice rows{};
    std::copy(lowest.begin(), lowest.end(), rows.begin());
    return rows;
}

// Rows whose bit in `among` is clear are passed over. Quads have x for the bit and y for the row.
std::vector<Rectangle> mergedIn(MergeMethod method, std::uint16_t* rows, std::size_t step,
                                unsigned among = 0xFFFF) {
    std::uint32_t used = 0;
    for (unsigned row = 0; row < 16; ++row) used |= unsigned{rows[row * step] != 0} << row;
    std::array<shared::Quad, kMaxQuadsPerPlane> quads;
    const std::size_t count =
        mergeFunction(method)({rows, step, used & among}, {{7u << 8, 5}, 0, 4}, quads.data());
    std::vector<Rectangle> found;
    for (std::size_t k = 0; k < count; ++k) {
        const shared::Quad q = quads[k];
        EXPECT_EQ(quadZ(q), 7u);
        EXPECT_EQ(quadMaterial(q), 5u);
        found.push_back({quadX(q), quadY(q), quadExtentU(q), quadExtentV(q)});
    }
    return found;
}

std::vector<Rectangle> merged(MergeMethod method, BitSlice rows) {
    return mergedIn(method, rows.data(), 1);
}

// Puts the rectangles together again; none may overlap another.
BitSlice covered(const std::vector<Rectangle>& rectangles) {
    BitSlice rows{};
    for (const Rectangle& r : rectangles) {
        EXPECT_LE(r.bit + r.bits, 16u);
        EXPECT_LE(r.row + r.rows, 16u);
        const unsigned run = ((1u << r.bits) - 1) << r.bit;
        for (std::size_t row = r.row; row < r.row + r.rows; ++row) {
            EXPECT_EQ(rows[row] & run, 0u) << "covered twice";
            rows[row] = static_cast<std::uint16_t>(rows[row] | run);
        }
    }
    return rows;
}

template <class F>
void forManySlices(F f) {
    for (unsigned seed = 0; seed < 200; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        f(randomSlice(seed, 1 + seed % 8));
        f(lumpySlice(seed));
    }
}

TEST(Merge, EveryMethodCoversEachBitOnce) {
    forManySlices([](const BitSlice& rows) {
        for (const MergeMethod method : kMergeMethods) EXPECT_EQ(covered(merged(method, rows)), rows);
    });
}

// Rows of 16 planes side by side, and only some of them.
TEST(Merge, PlanesLieInLargerArrays) {
    for (const MergeMethod method : kMergeMethods) {
        const BitSlice rows = lumpySlice(3);
        std::array<std::uint16_t, 256> stack;
        stack.fill(0xFFFF);
        for (std::size_t row = 0; row < 16; ++row) stack[16 * row + 5] = rows[row];
        BitSlice part = rows;
        for (const std::size_t outside : {0, 1, 12, 13, 14, 15}) part[outside] = 0;
        EXPECT_EQ(mergedIn(method, &stack[5], 16, 0x0FFC), merged(method, part));
    }
}

TEST(Merge, RectanglesAreOrderedByRowThenBit) {
    const auto before = [](const Rectangle& a, const Rectangle& b) {
        return a.row != b.row ? a.row < b.row : a.bit < b.bit;
    };
    forManySlices([&](const BitSlice& rows) {
        for (const MergeMethod method : kMergeMethods) {
            const std::vector<Rectangle> found = merged(method, rows);
            EXPECT_TRUE(std::is_sorted(found.begin(), found.end(), before));
        }
    });
}

TEST(Merge, TheThesissMethodsStayInCellsOf8) {
    forManySlices([](const BitSlice& rows) {
        for (const MergeMethod method : {MergeMethod::Lines, MergeMethod::Squares, MergeMethod::SquaresExt}) {
            for (const Rectangle& r : merged(method, rows)) {
                EXPECT_EQ(r.bit / 8, (r.bit + r.bits - 1) / 8);
                EXPECT_EQ(r.row / 8, (r.row + r.rows - 1) / 8);
            }
        }
    });
}

TEST(Merge, AFullPlaneReachesTheLimit) {
    for (const MergeMethod method : kMergeMethods) {
        const std::vector<Rectangle> found = merged(method, filledSlice());
        const unsigned extent = method == MergeMethod::None ? 1 : method == MergeMethod::Greedy ? 16 : 8;
        EXPECT_EQ(found.size(), 256 / (extent * extent));
        for (const Rectangle& r : found) {
            EXPECT_EQ(r.bits, extent);
            EXPECT_EQ(r.rows, extent);
        }
    }
}

TEST(Merge, ACheckerboardCannotMerge) {
    BitSlice rows;
    for (std::size_t row = 0; row < rows.size(); ++row) rows[row] = row % 2 == 0 ? 0x5555 : 0xAAAA;
    for (const MergeMethod method : kMergeMethods) EXPECT_EQ(merged(method, rows).size(), 128u);
}

TEST(Merge, NoneHasARectangleForEachBit) {
    forManySlices([](const BitSlice& rows) {
        for (const Rectangle& r : merged(MergeMethod::None, rows)) EXPECT_EQ(r.bits * r.rows, 1u);
    });
}

using Rectangles = std::vector<Rectangle>;

// The difference between lines and greedy: a shorter run over a longer one.
TEST(Merge, LinesJoinsEqualLengthsOnlyGreedyWhatFits) {
    const BitSlice rows = sliceOf({0b0111, 0b0111, 0b1111});
    EXPECT_EQ(merged(MergeMethod::Lines, rows), (Rectangles{{0, 0, 3, 2}, {0, 2, 4, 1}}));
    EXPECT_EQ(merged(MergeMethod::Greedy, rows), (Rectangles{{0, 0, 3, 3}, {3, 2, 1, 1}}));
}

TEST(Merge, GreedyCrossesTheCells) {
    EXPECT_EQ(merged(MergeMethod::Greedy, sliceOf({0x0FF0, 0x0FF0})), (Rectangles{{4, 0, 8, 2}}));
    EXPECT_EQ(merged(MergeMethod::Lines, sliceOf({0x0FF0, 0x0FF0})),
              (Rectangles{{4, 0, 4, 2}, {8, 0, 4, 2}}));
}

// Halves of a cell where the first is full.
TEST(Merge, SquaresGrowOnTheGrid) {
    EXPECT_EQ(merged(MergeMethod::Squares, sliceOf({0b1111, 0b1111})), (Rectangles{{0, 0, 4, 2}}));
    EXPECT_EQ(merged(MergeMethod::Squares, sliceOf({0b1110, 0b1110})),
              (Rectangles{{1, 0, 1, 2}, {2, 0, 2, 2}}));
    EXPECT_EQ(merged(MergeMethod::SquaresExt, sliceOf({0b1110, 0b1110})), (Rectangles{{1, 0, 3, 2}}));
    EXPECT_EQ(merged(MergeMethod::Squares, sliceOf({0b0111})), (Rectangles{{0, 0, 3, 1}}));
    EXPECT_EQ(merged(MergeMethod::Squares, sliceOf({0, 0b11, 0b11})),
              (Rectangles{{0, 1, 2, 1}, {0, 2, 2, 1}}));
}

// Squares as the thesis says it: in a grid of cells of 2, 4 and 8 the rectangle that is the whole lower half
// of a cell takes the one behind it that is as wide, first along the rows, then across them.
void joinHalves(Rectangles& all, unsigned half, unsigned Rectangle::*at, unsigned Rectangle::*length,
                unsigned Rectangle::*beside, unsigned Rectangle::*width) {
    for (std::size_t k = 0; k < all.size(); ++k) {
        if (all[k].*at % (2 * half) != 0 || all[k].*length != half) continue;
        for (std::size_t n = 0; n < all.size(); ++n) {
            const Rectangle &a = all[k], b = all[n];
            if (b.*at != a.*at + half || b.*beside != a.*beside || b.*width != a.*width) continue;
            all[k].*length += b.*length;
            all.erase(all.begin() + static_cast<std::ptrdiff_t>(n));
            k -= n < k;
            break;
        }
    }
}

TEST(Merge, SquaresAreThoseOfASlowReference) {
    forManySlices([](const BitSlice& rows) {
        Rectangles all = merged(MergeMethod::None, rows);
        for (const unsigned half : {1u, 2u, 4u}) {
            joinHalves(all, half, &Rectangle::bit, &Rectangle::bits, &Rectangle::row, &Rectangle::rows);
            joinHalves(all, half, &Rectangle::row, &Rectangle::rows, &Rectangle::bit, &Rectangle::bits);
        }
        EXPECT_EQ(merged(MergeMethod::Squares, rows), all);
    });
}

TEST(Merge, SquaresExtJoinsMoreThanSquares) {
    unsigned fewer = 0;
    forManySlices([&](const BitSlice& rows) {
        const std::size_t squares = merged(MergeMethod::Squares, rows).size();
        const std::size_t ext = merged(MergeMethod::SquaresExt, rows).size();
        EXPECT_LE(ext, squares);
        fewer += ext < squares;
    });
    EXPECT_GT(fewer, 20u);
}

// Nothing is left that the rule of the last step would still join.
TEST(Merge, SquaresExtLeavesNoEqualNeighborAcrossRows) {
    forManySlices([](const BitSlice& rows) {
        const Rectangles found = merged(MergeMethod::SquaresExt, rows);
        for (const Rectangle& a : found) {
            for (const Rectangle& b : found) {
                const bool touches = b.row == a.row + a.rows && b.row % 8 != 0 && a.bit == b.bit;
                EXPECT_FALSE(touches && a.bits == b.bits);
            }
        }
    });
}

}  // namespace
}  // namespace terrane::mesh

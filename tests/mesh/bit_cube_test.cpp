#include "terrane/mesh/bit_cube.h"

#include <gtest/gtest.h>

#include "terrane/shared/hash.h"

namespace terrane::mesh {
namespace {

BitCube randomCube(unsigned seed) {
    BitCube cube;
    for (unsigned i = 0; i < cube.size(); ++i) {
        cube[i] = std::uint64_t{shared::hash2(i, 0, seed)} << 32 | shared::hash2(i, 1, seed);
    }
    return cube;
}

bool bitAt(const BitCube& cube, int layer, int row, int bit) {
    return cube[static_cast<std::size_t>(4 * layer + row / 4)] >> (16 * (row % 4) + bit) & 1;
}

template <class F>
void forAllBlocks(F f) {
    for (int z = 0; z < 16; ++z) {
        for (int row = 0; row < 16; ++row) {
            for (int bit = 0; bit < 16; ++bit) f(z, row, bit);
        }
    }
}

TEST(BitCube, TransposedExchangesRowsAndBits) {
    const BitCube cube = randomCube(1), other = transposed(cube);
    forAllBlocks(
        [&](int z, int row, int bit) { EXPECT_EQ(bitAt(cube, z, row, bit), bitAt(other, z, bit, row)); });
    EXPECT_EQ(transposed(other), cube);
}

TEST(BitCube, NeighborBitsLookOneBlockToTheSide) {
    const BitCube cube = randomCube(2);
    BitSlice border;
    for (unsigned i = 0; i < 16; ++i) border[i] = static_cast<std::uint16_t>(shared::hash2(i, 7, 3));
    for (int s = 0; s < world::kFaceCount; ++s) {
        const auto side = static_cast<world::Face>(s);
        const BitCube next = neighborBits(cube, side, border);
        const int step = s % 2 == 0 ? -1 : 1;
        forAllBlocks([&](int z, int row, int bit) {
            // Rows are the axis across for x and y, layers for z.
            const int across = isAlongZ(side) ? z + step : row + step;
            const auto line = static_cast<std::size_t>(isAlongZ(side) ? row : z);
            const bool expected = across < 0 || across > 15 ? ((border[line] >> bit) & 1) != 0
                                  : isAlongZ(side)          ? bitAt(cube, across, row, bit)
                                                            : bitAt(cube, z, across, bit);
            EXPECT_EQ(bitAt(next, z, row, bit), expected);
        });
    }
}

TEST(BitCube, SetOperations) {
    const BitCube a = randomCube(3), b = randomCube(4);
    const BitCube common = both(a, b, {}), onlyA = without(a, b, {});
    for (std::size_t i = 0; i < a.size(); ++i) {
        EXPECT_EQ(common[i] | onlyA[i], a[i]);
        EXPECT_EQ(common[i] & onlyA[i], 0u);
        EXPECT_EQ(onlyA[i] & b[i], 0u);
    }
}

// In the layers of the range the result is that of the whole cube.
TEST(BitCube, RangesAreParts) {
    const BitCube cube = randomCube(5);
    const BitSlice border = filledSlice();
    for (const LayerRange range : {LayerRange{0, 16}, {0, 1}, {15, 16}, {3, 9}, {8, 16}}) {
        for (int s = 0; s < world::kFaceCount; ++s) {
            const auto side = static_cast<world::Face>(s);
            const BitCube whole = neighborBits(cube, side, border);
            const BitCube part = neighborBits(cube, side, border, range);
            const BitCube turned = transposed(cube, range);
            for (std::size_t i = 4 * range.first; i < 4 * range.end; ++i) {
                EXPECT_EQ(part[i], whole[i]);
                EXPECT_EQ(turned[i], transposed(cube)[i]);
            }
        }
    }
}

TEST(BitCube, CommonLayersAreTight) {
    BitCube a{}, b{};
    b.fill(~std::uint64_t{0});
    EXPECT_TRUE(commonLayers(a, b, {}).isEmpty());
    a[4 * 5] = 1;
    a[4 * 9 + 3] = 1;
    const auto expectRange = [&](LayerRange found, std::size_t first, std::size_t end) {
        EXPECT_EQ(found.first, first);
        EXPECT_EQ(found.end, end);
    };
    expectRange(commonLayers(a, b, {}), 5, 10);
    expectRange(commonLayers(a, b, {6, 16}), 9, 10);
    expectRange(commonLayers(a, b, {0, 9}), 5, 6);
    b[4 * 5] = 2;
    expectRange(commonLayers(a, b, {}), 9, 10);
}

}  // namespace
}  // namespace terrane::mesh

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
    return (cubeRow(cube, static_cast<std::size_t>(layer), static_cast<std::size_t>(row)) >> bit) & 1;
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

TEST(BitCube, NeighbourBitsLookOneBlockToTheSide) {
    const BitCube cube = randomCube(2);
    BitSlice border;
    for (unsigned i = 0; i < 16; ++i) border[i] = static_cast<std::uint16_t>(shared::hash2(i, 7, 3));
    for (int s = 0; s < world::kFaceCount; ++s) {
        const auto side = static_cast<world::Face>(s);
        const BitCube next = neighbourBits(cube, side, border);
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
    EXPECT_TRUE(isEmpty(without(both(a, b), b)));
    EXPECT_FALSE(isEmpty(a));
    EXPECT_TRUE(isEmpty(BitCube{}));
}

}  // namespace
}  // namespace terrane::mesh

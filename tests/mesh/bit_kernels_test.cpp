// Every instruction set of the machine against loops over single bits.
#include "terrane/mesh/bit_kernels.h"

#include <gtest/gtest.h>

#include <vector>

#include "terrane/gen/cpu/kernels.h"
#include "terrane/shared/hash.h"

namespace terrane::mesh {
namespace {

template <class F>
void onEveryTarget(F f) {
    for (const std::string& target : gen::simdTargets()) {
        SCOPED_TRACE(target);
        ASSERT_TRUE(gen::chooseSimdTarget(target));
        f();
    }
    gen::chooseSimdTarget("");
}

std::uint64_t randomWord(std::size_t at) {
    const auto i = static_cast<unsigned>(at);
    return std::uint64_t{shared::hash2(i, 0, 1)} << 32 | shared::hash2(i, 1, 1);
}

TEST(BitKernels, PlanesHoldTheBitsOfIndices) {
    onEveryTarget([] {
        for (const std::size_t bits : {0u, 1u, 2u, 4u, 8u, 16u}) {
            for (const std::size_t groups : {4u, 64u}) {
                std::vector<std::uint64_t> packed(bits * groups), planes(bits * groups), found(groups);
                for (std::size_t i = 0; i < packed.size(); ++i) packed[i] = randomWord(i);
                sortIntoPlanes(packed.data(), bits, groups, planes.data());
                const auto indexOf = [&](std::size_t block) {
                    return bits == 0 ? 0
                                     : packed[block * bits / 64] >> block * bits % 64 & ((1u << bits) - 1);
                };
                for (const std::size_t index : {indexOf(0), indexOf(77), std::uint64_t{0}}) {
                    blocksOfIndex({planes.data(), bits, groups}, index, found.data());
                    for (std::size_t block = 0; block < 64 * groups; ++block) {
                        ASSERT_EQ(found[block / 64] >> block % 64 & 1, indexOf(block) == index ? 1u : 0u)
                            << bits << " bits, " << groups << " groups, block " << block;
                    }
                }
            }
        }
    });
}

TEST(BitKernels, UsedRowsOfTheRangeOnly) {
    onEveryTarget([] {
        BitCube cube{};
        for (std::size_t i = 0; i < 64; ++i)
            cube[i] = randomWord(i) & randomWord(i + 64) & randomWord(i + 128) & randomWord(i + 192) &
                      randomWord(i + 256);
        BitSlice used;
        used.fill(0xABCD);
        usedRows(cube, {3, 14}, used);
        for (std::size_t layer = 0; layer < 16; ++layer) {
            for (std::size_t row = 0; row < 16; ++row) {
                const bool isInside = layer >= 3 && layer < 14;
                const auto bits = static_cast<std::uint16_t>(cube[4 * layer + row / 4] >> 16 * (row % 4));
                const unsigned expected = isInside ? bits != 0 : 0xABCDu >> row & 1;
                EXPECT_EQ(used[layer] >> row & 1, static_cast<int>(expected));
            }
        }
    });
}

}  // namespace
}  // namespace terrane::mesh

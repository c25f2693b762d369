#include "terrane/mesh/section_faces.h"

#include <gtest/gtest.h>

#include <array>

#include "terrane/shared/hash.h"
#include "tests/mesh/test_blocks.h"

namespace terrane::mesh {
namespace {

using world::Section;

// One count of distinct values for each form: uniform, 1, 2, 4, 8 and 16 bits.
constexpr unsigned kDistinct[] = {1, 2, 3, 4, 9, 16, 17, 200, 256, 257, 3000};

Section randomSection(unsigned distinct, unsigned seed) {
    std::array<Section::Value, world::kBlocksPerSection> values;
    for (unsigned i = 0; i < values.size(); ++i) {
        values[i] = static_cast<Section::Value>(shared::hash2(i, 0, seed) % distinct);
    }
    return Section::fromValues(values);
}

TEST(SectionBits, BlocksOfEachIdInEveryForm) {
    for (const unsigned distinct : kDistinct) {
        SCOPED_TRACE(distinct);
        const Section section = randomSection(distinct, distinct);
        const SectionBits bits(section);
        std::size_t found = 0;
        for (std::size_t n = 0; n < bits.ids().size(); ++n) {
            const BitCube blocks = bits.blocks(n);
            for (int i = 0; i < world::kBlocksPerSection; ++i) {
                const auto at = static_cast<std::size_t>(i);
                if (((blocks[at / 64] >> at % 64) & 1) == 0) continue;
                ASSERT_EQ(section.get(i), bits.ids()[n]) << "block " << i;
                ++found;
            }
        }
        EXPECT_EQ(found, 4096u) << "each block is of one id";
    }
}

// The block in the layer of a side, by the order of rows that bit_cube.h states.
int indexOnSide(world::Face side, int row, int bit) {
    const int depth = side % 2 == 0 ? 0 : 15;
    switch (side / 2) {
        case 0:
            return depth + 16 * bit + 256 * row;
        case 1:
            return bit + 16 * depth + 256 * row;
        default:
            return bit + 16 * row + 256 * depth;
    }
}

TEST(SectionSide, LayersInEveryForm) {
    for (const unsigned distinct : kDistinct) {
        SCOPED_TRACE(distinct);
        const Section section = randomSection(distinct, distinct + 1);
        for (int s = 0; s < world::kFaceCount; ++s) {
            const auto side = static_cast<world::Face>(s);
            const SectionSide layer(section, side);
            const BitSlice opaque = layer.opaqueCubes(testBlocks());
            const BitSlice ones = layer.blocks(1);
            for (int row = 0; row < 16; ++row) {
                for (int bit = 0; bit < 16; ++bit) {
                    const world::BlockId id = section.get(indexOnSide(side, row, bit));
                    const auto r = static_cast<std::size_t>(row);
                    ASSERT_EQ((opaque[r] >> bit) & 1, testBlocks().type(id).opaqueCube ? 1 : 0);
                    ASSERT_EQ((ones[r] >> bit) & 1, id == 1 ? 1 : 0);
                }
            }
        }
    }
}

TEST(SectionSide, AllOpaque) {
    EXPECT_TRUE(isAllOpaque(Section(idOf("stone")), testBlocks()));
    EXPECT_FALSE(isAllOpaque(Section(idOf("water")), testBlocks()));
    Section mixed(idOf("stone"));
    mixed.set(7, idOf("ore"));
    EXPECT_TRUE(isAllOpaque(mixed, testBlocks()));
    mixed.set(8, world::kAir);
    EXPECT_FALSE(isAllOpaque(mixed, testBlocks()));
}

}  // namespace
}  // namespace terrane::mesh

#include "terrane/world/section.h"

#include <gtest/gtest.h>

#include "terrane/shared/hash.h"

namespace terrane::world {
namespace {

// Reads as packed_section.glsl does.
shared::uint valueAt(const PackedSections& packed, shared::uint number, shared::uint block) {
    const shared::PackedSection section = packed.sections[number];
    if (section.bits == 0) return packed.data[section.palette];
    const shared::uint word = packed.data[section.words + shared::packedWordIndex(section, block)];
    const shared::uint index = shared::packedIndex(section, word, block);
    return section.bits == shared::kDenseBits ? index : packed.data[section.palette + index];
}

TEST(PackedSections, HoldEveryFormOfSection) {
    PackedSections packed;
    std::vector<Section> sections;
    for (const unsigned values : {1u, 2u, 3u, 16u, 200u, 3000u}) {
        Section& section = sections.emplace_back(static_cast<Section::Value>(7));
        for (int k = 0; k < kBlocksPerSection && values > 1; ++k) {
            section.set(k,
                        static_cast<Section::Value>(shared::hash2(static_cast<unsigned>(k), 1, 2) % values));
        }
        const shared::uint number =
            appendSection(packed, section, [](Section::Value value) { return value | 0x50000u; });
        EXPECT_EQ(number, sections.size() - 1);
    }
    EXPECT_EQ(packed.sections.front().bits, 0u);
    EXPECT_EQ(packed.sections.back().bits, shared::kDenseBits);
    for (shared::uint n = 0; n < sections.size(); ++n) {
        const shared::uint mapped = sections[n].isDense() ? 0 : 0x50000;  // values of dense sections stay
        for (int k = 0; k < kBlocksPerSection; ++k) {
            ASSERT_EQ(valueAt(packed, n, static_cast<shared::uint>(k)), sections[n].get(k) | mapped) << n;
        }
    }
    packed.clear();
    EXPECT_TRUE(packed.sections.empty() && packed.data.empty());
}

}  // namespace
}  // namespace terrane::world

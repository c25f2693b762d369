#include "terrane/light_gpu/light_workspace_internal.h"

#include <gtest/gtest.h>

#include <numeric>
#include <set>
#include <vector>

#include "terrane/shared/light_solver.h"
#include "tests/light/test_area.h"
#include "tests/support/default_heights.h"

namespace terrane::light_gpu {
namespace {

// Reads a property as the shaders do (packed_section.glsl).
shared::uint propertyAt(const world::PackedSections& packed, std::size_t chunk, int index) {
    const auto at = static_cast<shared::uint>(index), block = at % shared::kBlocksPerSection;
    const shared::PackedSection section =
        packed.sections[chunk * world::kSectionsPerChunk + at / shared::kBlocksPerSection];
    if (section.bits == 0) return packed.data[section.palette];
    const shared::uint word = packed.data[section.words + shared::packedWordIndex(section, block)];
    const shared::uint value = shared::packedIndex(section, word, block);
    return section.bits == shared::kDenseBits ? value : packed.data[section.palette + value];
}

TEST(SectionUpload, HoldsOpacityAndEmissionOfEveryBlockInEveryForm) {
    // By sections: of one value, palettes of more and more entries, and what no palette holds.
    const world::Chunk chunk = light::TestArea::makeChunk(0, 0, [](int x, int y, int z) {
        const std::uint32_t hash = light::hashAt(x, y, z, 3);
        if (z >= 80) return static_cast<world::BlockId>(hash % (1u << (z / 16 - 4)) % 600);
        return light::anyBlock(hash % (1u << (z / 16)));
    });
    world::PackedSections upload;
    std::vector<int> numbers(world::kSectionsPerChunk);
    std::iota(numbers.begin(), numbers.end(), 0);
    appendChunk(upload, world::Chunk(), numbers, light::contentTable());
    appendChunk(upload, chunk, numbers, light::contentTable());
    std::set<int> forms;
    for (int n = 0; n < world::kSectionsPerChunk; ++n) forms.insert(chunk.section(n).bits());
    EXPECT_GE(forms.size(), 5u);
    EXPECT_TRUE(forms.contains(16));
    for (int k = 0; k < world::kBlocksPerChunk; ++k) {
        const world::BlockId id = chunk.block(static_cast<world::BlockIndex>(k));
        const shared::uint property = propertyAt(upload, 1, k);
        ASSERT_EQ(shared::emissionOf(property), light::contentTable().emission(id)) << k;
        ASSERT_EQ(light::allComponents(static_cast<int>(shared::opacityOf(property))),
                  light::contentTable().opacity(id))
            << k;
    }
    EXPECT_EQ(propertyAt(upload, 0, 4096), 0u);
    upload.clear();
    EXPECT_TRUE(upload.sections.empty() && upload.data.empty());
}

}  // namespace
}  // namespace terrane::light_gpu

#include "terrane/light_gpu/section_upload_internal.h"

#include <array>

#include "terrane/shared/light_solver.h"

namespace terrane::light_gpu {
namespace {

shared::uint propertyOf(world::BlockId id, const light::LightTable& table) {
    return static_cast<shared::uint>(table.emission(id)) << 4 |
           static_cast<shared::uint>(light::levelOf(table.opacity(id), light::kRed));
}

// Converts a dense section; 16 bits a block hold a property too.
world::Section densePropertiesOf(const world::Section& section, const light::LightTable& table) {
    constexpr int kValuesPerWord = 4;
    std::vector<std::uint64_t> words(world::kBlocksPerSection / kValuesPerWord);
    for (int k = 0; k < world::kBlocksPerSection; ++k) {
        const std::uint64_t property = propertyOf(section.get(k), table);
        words[static_cast<std::size_t>(k / kValuesPerWord)] |= property << 16 * (k % kValuesPerWord);
    }
    return *world::Section::fromPacked(static_cast<int>(shared::kDenseBits), {}, std::move(words));
}

}  // namespace

void appendChunk(world::PackedSections& packed, const world::Chunk& chunk, const light::LightTable& table) {
    const auto propertyOfId = [&](world::BlockId id) { return propertyOf(id, table); };
    for (int n = 0; n < world::kSectionsPerChunk; ++n) {
        const world::Section& section = chunk.section(n);
        if (section.isDense()) {
            appendSection(packed, densePropertiesOf(section, table), propertyOfId);
        } else {
            appendSection(packed, section, propertyOfId);
        }
    }
}

}  // namespace terrane::light_gpu

#include "terrane/light_gpu/section_upload.h"

namespace terrane::light_gpu {
namespace {

shared::uint propertyOf(world::BlockId id, const light::LightTable& table) {
    return static_cast<shared::uint>(table.emission(id)) << 4 |
           static_cast<shared::uint>(light::levelOf(table.opacity(id), light::kRed));
}

void addDense(std::vector<shared::uint>& data, const world::Section& section,
              const light::LightTable& table) {
    for (int k = 0; k < world::kBlocksPerSection; k += 2) {
        data.push_back(propertyOf(section.get(k), table) | propertyOf(section.get(k + 1), table) << 16);
    }
}

shared::SectionInput addSection(std::vector<shared::uint>& data, const world::Section& section,
                                const light::LightTable& table) {
    shared::SectionInput input{};
    input.bits = static_cast<shared::uint>(section.bits());
    input.palette = static_cast<shared::uint>(data.size());
    if (section.isUniform()) data.push_back(propertyOf(section.uniformValue(), table));
    for (const world::BlockId id : section.palette()) data.push_back(propertyOf(id, table));
    input.words = static_cast<shared::uint>(data.size());
    if (section.isDense()) {
        addDense(data, section, table);
        return input;
    }
    for (const std::uint64_t word : section.words()) {
        data.push_back(static_cast<shared::uint>(word));
        data.push_back(static_cast<shared::uint>(word >> 32));
    }
    return input;
}

}  // namespace

void SectionUpload::clear() {
    sections.clear();
    data.clear();
}

void SectionUpload::add(const world::Chunk& chunk, const light::LightTable& table) {
    for (int n = 0; n < world::kSectionsPerChunk; ++n)
        sections.push_back(addSection(data, chunk.section(n), table));
}

}  // namespace terrane::light_gpu

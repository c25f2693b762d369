// The blocks of a batch of chunks: sections in their packed form.
#include "terrane/shared/packed_section.h"

layout(std430, binding = kPackedSectionsBinding) readonly buffer PackedSections {
    PackedSection sections[];
};
layout(std430, binding = kPackedDataBinding) readonly buffer PackedData {
    uint data[];  // palettes and words
};

// `block`: index in the section. Palettes hold values converted by the host, dense sections the values themselves.
uint packedValue(PackedSection section, uint block) {
    if (section.bits == 0u) return data[section.palette];
    uint index = packedIndex(section, data[section.words + packedWordIndex(section, block)], block);
    return section.bits == kDenseBits ? index : data[section.palette + index];
}

// A section in its packed form, as shaders that light and mesh read it: made by world/section.h,
// decoded by shared/packed_section.glsl.
#ifndef TERRANE_SHARED_PACKED_SECTION_H
#define TERRANE_SHARED_PACKED_SECTION_H

#include "terrane/shared/language.h"

SHARED_BEGIN

// Storage buffers
const uint kPackedSectionsBinding = 0u;
const uint kPackedDataBinding = 1u;

const uint kDenseBits = 16u;  // of a section without a palette: its words hold values

// bits: of an index into the palette, 0 (one value, the palette's only one), 1, 2, 4, 8, or kDenseBits.
// Palette and words begin at these places of the data.
struct PackedSection {
    uint bits;
    uint palette;
    uint words;
    uint unused;
};

// Index of the word that holds a block, from the section's first word, for sections of more than one value.
// `block`: index in the section.
SHARED_FN uint packedWordIndex(PackedSection section, uint block) {
    return (block * section.bits) >> 5;
}
// Index of a block into the palette, or its value in a dense section. Widths are powers of two, so that no
// index crosses a word.
SHARED_FN uint packedIndex(PackedSection section, uint word, uint block) {
    return word >> ((block * section.bits) & 31u) & ((1u << section.bits) - 1u);
}

SHARED_END

#ifdef __cplusplus
namespace terrane::shared {
static_assert(sizeof(PackedSection) == 16);
}  // namespace terrane::shared
#endif
#endif

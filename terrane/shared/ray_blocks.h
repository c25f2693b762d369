// Which block is where, for rays in shaders: the words that render/rays/ray_store.h writes.
//
//   grid     one word for each entry of the scene's grids (ray_scene.h), in the same order: where the blocks
//            of the tile begin, or 0
//   tile     kRaySectionWords for each section, from the world's bottom: its blocks, its block states
//   section  of more than one value: indices as in packed_section.h, then the palette, one word a value
#ifndef TERRANE_SHARED_RAY_BLOCKS_H
#define TERRANE_SHARED_RAY_BLOCKS_H

#include "terrane/shared/constants.h"
#include "terrane/shared/language.h"
#include "terrane/shared/ray_scene.h"

SHARED_BEGIN

const uint kRaySectionWords = 2u;

// The word of a section: in the upper 4 bits 0, or 1 + log2 of the bits of an index (packed_section.h); below
// them the section's one value, or where its indices begin. So the words take 1 GiB at most.
const uint kRayFormShift = 28u;
const uint kMaxRayBlockWords = 1u << kRayFormShift;

SHARED_FN uint raySectionForm(uint word) {
    return word >> kRayFormShift;
}
SHARED_FN uint raySectionPlace(uint word) {
    return word & (kMaxRayBlockWords - 1u);
}
// Words of the indices of a section.
SHARED_FN uint rayIndexWords(uint bits) {
    return kBlocksPerSection / 32u * bits;
}

// The place in the grid of an entry of the scene.
SHARED_FN uint rayBlockEntry(uint entry) {
    return (entry - kRayHeaderWords) / kRayEntryWords;
}

// Block types are shared::MeshType (mesher.h): those of chunks, then as many as seen in far tiles.

SHARED_END
#endif

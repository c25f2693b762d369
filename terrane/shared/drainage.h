// Rivers and lakes near a tile, and how near a column is to them, on the CPU and the GPU with the same bits.
// gen/drainage_kernels-inl.h repeats it in SIMD, step by step; tests compare.
#ifndef TERRANE_SHARED_DRAINAGE_H
#define TERRANE_SHARED_DRAINAGE_H

#include "terrane/shared/language.h"

SHARED_BEGIN

// Storage buffers of 2D passes that read drainage maps, beside those of generation.h. With them a pass has
// eight, as many as OpenGL guarantees.
const uint kDrainageListsBinding = 6u;
const uint kDrainageDataBinding = 7u;

// A straight piece of a river. `a` is its upper end; differences lead to its lower one.
struct RiverSegment {
    vec4 line;    // a (x, y), difference (x, y): blocks, from the sample of the tile's first column
    vec4 course;  // 1 / length², half width at a, its difference, level at a
    vec4 flow;    // difference of levels, flow at a, its difference, fall of the level a block
    // Without width at both ends it is dry: part of a valley, but no river.
};

const uint kVectorsPerSegment = 3u;

// A lake is a vec4: center (x, y) from the first column's sample, radius, level.

// Distance in blocks where no river or lake is within reach.
const float kNoRiver = 65536.0f;

// Sums of weights up to this are of streams so far away that they do not count.
const float kLeastStreamWeight = 1e-20f;

// Valleys change slowly: columns narrower than this, in blocks, are blended from places that far apart. A
// power of two.
const int kValleyBlocks = 4;

// The part of a map for one tile: its segments, then its lakes, from vector number `first` of the data on.
// Lists are ordered by tile job, then map.
struct DrainageList {
    uint first, segmentCount, lakeCount, unused;
};

SHARED_END

#ifdef __cplusplus
namespace terrane::shared {
static_assert(sizeof(DrainageList) == sizeof(uvec4));
static_assert(sizeof(RiverSegment) == kVectorsPerSegment * sizeof(vec4));
}  // namespace terrane::shared
#endif
#endif

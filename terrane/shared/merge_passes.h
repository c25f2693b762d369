// The passes of the methods that merge rectangles, as both back ends of the mesher run them. A pass merges
// rectangles that touch at a line and are equally long beside it; even passes along rows, odd ones across.
#ifndef TERRANE_SHARED_MERGE_PASSES_H
#define TERRANE_SHARED_MERGE_PASSES_H

#include "terrane/shared/language.h"

SHARED_BEGIN

// Values of mesh::MergeMethod
const uint kMergeNone = 0u;
const uint kMergeLines = 1u;
const uint kMergeSquares = 2u;
const uint kMergeSquaresExt = 3u;
const uint kMergeGreedy = 4u;

const uint kSquarePasses = 6u;  // from the first on; the two after them are those of Lines
const uint kMergePasses = 8u;

SHARED_FN uint firstMergePass(uint method) {
    return method == kMergeLines ? kSquarePasses : 0u;
}
// One past the last; 0 for methods without passes.
SHARED_FN uint endOfMergePasses(uint method) {
    if (method == kMergeSquares) return kSquarePasses;
    return method == kMergeLines || method == kMergeSquaresExt ? kMergePasses : 0u;
}

// Lines at which a pass merges: bit n stands for the line between bits (or rows) n - 1 and n. First the
// middles of cells of 2, 4 and 8, then all lines but those between cells of 8.
SHARED_FN uint mergeLines(uint pass) {
    if (pass < 2u) return 0xAAAAu;
    if (pass < 4u) return 0x4444u;
    return pass < kSquarePasses ? 0x1010u : 0xFEFEu;
}
// Length that the first rectangle must have along the axis, as in the thesis; the second is at most as long.
// 0: any length.
SHARED_FN uint mergeLength(uint pass) {
    return pass < kSquarePasses ? 1u << (pass >> 1) : 0u;
}

SHARED_END
#endif

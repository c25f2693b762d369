// The steps of the merging methods that join rectangles, as both back ends of the mesher take them. A step
// joins rectangles that touch at a line and are equally long beside it; even steps along rows, odd ones
// across.
#ifndef TERRANE_SHARED_JOIN_STEPS_H
#define TERRANE_SHARED_JOIN_STEPS_H

#include "terrane/shared/language.h"

SHARED_BEGIN

// Values of mesh::Method
const uint kMergeNone = 0u;
const uint kMergeLines = 1u;
const uint kMergeSquares = 2u;
const uint kMergeSquaresExt = 3u;
const uint kMergeGreedy = 4u;

const uint kSquareSteps = 6u;  // from the first on; the two behind them are those of Lines
const uint kJoinSteps = 8u;

SHARED_FN uint firstJoinStep(uint method) {
    return method == kMergeLines ? kSquareSteps : 0u;
}
// The one behind the last; 0 for methods without steps.
SHARED_FN uint endOfJoinSteps(uint method) {
    if (method == kMergeSquares) return kSquareSteps;
    return method == kMergeLines || method == kMergeSquaresExt ? kJoinSteps : 0u;
}

// Where a step joins: bit n stands for the line between bits (or rows) n - 1 and n. The middles of cells of
// 2, 4 and 8, then all but those between cells of 8.
SHARED_FN uint joinLines(uint step) {
    if (step < 2u) return 0xAAAAu;
    if (step < 4u) return 0x4444u;
    return step < kSquareSteps ? 0x1010u : 0xFEFEu;
}
// How long both rectangles are along the axis; 0: any length.
SHARED_FN uint joinLength(uint step) {
    return step < kSquareSteps ? 1u << (step >> 1) : 0u;
}

SHARED_END
#endif

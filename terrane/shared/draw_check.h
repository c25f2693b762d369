// The pattern that tells whether a driver draws as OpenGL says: render/quads/draw_check.h.
#ifndef TERRANE_SHARED_DRAW_CHECK_H
#define TERRANE_SHARED_DRAW_CHECK_H

#include "terrane/shared/hash.h"
#include "terrane/shared/language.h"

SHARED_BEGIN

const uint kCheckSide = 64u;  // pixels along a side of the image

// Quads of a pixel have their left edge at the border of the pixel, or right of its middle: by a step of a
// grid with so many bits. Then the quad covers no sample, unless the grid is coarser.
const uint kWholePixel = 0u;

SHARED_FN float leftEdgeOf(uint gridBits) {
    return gridBits == kWholePixel ? 0.0f : 0.5f + 1.0f / float(1u << gridBits);
}

// What a quad of a draw shows: all bits of its record count. Never 0, which is the background.
SHARED_FN uint checkValue(ivec2 record, uint quad) {
    return hash2(uint(record.x), uint(record.y), quad) | 1u;
}

SHARED_END
#endif

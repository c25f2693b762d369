// Sizes of the world, and limits of its image, that C++ and GLSL agree on.
#ifndef TERRANE_SHARED_CONSTANTS_H
#define TERRANE_SHARED_CONSTANTS_H

#include "terrane/shared/language.h"

SHARED_BEGIN

const uint kChunkSize = 16u;     // blocks along x and y
const uint kChunkHeight = 256u;  // blocks along z, unless a world has other heights
const uint kSectionSize = 16u;   // a section is 16³ blocks

const uint kBlocksPerLayer = 256u;     // 16 × 16
const uint kBlocksPerSection = 4096u;  // 16³

// Corners of nearly folded quads move no farther along them than this many times the growth of their edges
// (render/frame/edge_expansion.glsl).
const float kLongestMiter = 64.0f;

// Cells of the screen at whose corners render/corners/corner_sky.cpp computes the sky, and vertices of all,
// six a cell.
const uint kSkyGridColumns = 40u;
const uint kSkyGridRows = 48u;
const uint kSkyGridVertices = 11520u;

SHARED_END
#endif

// Sizes of the world that C++ and GLSL agree on.
#ifndef TERRANE_SHARED_CONSTANTS_H
#define TERRANE_SHARED_CONSTANTS_H

#include "terrane/shared/language.h"

SHARED_BEGIN

const uint kChunkSize = 16u;     // blocks along x and y
const uint kChunkHeight = 256u;  // blocks along z, unless a world has other heights
const uint kSectionSize = 16u;   // a section is 16³ blocks

const uint kBlocksPerLayer = 256u;     // 16 × 16
const uint kBlocksPerSection = 4096u;  // 16³

SHARED_END
#endif

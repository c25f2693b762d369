// Sizes of the world that C++ and GLSL agree on.
#ifndef TERRANE_SHARED_CONSTANTS_H
#define TERRANE_SHARED_CONSTANTS_H

#include "terrane/shared/language.h"

SHARED_BEGIN

const uint kChunkSize = 16u;         // blocks along x and y
const uint kChunkHeight = 256u;      // blocks along z
const uint kSectionSize = 16u;       // a section is 16³ blocks
const uint kSectionsPerChunk = 16u;  // kChunkHeight / kSectionSize

const uint kBlocksPerLayer = 256u;     // 16 × 16
const uint kBlocksPerSection = 4096u;  // 16³
const uint kBlocksPerChunk = 65536u;   // 16 × 16 × 256: an index fits 16 bits exactly

SHARED_END
#endif

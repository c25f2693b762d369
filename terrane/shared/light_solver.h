// Constants and records shared by the host and the shaders that solve light (terrane/light_gpu).
#ifndef TERRANE_SHARED_LIGHT_SOLVER_H
#define TERRANE_SHARED_LIGHT_SOLVER_H

#include "terrane/shared/constants.h"
#include "terrane/shared/language.h"
#include "terrane/shared/light_grid.h"

SHARED_BEGIN

// Storage buffers, after those of shared/packed_section.h
const uint kSolverLightLevelsBinding = 2u;
const uint kSolverTilesBinding = 3u;
const uint kSolverListsBinding = 4u;
const uint kSolverStateBinding = 5u;
const uint kSolverNeighborsBinding = 6u;
const uint kSolverResultBinding = 7u;

// Levels lie two to a word (the block at the even x in the lower half) in light tiles of 8³ blocks: x
// fastest, then y, then z, 256 words. A work group raises a light tile, each invocation a word. Light tile k
// of a chunk is the one at x + 2 y + 4 z. A section has eight of them.
const uint kLightTileWordsX = 4u;
const uint kLightTileWords = 256u;
const uint kLightTilesPerSection = 8u;
const uint kBrickWords = 2048u;  // 16³ blocks

// Rounds submitted to the GPU at once; even, so that the two work lists keep their turns. Light crosses at
// most 14 borders between light tiles, on most paths two.
const uint kSolverRounds = 4u;

// Blocks by their properties: opacity in bits 0–3, emission in 4–15.
SHARED_FN uint opacityOf(uint property) {
    return property & 15u;
}
SHARED_FN uint emissionOf(uint property) {
    return property >> 4;
}

// Number of a neighboring chunk that is unknown.
const uint kNoChunk = 0xFFFFFFFFu;

// A round's indirect dispatch: x is the length of its work list.
struct SolverRound {
    uint groupsX;
    uint groupsY;
    uint groupsZ;
    uint unused;
};

// Summary of a light tile before light spreads: the bitwise or of its light values in the low 16 bits, and
// these bits.
const uint kTileIsUniform = 0x10000u;
const uint kTileIsOpaque = 0x20000u;  // no light gets in

// The result, in words: the number of light tiles left on the list of the last round; if it is 0, an entry
// for each solved section of each chunk, the one value of its brick or the number of the brick's words; the
// words of bricks, kBrickWords each.
const uint kBrickUniformBit = 0x80000000u;
SHARED_FN uint resultEntry(uint chunk, uint section, uint sectionCount) {
    return 1u + chunk * sectionCount + section;
}
SHARED_FN uint resultWords(uint entries, uint brick) {
    return 1u + entries + brick * kBrickWords;
}

SHARED_END

#ifdef __cplusplus
namespace terrane::shared {
static_assert(sizeof(SolverRound) == 16);
static_assert(kLightTileWords == kLightTileWordsX * kLightTileSize * kLightTileSize);
static_assert(kLightTilesPerSection * kLightTileWords == kBrickWords && kBrickWords * 2 == kBlocksPerSection);
}  // namespace terrane::shared
#endif
#endif

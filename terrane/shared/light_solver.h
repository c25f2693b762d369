// What the host and the shaders that solve light agree on (terrane/light_gpu).
#ifndef TERRANE_SHARED_LIGHT_SOLVER_H
#define TERRANE_SHARED_LIGHT_SOLVER_H

#include "terrane/shared/constants.h"
#include "terrane/shared/language.h"

SHARED_BEGIN

// Storage buffers, after those of shared/packed_section.h
const uint kSolverLevelsBinding = 2u;
const uint kSolverCellsBinding = 3u;
const uint kSolverListsBinding = 4u;
const uint kSolverStateBinding = 5u;
const uint kSolverNeighboursBinding = 6u;
const uint kSolverResultBinding = 7u;

// Levels lie two to a word (the block at the even x in the lower half) in cells of 8³ blocks: x fastest, then
// y, then z, 256 words. A work group raises a cell, each invocation a word. Cell k of a chunk is the one at
// x + 2 y + 4 z.
const uint kCellSize = 8u;
const uint kCellWordsX = 4u;
const uint kCellWords = 256u;
const uint kCellsPerChunk = 128u;  // 2 × 2 × 32
const uint kCellsHigh = 32u;
const uint kBrickWords = 2048u;  // 16³ blocks

// Rounds that are given to the GPU at once; even, so that the two work lists keep their turns. Light crosses
// at most 14 borders between cells, on most paths two.
const uint kSolverRounds = 4u;

// Blocks by their properties: opacity in bits 0–3, emission in 4–15.
SHARED_FN uint opacityOf(uint property) {
    return property & 15u;
}
SHARED_FN uint emissionOf(uint property) {
    return property >> 4;
}

// Of the chunks beside one, where nothing is known.
const uint kNoChunk = 0xFFFFFFFFu;

// A round's indirect dispatch: x is the length of its work list.
struct SolverRound {
    uint groupsX;
    uint groupsY;
    uint groupsZ;
    uint unused;
};

// Of a cell before light spreads: all its light or'ed, and
const uint kCellIsUniform = 0x10000u;
const uint kCellIsOpaque = 0x20000u;  // no light gets in

// The result, in words: how many cells are left on the list of the last round; if none is, sixteen entries a
// chunk, each the one value of a brick or the number of its words; the words of bricks, kBrickWords each.
const uint kBrickUniformBit = 0x80000000u;
SHARED_FN uint resultEntry(uint chunk, uint section) {
    return 1u + chunk * kSectionsPerChunk + section;
}
SHARED_FN uint resultWords(uint chunkCount, uint brick) {
    return 1u + chunkCount * kSectionsPerChunk + brick * kBrickWords;
}

SHARED_END

#ifdef __cplusplus
namespace terrane::shared {
static_assert(sizeof(SolverRound) == 16);
static_assert(kCellWords == kCellWordsX * kCellSize * kCellSize);
static_assert(kCellsPerChunk * kCellWords * 2 == kBlocksPerChunk && kBrickWords * 2 == kBlocksPerSection);
}  // namespace terrane::shared
#endif
#endif

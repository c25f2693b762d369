// Layout of light on the GPU: light tiles of 8³ blocks in a pool, found through a grid that wraps around the
// camera.
#ifndef TERRANE_SHARED_LIGHT_GRID_H
#define TERRANE_SHARED_LIGHT_GRID_H

#include "terrane/shared/language.h"

SHARED_BEGIN

const uint kLightTileSize = 8u;         // blocks a side
const uint kLightTilesPerChunk = 128u;  // 2 × 2 × 32
const uint kLightTilesHigh = 32u;       // a chunk's 256 blocks
const uint kLightPoolTiles = 64u;       // light tiles of the pool texture along x and along y

// An entry of the grid: a light tile's number in the pool, or the one value of a light tile that needs none.
const uint kLightUniformBit = 0x80000000u;
// Entry where no chunk is lit: full daylight, as under the open sky.
const uint kLightUnknown = 0x8000F000u;

SHARED_END
#endif

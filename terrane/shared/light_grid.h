// Layout of light on the GPU: light tiles of 8³ blocks in a pool. They are found through a grid of bricks of
// 16³ blocks, which wraps around the camera and is as high as the world, and the entries of a brick's light
// tiles.
#ifndef TERRANE_SHARED_LIGHT_GRID_H
#define TERRANE_SHARED_LIGHT_GRID_H

#include "terrane/shared/language.h"

SHARED_BEGIN

const uint kLightTileSize = 8u;    // blocks a side
const uint kLightPoolTiles = 64u;  // light tiles of the pool texture along x and along y

// An entry of the grid: a brick's number among the entries, eight of them a brick (x + 2 y + 4 z of its light
// tiles), or the one value of a brick that needs none. An entry there: a light tile's number in the pool, or
// its one value.
const uint kLightUniformBit = 0x80000000u;
// Entry where no chunk is lit: full daylight, as under the open sky.
const uint kLightUnknown = 0x8000F000u;

SHARED_END
#endif

// Which cells stop rays: the words that terrane/rays/scene.h writes and shared/ray_cast.h reads, in C++ and
// GLSL.
//
//   header    levels, heights; for each level its grid
//   grid      of level k: kRayEntryWords for each tile of 16×16 columns that are 2^k blocks wide, in a square
//             window around the camera that wraps around: tile (x, y) lies at (x mod side, y mod side)
//   column    of a tile: one word for each section, from the highest of the equal ones at the bottom
//   section   a sparse tree of two levels with 4³ children each, below
//
// A tile is in the scene (kRayTile), or its four tiles of the level below are asked (kRayDivided), or neither
// (kRayNothing: a tile of a higher level may cover it, or nothing does).
#ifndef TERRANE_SHARED_RAY_SCENE_H
#define TERRANE_SHARED_RAY_SCENE_H

#include "terrane/shared/constants.h"
#include "terrane/shared/language.h"

SHARED_BEGIN

// Words of the header
const uint kRayLevelCount = 0u;
const uint kRayBottom = 1u;      // layers below are empty
const uint kRayTop = 2u;         // this layer and those above are empty
const uint kRaySideBits = 3u;    // the side of all windows is 2^bits tiles
const uint kRayFirstLevel = 4u;  // kRayLevelWords for each level
const uint kRayLevelWords = 4u;
const uint kRayLowX = 0u;  // the tile with the lowest x and y in the window
const uint kRayLowY = 1u;
const uint kRayGrid = 2u;  // where the grid begins; the fourth word is unused
const uint kMaxRayLevels = 16u;
const uint kRayHeaderWords = kRayFirstLevel + kMaxRayLevels * kRayLevelWords;

// Words of an entry: what is there, and its heights: the top in the upper 16 bits (in blocks, above it all is
// empty), the lowest section of the column in the lower 16 bits, both signed.
const uint kRayEntryWords = 2u;
const uint kRayNothing = 0u;
const uint kRayDivided = 1u;
const uint kRayTile = kRayHeaderWords;  // or more: where the column begins

SHARED_FN uint packRayHeights(int top, int lowestSection) {
    return uint(top) << 16 | (uint(lowestSection) & 0xFFFFu);
}
SHARED_FN int rayTopOf(uint heights) {
    return int(heights) >> 16;
}
SHARED_FN int rayLowestSectionOf(uint heights) {
    return int(heights << 16) >> 16;
}

// Words of a column: an empty section, a full one, or where the section's node begins. Sections below the
// lowest of the column are like that one.
const uint kRayEmpty = 0u;
const uint kRayFull = 1u;

// The node of a section has three words for each half of its 64 children, the lower ones first. Child
// x + 4 y + 16 z, of 4³ cells, is bit (x + 4 y + 16 z) mod 32.
const uint kRayNodeWords = 6u;
const uint kRayHalfWords = 3u;
const uint kRayAny = 0u;      // children with a cell that stops rays
const uint kRayPartial = 1u;  // of these, children with an empty cell, too
const uint kRayLeaves = 2u;   // where the leaves of the partial children begin, one after the other
// The leaf of a child has a bit for each of its 4³ cells, in the same order.
const uint kRayLeafWords = 2u;

// The bits of the lowest 2³ of 4³ children or cells, which lie in one word.
const uint kRayOctant = 0x00330033u;

// What rayColumnAt() of ray_cast.h finds at a place of a ray.
struct RayColumn {
    uint state;  // one of those below
    int level;
    uint words;    // where the tile's column begins
    uint heights;  // of the tile: packRayHeights()
    ivec4 end;     // mirrored planes before which nothing stops the ray, with kRaySkip
};
const uint kRayInside = 0u;  // cells of a tile
const uint kRaySkip = 1u;    // a box without cells that stop rays
const uint kRayGone = 2u;    // the ray has left the scene

SHARED_END

#ifdef __cplusplus
namespace terrane::shared {
static_assert(sizeof(RayColumn) == 32);
static_assert(kMaxRayLevels * kRayLevelWords + kRayFirstLevel == kRayHeaderWords);
}  // namespace terrane::shared
#endif
#endif

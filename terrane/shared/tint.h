// The tint: a color of each column that changes the textures of tinted faces, and the clipmap of textures
// around the camera that shaders read it from.
#ifndef TERRANE_SHARED_TINT_H
#define TERRANE_SHARED_TINT_H

#include "terrane/shared/language.h"

SHARED_BEGIN

// The tint that changes nothing, as sRGB bytes: the mean color of the texture grass_top. A tint is the color
// that grass has in a place.
const uint kNeutralTintRed = 95u;
const uint kNeutralTintGreen = 135u;
const uint kNeutralTintBlue = 50u;

// Level l of the clipmap has texels of 4^(l + 1) blocks, the columns of the generator's level 2 l + 2. A
// chunk of that level is a tile of 16 × 16 texels; a level holds 16 × 16 tiles: 256² × 4 bytes × 5 levels =
// 1.3 MB. The coarsest is used up to 7 tiles from the camera: 114,688 blocks.
const uint kTintLevels = 5u;
const uint kTintTexels = 256u;  // along a side of a level
const uint kTintTiles = 16u;    // the same in tiles

// A level: x, y: texture coordinates of the corner of the camera's chunk; z: texture coordinates a block; w:
// distance from the camera along each axis up to which it is complete, blocks; 0 if the level is not used.
struct TintFrame {
    vec4 levels[kTintLevels];
};

SHARED_END

#ifdef __cplusplus
namespace terrane::shared {
static_assert(sizeof(TintFrame) == 16 * kTintLevels);

constexpr int tintGeneratorLevel(int level) {
    return 2 * level + 2;
}
}  // namespace terrane::shared
#endif
#endif

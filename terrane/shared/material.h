// Values of a material: alpha mode and animation as world::AlphaMode and world::Animation number them.
#ifndef TERRANE_SHARED_MATERIAL_H
#define TERRANE_SHARED_MATERIAL_H

#include "terrane/shared/language.h"

SHARED_BEGIN

const uint kMaxBlockTextures = 4096u;  // packed_face.glsl has 12 bits for the texture

const uint kAlphaUnused = 0u;
const uint kAlphaTest = 1u;
const uint kAlphaBlend = 2u;
const uint kAlphaGlow = 3u;
const uint kAlphaTestGlow = 4u;

const uint kAnimationNone = 0u;
const uint kAnimationTopWaves = 1u;
const uint kAnimationWholeWaves = 2u;
const uint kAnimationLiquidSurface = 3u;

SHARED_END
#endif

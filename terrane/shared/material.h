// Values of a material, as world::AlphaMode, Animation, Wrap and Filtering number them, and its packed
// options.
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
const uint kAlphaTint = 5u;

const uint kAnimationNone = 0u;
const uint kAnimationTopWaves = 1u;
const uint kAnimationWholeWaves = 2u;
const uint kAnimationLiquidSurface = 3u;

const uint kWrapQuad = 0u;
const uint kWrapRepeat = 1u;
const uint kWrapClamp = 2u;

const uint kFilteringOption = 0u;
const uint kFilteringSharp = 1u;
const uint kFilteringNearest = 2u;

// Height and waves of a liquid's surface are counted in these parts of a block.
const uint kSurfaceUnits = 1024u;
const uint kWaveUnits = 1000u;

// The look of a material: texture, layer of the array, in bits 0–11, alpha mode in 12–14, animation in 16–17.
SHARED_FN uint lookTexture(uint look) {
    return look & 4095u;
}
SHARED_FN uint lookAlphaMode(uint look) {
    return (look >> 12) & 7u;
}
SHARED_FN uint lookAnimation(uint look) {
    return (look >> 16) & 3u;
}

// The options of a material:
//
//   bits 0–1    wrap
//        2–3    filtering
//        4–7    how many times the texture was doubled to the size of the array
//        8–18   height of a liquid's surface
//        19–26  amplitude of its waves
//        27     whether it takes the tint
//
// Bits 0–7 say how a fragment samples its texture.
SHARED_FN uint optionsWrap(uint options) {
    return options & 3u;
}
SHARED_FN uint optionsFiltering(uint options) {
    return (options >> 2) & 3u;
}
SHARED_FN uint optionsDoublings(uint options) {
    return (options >> 4) & 15u;
}
SHARED_FN uint optionsSampling(uint options) {
    return options & 255u;
}
SHARED_FN float optionsSurfaceHeight(uint options) {
    return float((options >> 8) & 2047u) / float(kSurfaceUnits);
}
SHARED_FN float optionsWaveHeight(uint options) {
    return float((options >> 19) & 255u) / float(kWaveUnits);
}
SHARED_FN uint optionsTinted(uint options) {
    return (options >> 27) & 1u;
}

SHARED_END

#ifdef __cplusplus
namespace terrane::shared {

constexpr uint packLook(uint texture, uint alphaMode, uint animation) {
    return texture | alphaMode << 12 | animation << 16;
}

struct MaterialOptions {
    uint wrap = 0, filtering = 0, doublings = 0;
    uint surfaceHeight = 0;  // kSurfaceUnits a block
    uint waveHeight = 0;     // kWaveUnits a block
    uint tinted = 0;         // 0 or 1
};

constexpr uint packOptions(const MaterialOptions& o) {
    return o.wrap | o.filtering << 2 | o.doublings << 4 | o.surfaceHeight << 8 | o.waveHeight << 19 |
           o.tinted << 27;
}

}  // namespace terrane::shared
#endif
#endif

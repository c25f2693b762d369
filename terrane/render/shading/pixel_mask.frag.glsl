// Discards pixels in which no sample has what MASK selects: a surface, the sky or a surface that may fade into it, a
// layer of blended faces. MSAA_SAMPLES: more than one. For surfaces the depth tells distant ones and those of far
// tiles apart.
#include "terrane/render/frame/frame_uniforms.glsl"
#include "terrane/render/quads/gbuffer_read.glsl"

#if MASK == MASK_LAYERS
layout(binding = kTransparencyDepthUnit) uniform sampler2DMS layerDepth;
#endif

#if MASK == MASK_SURFACES
float depthOfClass(ivec2 pixel) {
    bool areFar = true, areDistant = true;
    for (int k = 0; k < MSAA_SAMPLES; ++k) {
        vec4 packedSurface = packedSurfaceAt(pixel, k);
        areFar = areFar && (packedIsFar(packedSurface) || packedDirection(packedSurface) == kDirectionNone);
        areDistant = areDistant && blocksOfDepth(depthAt(pixel, k)) > kSimpleLightFrom;
    }
    return areFar ? kFarSurfacesDepth : areDistant ? kDistantSurfacesDepth : 1.0;
}
#endif

bool isThere(ivec2 pixel, int k) {
#if MASK == MASK_LAYERS
    return texelFetch(layerDepth, pixel, k).r > depthAt(pixel, k);
#elif MASK == MASK_SKY
    return blocksOfDepth(depthAt(pixel, k)) >= kFadingBegins * frame.fogDistance;
#else
    return depthAt(pixel, k) > 0.0;
#endif
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    bool isAnyThere = false;
    for (int k = 0; k < MSAA_SAMPLES; ++k) isAnyThere = isAnyThere || isThere(pixel, k);
    if (!isAnyThere) discard;
#if MASK == MASK_SURFACES
    gl_FragDepth = depthOfClass(pixel);
#endif
}

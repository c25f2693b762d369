// What the camera sees, found by one ray for each sample. Surfaces are written as gbuffer.frag.glsl writes those of
// quads, and layers of blended faces as depth_peel.frag.glsl does.
// RAY_LAYER, PASS: see shared/variants.h. MSAA_SAMPLES: of the targets. SMOOTH, FACE_SAMPLING: see block_texture.glsl.
// TINT: see block_tint.glsl.
#include "terrane/render/frame/frame_uniforms.glsl"
#include "terrane/render/quads/shape_tables.glsl"
#include "terrane/render/quads/block_texture.glsl"
#if TINT == 1
#include "terrane/render/quads/tint_place.glsl"
#endif
#include "terrane/render/quads/block_tint.glsl"
#include "terrane/render/rays/ray_surfaces.glsl"
#include "terrane/render/shading/packed_layer.glsl"

layout(location = 0) out vec4 outSurface;

#if RAY_LAYER != RAY_SURFACES
#if MSAA_SAMPLES > 1
layout(binding = kDepthUnit) uniform sampler2DMS opaqueDepths;
layout(binding = kTransparencyDepthUnit) uniform sampler2DMS lastDepths;
#else
layout(binding = kDepthUnit) uniform sampler2D opaqueDepths;
layout(binding = kTransparencyDepthUnit) uniform sampler2D lastDepths;
#endif

// As in depth_peel.frag.glsl.
const float kNotBehind = 1.0 - 1.0 / 524288.0;
#endif

#if MSAA_SAMPLES > 1
#define SAMPLE gl_SampleID
#else
#define SAMPLE 0
#endif

// Where the sample is on the screen. OpenGL does not define the place of gl_FragCoord in the pixel.
vec2 placeOfSample() {
#if MSAA_SAMPLES > 1
    return floor(gl_FragCoord.xy) + gl_SamplePosition;
#else
    return gl_FragCoord.xy;
#endif
}

// Sets where surfaces are looked for along the ray. False: nowhere.
bool setRange(ivec2 pixel, out float end) {
    rayLeastT = frame.nearPlane;
    end = kEndOfRays;
#if RAY_LAYER != RAY_SURFACES
    float behind = texelFetch(opaqueDepths, pixel, SAMPLE).r;
    if (behind > 0.0) end = frame.nearPlane / behind;
#endif
#if RAY_LAYER == RAY_NEXT_LAYER
    float last = texelFetch(lastDepths, pixel, SAMPLE).r;
    if (!(last > behind)) return false;
    rayLeastT = frame.nearPlane / (last * kNotBehind);
#endif
    return true;
}

float alphaOf(FaceLook look) {
    return blockTexture(look.packedFace, look.texel, look.dx, look.dy).a;
}

float glowOf(uint face, float alpha) {
    if (alphaModeOf(face) == kAlphaGlow) return alpha;
    return alphaModeOf(face) == kAlphaTestGlow ? clamp(2.0 * alpha - 1.0, 0.0, 1.0) : 0.0;
}

void main() {
    vec3 direction = rayAt(2.0 * placeOfSample() / frame.viewportSize - 1.0);
    rayAcrossPixel = 2.0 / frame.viewportSize.x * frame.rayAcross.xyz;
    rayUpPixel = 2.0 / frame.viewportSize.y * frame.rayUp.xyz;
    float end;
    if (!setRange(ivec2(gl_FragCoord.xy), end)) discard;
    if (!findSurface(rayFrom(frame.cameraPosition.xyz, direction, end))) discard;
    FaceLook look = lookOf(nearest.shapeFace, nearest.material, nearest.t, nearestCorner);
    uint face = look.packedFace, side = directionOfFace(face);
    if (!nearest.isFront && side < kDirectionPlant) side ^= 1u;
    vec4 texel = blockTexture(face, look.texel, look.dx, look.dy);
#if TINT == 1
    vec2 corner = chunkCorner(here.tile, uint(here.level), frame.cameraChunk);
    setTintPlace(corner + vec2(here.at.xy) / here.scale.xy, frame.cameraPosition.xy + direction.xy * nearest.t);
#endif
#if RAY_LAYER == RAY_SURFACES
    outSurface = packSurface(tintedColor(face, texel), side, glowOf(face, texel.a), isFarFace(face));
#else
    if (isLiquid(face)) texel = mix(texel, textureLod(blockTextures, vec3(0.5, 0.5, textureOf(face)), 10.0), 0.7);
    texel.rgb = tintedColor(face, texel);
    outSurface = packLayer(texel, side, isFarFace(face), isLiquid(face));
#endif
    gl_FragDepth = frame.nearPlane / nearest.t;
}

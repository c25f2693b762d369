// A layer of blended faces: the nearest of those behind the previous layer. NEXT: 0 for the first layer, 1 for the
// others. MSAA_SAMPLES: of the layers; above 1 the layers behind the first are drawn sample by sample. TINT: see
// block_tint.glsl.
#include "terrane/render/frame/frame_uniforms.glsl"
#include "terrane/shared/quad.h"
#include "terrane/shared/shape_face.h"
#include "terrane/render/quads/packed_face.glsl"
#define SMOOTH 1
#include "terrane/render/quads/block_texture.glsl"
#include "terrane/render/quads/block_tint.glsl"
#include "terrane/render/shading/packed_layer.glsl"

#if NEXT == 1
#if MSAA_SAMPLES > 1
layout(binding = kTransparencyDepthUnit) uniform sampler2DMS before;
#else
layout(binding = kTransparencyDepthUnit) uniform sampler2D before;
#endif
#endif

// A face behind the layer must be farther by 2^-19, 0.0002 blocks at 100 blocks: depths that are computed twice differ
// in the last bits.
const float kNotBehind = 1.0 - 1.0 / 524288.0;

layout(location = 0) in vec2 inTexel;
layout(location = 1) flat in uvec2 inFace;
layout(location = 0) out vec4 outLayer;

#if MSAA_SAMPLES > 1 && NEXT == 1
// Depth at the sample that is drawn. OpenGL does not define the place of gl_FragCoord in the pixel: its center on
// NVIDIA, the sample on Mesa. A face is plane, and so is its depth on the screen.
float depthOfSample() {
    vec2 toSample = gl_SamplePosition - fract(gl_FragCoord.xy);
    return gl_FragCoord.z + dot(vec2(dFdx(gl_FragCoord.z), dFdy(gl_FragCoord.z)), toSample);
}
#endif

void main() {
    vec2 dx = dFdx(inTexel), dy = dFdy(inTexel);  // before neighboring pixels may be discarded
#if NEXT == 1
#if MSAA_SAMPLES > 1
    float depth = depthOfSample(), last = texelFetch(before, ivec2(gl_FragCoord.xy), gl_SampleID).r;
#else
    float depth = gl_FragCoord.z, last = texelFetch(before, ivec2(gl_FragCoord.xy), 0).r;
#endif
    if (depth >= last * kNotBehind) discard;
#endif
    vec4 texel = blockTexture(inFace.x, inTexel, dx, dy);
    // A liquid shows mostly its mean color, little of its pattern.
    if (isLiquid(inFace.x)) texel = mix(texel, textureLod(blockTextures, vec3(0.5, 0.5, textureOf(inFace.x)), 10.0), 0.7);
    uint direction = directionOfFace(inFace.x);
    if (!gl_FrontFacing && direction < kDirectionPlant) direction ^= 1u;
    texel.rgb = tintedColor(inFace.x, texel);
    outLayer = packLayer(texel, direction, isFarFace(inFace.x), isLiquid(inFace.x));
}

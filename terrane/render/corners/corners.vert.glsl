// Places and shades the corner of a quad for corners.frag.glsl. ALPHA_CLASS: see shared/variants.h. TINT: see
// block_tint.glsl.
#include "terrane/render/frame/frame_uniforms.glsl"
#include "terrane/render/quads/quad_pull.glsl"
#include "terrane/render/corners/corner_shade.glsl"
#if TINT == 1
#include "terrane/render/quads/tint_place.glsl"
#endif
#include "terrane/render/quads/block_tint.glsl"
#include "terrane/shared/quad_light.h"
#if ALPHA_CLASS == ALPHA_BLENDED
#include "terrane/render/water/water_body.glsl"
#endif

layout(binding = kQuadLightUnit) uniform usamplerBuffer quadLight;

layout(location = 0) out vec3 outTexel;  // and its layer
layout(location = 1) out vec3 outScale;  // where the texel's alpha is 0
layout(location = 2) out vec3 outScaleOfAlpha;  // where it is 1: glowing, or tinted
layout(location = 3) out vec3 outAdded;
#if ALPHA_CLASS == ALPHA_TESTED
layout(location = 4) flat out float outMinAlpha;
#elif ALPHA_CLASS == ALPHA_BLENDED
layout(location = 4) out vec2 outAlpha;  // that of the texel times x, plus y
#endif

const float kGlowing = 1.2;  // scale of texels that glow

#if ALPHA_CLASS == ALPHA_BLENDED
// A surface of water over some blocks of water: smooth, as waves are smaller than quads.
void shadeWaterCorner(vec3 mean, vec3 normal, vec4 levels, vec3 toPoint) {
    const float kDepth = 5.0;  // blocks of water below the surface
    vec3 view = normalize(toPoint);
    float up = abs(normal.z), facing = abs(dot(view, normal));
    vec4 light = brightnessOf(levels);
    vec3 seen = throughBody(min(kDepth / max(up * facing, 0.1), 12.0));
    vec3 lit = light.a * (frame.ambientColor.rgb + frame.lightColor.rgb * max(frame.lightDirection.z, 0.0)) +
               light.rgb * (1.0 - frame.hiddenLampShare * light.a) + kMinLight;
    vec3 body = waterBody(linearFromSrgb(mean), lit, 12.0 * (1.0 - seen.g)) * (1.0 - seen);
    float mirror = up > 0.5 ? waterMirror(facing) : 0.03;
    vec3 mirrored = skyColor(vec3(view.xy, abs(view.z))) * (light.a * light.a);
#if UNDER_WATER == 1
    body = murk();
    mirrored = body;
#endif
    float alpha = 1.0 - dot(seen, vec3(1.0 / 3.0)) * (1.0 - mirror);
    vec3 color = mix(body / max(1.0 - dot(seen, vec3(1.0 / 3.0)), 0.05), mirrored, mirror);
    outScale = vec3(0.0);
    outScaleOfAlpha = outScale;
    outAdded = displayColor(throughAirToSky(color, toPoint, levels.a));
    outAlpha = vec2(0.0, alpha);
}
#endif

void main() {
    QuadCorner q = pulledCorner(gl_VertexID);
    vec2 chunkAt = chunkCorner(q.chunk, q.level, frame.cameraChunk);
    vec3 position = wavedInChunk(q) + vec3(chunkAt, 0.0), toPoint = position - frame.cameraPosition.xyz;
#if ALPHA_CLASS == ALPHA_BLENDED
    gl_Position = frame.viewProjection * vec4(position, 1.0);
#else
    gl_Position = grownCorner(q, position);
#endif
#if TINT == 1
    setTintPlace(q.cellBlocks.xy * q.cell.xy + chunkAt, position.xy);
#endif
    uint face = packFace(q.quad, q.material, q.level, faceDirectionOf(q.face));
    uvec2 words = texelFetch(quadLight, q.number).rg;
    vec4 levels = unpackLight(lightOfCorner(QuadLight(words.x, words.y), uint(gl_VertexID & 3)));
    uint direction = directionOfFace(face);
    vec3 normal = normalOf(direction), mean = unpackUnorm4x8(q.material.meanColor).rgb;
    if (direction < kDirectionPlant && dot(normal, toPoint) > 0.0) normal = -normal;
    uint mode = lookAlphaMode(q.material.look);
    outTexel = vec3(texelOf(quadShapeFace(q.quad), q.face, q.corner) * extentOf(face), float(lookTexture(q.material.look)));
#if ALPHA_CLASS == ALPHA_BLENDED
    if (lookAnimation(q.material.look) == kAnimationLiquidSurface) {
        shadeWaterCorner(mean, normal, levels, toPoint);
        return;
    }
    outAlpha = vec2(1.0, 0.0);
#elif ALPHA_CLASS == ALPHA_TESTED
    outMinAlpha = mode == kAlphaTestGlow ? 0.25 : 0.5;
#endif
    Air air = airBefore(toPoint, levels.a);
    outAdded = displayColor(air.added);
    vec3 color = tintedColor(face, vec4(mean, 0.0));
    Surface s = Surface(linearFromSrgb(color), normal, 0.0, direction, false, false);
    outScale = scaleOf(mean, lightOf(s, levels), air, outAdded);
    // Not shaded once more: software renderers would do that for all vertices.
    vec3 tinted = outScale * (tintedColor(face, vec4(mean, 1.0)) / max(color, 1.0 / 255.0));
    vec3 glowing = max(outScale, kGlowing * air.share);
    bool isGlowing = mode == kAlphaGlow || mode == kAlphaTestGlow;
    outScaleOfAlpha = isGlowing ? glowing : mode == kAlphaTint ? tinted : outScale;
}

// The texture of a face at a point. Needs packed faces (packed_face.glsl) and frame_uniforms.glsl.
// FACE_SAMPLING: 1 if some faces wrap or filter their textures in their own way, or have textures smaller than the
// array (block_textures.h). Otherwise the shader is shorter. PASS: see shared/variants.h.
layout(binding = kBlockTexturesUnit) uniform sampler2DArray blockTextures;
#if FACE_SAMPLING == 1
layout(binding = kSmoothTexturesUnit) uniform sampler2DArray smoothTextures;
layout(binding = kNearestTexturesUnit) uniform sampler2DArray nearestTextures;
#if PASS == PASS_RAYS
uint inSampling;
#else
layout(location = 2) flat in uint inSampling;  // of the material's options
#endif
#else
const uint inSampling = 0u;
#endif

uint textureOf(uint face) {
    return face & 4095u;
}
bool isLiquid(uint face) {
    return (face >> 18 & 1u) != 0u;
}

// Clamps texture coordinates, in texels, so that filters stay inside the quad: textures repeat inside it, but filters
// must not reach around its edge to the opposite one, where a plant has its stem and a grass block its soil. `margin`
// texels stay between. Faces may wrap otherwise.
vec2 keptInside(uint face, vec2 at, vec2 inTextures, vec2 size, vec2 margin) {
    if (optionsWrap(inSampling) == kWrapRepeat) return at;
    vec2 low = vec2(0.0), high = extentOf(face) * size;
    if (optionsWrap(inSampling) == kWrapClamp) {
        low = size * floor(clamp(inTextures, vec2(0.0), extentOf(face) - 1.0 / 1024.0));
        high = low + size;
    }
    return clamp(at, low + margin, high - margin);
}

// Magnified textures are constant inside a texel and blend linearly over one pixel at its edges: they neither shimmer
// nor blur. Half a texel of the mipmap stays between filters and the border.
vec4 sharpTexture(sampler2DArray textures, uint face, vec2 inTextures, vec2 dx, vec2 dy) {
    uint doublings = optionsDoublings(inSampling);
    vec2 size = vec2(textureSize(textures, 0).xy >> int(doublings));
    vec2 texel = inTextures * size, texelsPerPixel = max((abs(dx) + abs(dy)) * size, 1e-6);
    vec2 edge = floor(texel + 0.5);
    vec2 sharp = edge + clamp((texel - edge) / texelsPerPixel, -0.5, 0.5);
    float largest = max(texelsPerPixel.x, texelsPerPixel.y);
    vec2 at = largest < 1.0 ? sharp : texel;
    vec2 margin = min(vec2(0.5 * max(largest, 1.0)), 0.5 * size);
    at = keptInside(face, at, inTextures, size, margin);
    // No level finer than an enlarged texture's own is read: its texels are smaller, and so are their edges.
    if (doublings > 0u && max(length(dx * size), length(dy * size)) < 1.0) {
        dx = vec2(1.0 / size.x, 0.0);
        dy = vec2(0.0, 1.0 / size.y);
    }
    return textureGrad(textures, vec3(at / size, textureOf(face)), dx, dy);
}

// SMOOTH 1: sharp filtering; 0 takes the nearest texel and costs a third. dx, dy: derivatives of the coordinates before
// clamping.
vec4 blockTexture(uint face, vec2 inTextures, vec2 dx, vec2 dy) {
#if SMOOTH == 0 && MSAA_SAMPLES <= 1 && PASS != PASS_RAYS
    // Cheaper, and the same result if no neighboring pixel was discarded and the coordinates are those of the face.
    vec4 nearest = texture(blockTextures, vec3(inTextures, textureOf(face)));
#endif
#if FACE_SAMPLING == 1
    if (optionsFiltering(inSampling) == kFilteringSharp) return sharpTexture(smoothTextures, face, inTextures, dx, dy);
    if (optionsFiltering(inSampling) == kFilteringNearest)
        return textureGrad(nearestTextures, vec3(inTextures, textureOf(face)), dx, dy);
#endif
#if SMOOTH == 1
    return sharpTexture(blockTextures, face, inTextures, dx, dy);
#elif MSAA_SAMPLES <= 1 && PASS != PASS_RAYS
    return nearest;
#else
    return textureGrad(blockTextures, vec3(inTextures, textureOf(face)), dx, dy);
#endif
}

// Level of the mipmap whose texels are nearest to a pixel's size along its shorter side, so that planes seen edge-on
// stay open. Never a level finer than the texture's own.
int nearestLevel(vec2 dx, vec2 dy) {
    int doublings = int(optionsDoublings(inSampling));
    vec2 size = vec2(textureSize(blockTextures, 0).xy >> doublings);
    float texels = min(length(dx * size), length(dy * size));
    return clamp(int(log2(max(texels, 1.0)) + 0.5) + doublings, 0, textureQueryLevels(blockTextures) - 1);
}

vec4 nearestTexel(uint face, vec2 inTextures, int level) {
    vec2 inside = clamp(inTextures, vec2(0.0), extentOf(face) - 1.0 / 1024.0);
    ivec2 texel = ivec2(fract(inside) * vec2(textureSize(blockTextures, level).xy));
    return texelFetch(blockTextures, ivec3(texel, textureOf(face)), level);
}

float minAlpha(uint face) {
    return alphaModeOf(face) == kAlphaTestGlow ? 0.25 : 0.5;
}

// The texture of a face at a point. Needs packed faces (packed_face.glsl) and frame_uniforms.glsl.
layout(binding = kBlockTexturesUnit) uniform sampler2DArray blockTextures;

uint textureOf(uint face) {
    return face & 4095u;
}
uint alphaModeOf(uint face) {
    return face >> 12 & 7u;
}
bool isLiquid(uint face) {
    return (face >> 18 & 1u) != 0u;
}

// Magnified textures are constant inside a texel and blend linearly over one pixel at its edges: neither blocks that
// shimmer nor blur (SMOOTH 1; 0 takes the nearest texel and costs a third). Textures repeat inside a quad, but
// filters must not reach around its edge to the opposite one, where a plant has its stem and a grass block its soil: half
// a texel of the mipmap stays between.
// dx, dy: of the coordinates, before the margin bends them.
vec4 blockTexture(uint face, vec2 inTextures, vec2 dx, vec2 dy) {
#if SMOOTH == 0 && MSAA_SAMPLES <= 1
    // Cheaper, and the same where no pixel beside has ended and the coordinates are those of the face.
    return texture(blockTextures, vec3(inTextures, textureOf(face)));
#elif SMOOTH == 0
    return textureGrad(blockTextures, vec3(inTextures, textureOf(face)), dx, dy);
#else
    vec2 size = vec2(textureSize(blockTextures, 0).xy);
    vec2 texel = inTextures * size, texelsPerPixel = max((abs(dx) + abs(dy)) * size, 1e-6);
    vec2 edge = floor(texel + 0.5);
    vec2 sharp = edge + clamp((texel - edge) / texelsPerPixel, -0.5, 0.5);
    float largest = max(texelsPerPixel.x, texelsPerPixel.y);
    vec2 at = largest < 1.0 ? sharp : texel;
    vec2 margin = min(vec2(0.5 * max(largest, 1.0)), 0.5 * size);
    at = clamp(at, margin, extentOf(face) * size - margin);
    return textureGrad(blockTextures, vec3(at / size, textureOf(face)), dx, dy);
#endif
}

// The mipmap whose texels are nearest to a pixel's size, along its shorter side: planes seen edge on do not close.
int nearestLevel(vec2 dx, vec2 dy) {
    vec2 size = vec2(textureSize(blockTextures, 0).xy);
    float texels = min(length(dx * size), length(dy * size));
    return clamp(int(log2(max(texels, 1.0)) + 0.5), 0, textureQueryLevels(blockTextures) - 1);
}

vec4 nearestTexel(uint face, vec2 inTextures, int level) {
    vec2 inside = clamp(inTextures, vec2(0.0), extentOf(face) - 1.0 / 1024.0);
    ivec2 texel = ivec2(fract(inside) * vec2(textureSize(blockTextures, level).xy));
    return texelFetch(blockTextures, ivec3(texel, textureOf(face)), level);
}

float minAlpha(uint face) {
    return alphaModeOf(face) == kAlphaTestGlow ? 0.25 : 0.5;
}

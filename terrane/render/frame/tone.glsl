// Tone mapping: exposure, a filmic curve, sRGB, and noise of one step against banding in the sky. Needs
// frame_uniforms.glsl.
#include "terrane/shared/hash.h"

// Linear up to kStart, from there an exponential shoulder that meets it with equal slope and ends at white.
vec3 compressHighlights(vec3 c) {
    const float kStart = 0.6;
    vec3 over = max(c - kStart, 0.0);
    return min(c, kStart) + (1.0 - kStart) * (1.0 - exp(-over / (1.0 - kStart)));
}

// Linear to sRGB by roots, off by half a step of 8 bits at most (I. Taylor, sRGB approximations for HLSL, 2012).
vec3 encodeSrgb(vec3 c) {
    vec3 s1 = sqrt(c), s2 = sqrt(s1), s3 = sqrt(s2);
    return mix(c * 12.92, 0.585122381 * s1 + 0.783140355 * s2 - 0.368262736 * s3, greaterThan(c, vec3(0.0031308)));
}

// Display color of linear light.
vec3 displayColor(vec3 light) {
    return encodeSrgb(clamp(compressHighlights(light * frame.exposure.rgb), 0.0, 1.0));
}

// With noise of one step.
vec3 dithered(vec3 color, ivec2 pixel) {
    uint noise = hash2(uint(pixel.x), uint(pixel.y), 0u);
    return color + (float(noise >> 16) / 65536.0 - 0.5) / 255.0;
}

vec3 screenColor(vec3 light, ivec2 pixel) {
    return dithered(displayColor(light), pixel);
}

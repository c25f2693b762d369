// The tint of a fragment: the color of its place from the generator changes the texture of a tinted face.
// TINT: 1 if the world has a tint (tint_textures.h). Needs packed faces (packed_face.glsl) and frame_uniforms.glsl.
#if TINT == 1
#include "terrane/shared/tint.h"

layout(std140, binding = kTintBinding) uniform TintBlock {
    TintFrame tintFrame;
};
layout(binding = kTintUnit) uniform sampler2DArray tints;
layout(location = 3) in vec2 inPlace;

const vec3 kNeutralTint = vec3(kNeutralTintRed, kNeutralTintGreen, kNeutralTintBlue) / 255.0;

// Tint of the finest level that reaches the place; over its outer quarter it blends into the next level.
vec3 tintAt(vec2 place) {
    vec2 away = abs(place - frame.cameraPosition.xy);
    float distance = max(away.x, away.y), left = 1.0;
    vec3 sum = vec3(0.0);
    for (uint k = 0u; k < kTintLevels && left > 0.0; ++k) {
        vec4 level = tintFrame.levels[k];
        float share = left * clamp(4.0 * (level.w - distance) / max(level.w, 1.0), 0.0, 1.0);
        if (share <= 0.0) continue;
        sum += share * textureLod(tints, vec3(level.xy + place * level.z, float(k)), 0.0).rgb;
        left -= share;
    }
    return sum + left * kNeutralTint;
}
#endif

// Tints by a power for each channel (world/tint.h): neutral becomes the tint, black and white stay.
vec3 tintedColor(uint face, vec4 texel) {
#if TINT == 1
    if (isTinted(face)) {
        float share = alphaModeOf(face) == kAlphaTint ? texel.a : 1.0;
        vec3 exponent = log(max(tintAt(inPlace), 1.0 / 255.0)) / log(kNeutralTint);
        return pow(max(texel.rgb, 1e-10), mix(vec3(1.0), exponent, share));
    }
#endif
    return texel.rgb;
}

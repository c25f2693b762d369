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

// Tint of the finest level that reaches the place; over its outer quarter it blends into the next one. Without branches:
// software renderers execute every branch and at least one round of a loop that may end early.
vec3 tintAt(vec2 place) {
    vec2 away = abs(place - frame.cameraPosition.xy);
    float distance = max(away.x, away.y), share = 0.0;
    vec3 fine = vec3(0.5, 0.5, -1.0), next = fine;  // texture coordinates and layer
    for (int k = int(kTintLevels) - 1; k >= 0; --k) {
        vec4 level = tintFrame.levels[k];
        float reached = clamp(4.0 - 4.0 * distance / max(level.w, 1e-3), 0.0, 1.0);
        bool isUsed = reached > 0.0;
        next = isUsed ? fine : next;
        fine = isUsed ? vec3(level.xy + place * level.z, float(k)) : fine;
        share = isUsed ? reached : share;
    }
    vec3 near = textureLod(tints, fine, 0.0).rgb, far = textureLod(tints, next, 0.0).rgb;
    near = fine.z < 0.0 ? kNeutralTint : near;
    far = next.z < 0.0 ? kNeutralTint : far;
    return mix(far, near, share);
}
#endif

// The same as world::tinted(), for a share of the tint.
vec3 tintedColor(uint face, vec4 texel) {
#if TINT == 1
    if (isTinted(face)) {
        const vec3 kAtNeutral = kNeutralTint / (1.0 - kNeutralTint), kAtWhite = 1.0 / (1.0 - kNeutralTint);
        float share = alphaModeOf(face) == kAlphaTint ? texel.a : 1.0;
        vec3 color = texel.rgb, tint = max(tintAt(inPlace), 1.0 / 255.0);
        return color * tint / (tint + share * (1.0 - color) * (kAtNeutral - kAtWhite * tint));
    }
#endif
    return texel.rgb;
}

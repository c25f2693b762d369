// The tint of a fragment, or with PASS_CORNERS of a vertex, with PASS_RAYS of a pixel: the color of its place from the generator changes the texture of a tinted face.
// TINT: 1 if the world has a tint (tint_textures.h). Needs packed faces (packed_face.glsl) and frame_uniforms.glsl.
#if TINT == 1
#include "terrane/shared/tint.h"

layout(binding = kTintUnit) uniform sampler2DArray tints;
#if PASS == PASS_CORNERS || PASS == PASS_RAYS
#define inTintAt outTintAt
#define inTintShare outTintShare
#define inTintLevels outTintLevels
#else
layout(location = 3) in vec4 inTintAt;  // see tint_place.glsl
layout(location = 4) in float inTintShare;
layout(location = 5) flat in ivec2 inTintLevels;
#endif

const vec3 kNeutralTint = vec3(kNeutralTintRed, kNeutralTintGreen, kNeutralTintBlue) / 255.0;

vec3 tintOfLevel(vec2 at, int level) {
    vec3 tint = textureLod(tints, vec3(at, float(level)), 0.0).rgb;
    return level < 0 ? kNeutralTint : tint;
}

vec3 tintHere() {
    vec3 near = tintOfLevel(inTintAt.xy, inTintLevels.x), far = tintOfLevel(inTintAt.zw, inTintLevels.y);
    return mix(far, near, inTintShare);
}
#endif

// The same as world::tinted(), for a share of the tint.
vec3 tintedColor(uint face, vec4 texel) {
#if TINT == 1
    if (isTinted(face)) {
        const vec3 kAtNeutral = kNeutralTint / (1.0 - kNeutralTint), kAtWhite = 1.0 / (1.0 - kNeutralTint);
        float share = alphaModeOf(face) == kAlphaTint ? texel.a : 1.0;
        vec3 color = texel.rgb, tint = max(tintHere(), 1.0 / 255.0);
        return color * tint / (tint + share * (1.0 - color) * (kAtNeutral - kAtWhite * tint));
    }
#endif
    return texel.rgb;
}

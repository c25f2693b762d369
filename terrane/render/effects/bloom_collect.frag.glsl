// Light above what the screen shows, from 4 × 4 pixels. Bright pixels count less, so that a pixel of glitter, in one frame and
// not in the next, makes no flickering spot (B. Karis, Real Shading in Unreal Engine 4, 2013).
#include "terrane/render/frame/frame_uniforms.glsl"

layout(binding = kSceneUnit) uniform sampler2D scene;

layout(location = 0) in vec2 inScreen;
layout(location = 0) out vec4 outLight;

const float kShown = 1.15;     // after exposure: brighter than snow at noon
const float kBrightest = 6.0;  // the sun's disc is much brighter

vec3 bright(vec2 at) {
    vec3 light = max(textureLod(scene, at, 0.0).rgb, 0.0) * frame.exposure.rgb;
    float most = max(max(light.r, light.g), light.b);
    return light * (clamp(most - kShown, 0.0, kBrightest) / max(most, 1e-4));
}

void main() {
    vec2 at = 0.5 + 0.5 * inScreen, pixel = 1.0 / vec2(textureSize(scene, 0));
    vec4 sum = vec4(0.0);
    for (int k = 0; k < 4; ++k) {
        vec3 light = bright(at + (2.0 * vec2(k & 1, k >> 1) - 1.0) * pixel);
        float weight = 1.0 / (1.0 + max(max(light.r, light.g), light.b));
        sum += weight * vec4(light, 1.0);
    }
    outLight = vec4(sum.rgb / sum.a, 1.0);
}

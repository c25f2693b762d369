// From light to the screen: exposure, a filmic curve, sRGB, and noise of one step against bands in the sky.
#include "terrane/render/frame_uniforms.glsl"
#include "terrane/shared/hash.h"

layout(binding = kSceneUnit) uniform sampler2D scene;

layout(location = 0) in vec2 inScreen;
layout(location = 0) out vec4 outColor;

// Linear up to kStart, from there an exponential shoulder that meets it with equal slope and ends at white.
vec3 compressHighlights(vec3 c) {
    const float kStart = 0.6;
    vec3 over = max(c - kStart, 0.0);
    return min(c, kStart) + (1.0 - kStart) * (1.0 - exp(-over / (1.0 - kStart)));
}

vec3 encodeSrgb(vec3 c) {
    return mix(c * 12.92, 1.055 * pow(c, vec3(1.0 / 2.4)) - 0.055, greaterThan(c, vec3(0.0031308)));
}

void main() {
    vec3 color = texelFetch(scene, ivec2(gl_FragCoord.xy), 0).rgb;
    color = encodeSrgb(clamp(compressHighlights(color * frame.zenithColor.w), 0.0, 1.0));
    uint noise = hash2(uint(gl_FragCoord.x), uint(gl_FragCoord.y), 0u);
    outColor = vec4(color + (float(noise >> 16) / 65536.0 - 0.5) / 255.0, 1.0);
}

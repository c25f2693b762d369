// Rays of the sun or moon on the screen, at half its size: how much of the sky around the light is open on the way from a
// pixel to the light (K. Mitchell, Volumetric Light Scattering as a Post-Process, 2007).
#include "terrane/render/frame_uniforms.glsl"
#include "terrane/shared/hash.h"

layout(binding = kSceneUnit) uniform sampler2D scene;

layout(location = 0) in vec2 inScreen;
layout(location = 0) out vec4 outRays;

const int kSteps = 16;

void main() {
    vec2 aspect = vec2(frame.viewportSize.x / frame.viewportSize.y, 1.0);
    vec2 toLight = frame.lightOnScreen - inScreen;
    // Steps of neighboring pixels lie between each other's; the blur of the larger image joins them.
    float offset = float(hash2(uint(gl_FragCoord.x) & 3u, uint(gl_FragCoord.y) & 3u, 9u) >> 8) / 16777216.0;
    float sum = 0.0;
    for (int k = 0; k < kSteps; ++k) {
        vec2 at = inScreen + toLight * ((float(k) + offset) / float(kSteps));
        float near = exp(-4.0 * length((frame.lightOnScreen - at) * aspect));
        vec2 inside = step(abs(at), vec2(1.0));
        float visibility = 1.0 - textureLod(scene, 0.5 + 0.5 * clamp(at, -1.0, 1.0), 0.0).a;
        sum += near * visibility * inside.x * inside.y;
    }
    float falloff = 1.0 / (1.0 + 1.5 * length(toLight * aspect));
    outRays = vec4(sum / float(kSteps) * falloff * frame.lightRayShare);
}

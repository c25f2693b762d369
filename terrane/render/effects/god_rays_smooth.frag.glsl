// Smooths rays along their direction, in which they hardly change: removes the noise of single samples and keeps the
// edges between rays.
#include "terrane/render/frame/frame_uniforms.glsl"

layout(binding = kSceneUnit) uniform sampler2D rays;

layout(location = 0) in vec2 inScreen;
layout(location = 0) out vec4 outRays;

const int kTaps = 3;  // to each side

void main() {
    vec2 size = vec2(textureSize(rays, 0)), at = 0.5 + 0.5 * inScreen;
    vec2 toLight = (frame.lightOnScreen - inScreen) * size;
    vec2 texel = toLight / max(length(toLight), 1.0) * 1.5 / size;  // nothing at the light itself
    float sum = 0.0;
    for (int k = -kTaps; k <= kTaps; ++k) sum += textureLod(rays, at + float(k) * texel, 0.0).r;
    outRays = vec4(sum / float(2 * kTaps + 1));
}

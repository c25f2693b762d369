// The mean of an image and the smaller ones below it, which are smoothed by four filtered texels.
#include "terrane/render/frame/frame_uniforms.glsl"

layout(binding = kSceneUnit) uniform sampler2D image;
layout(binding = kBloomUnit) uniform sampler2D smaller;

layout(location = 0) in vec2 inScreen;
layout(location = 0) out vec4 outLight;

const float kSmallerShare = 0.8;

void main() {
    vec2 at = 0.5 + 0.5 * inScreen, texel = 0.5 / vec2(textureSize(smaller, 0));
    vec3 sum = vec3(0.0);
    for (int k = 0; k < 4; ++k) sum += textureLod(smaller, at + (2.0 * vec2(k & 1, k >> 1) - 1.0) * texel, 0.0).rgb;
    outLight = vec4(mix(textureLod(image, at, 0.0).rgb, 0.25 * sum, kSmallerShare), 1.0);
}

// Half the size: four filtered texels, each between four of the larger image.
#include "terrane/render/frame/frame_uniforms.glsl"

layout(binding = kSceneUnit) uniform sampler2D larger;

layout(location = 0) in vec2 inScreen;
layout(location = 0) out vec4 outLight;

void main() {
    vec2 at = 0.5 + 0.5 * inScreen, texel = 1.0 / vec2(textureSize(larger, 0));
    vec3 sum = vec3(0.0);
    for (int k = 0; k < 4; ++k) sum += textureLod(larger, at + (2.0 * vec2(k & 1, k >> 1) - 1.0) * texel, 0.0).rgb;
    outLight = vec4(0.25 * sum, 1.0);
}

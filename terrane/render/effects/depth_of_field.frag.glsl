// Blurs the image for distant pixels, at half its size: Gaussian of 9 taps, σ = 2, along one axis. Taps nearer than the
// center have little weight, so that near things keep their edges. Alpha has the distance.
// AXIS: X from the scene, Y from the result of that. MSAA_SAMPLES: of the depth.
#include "terrane/render/frame/frame_uniforms.glsl"
#if AXIS == AXIS_X
#include "terrane/render/quads/gbuffer_read.glsl"
layout(binding = kSceneUnit) uniform sampler2D source;
#else
layout(binding = kDepthOfFieldUnit) uniform sampler2D source;
#endif

layout(location = 0) out vec4 outColor;

const float kWeights[5] = float[](0.2042, 0.1802, 0.1238, 0.0663, 0.0276);
const float kFarthest = 4096.0;  // blocks: the sky

vec4 tap(ivec2 pixel) {
#if AXIS == AXIS_X
    ivec2 at = clamp(2 * pixel, ivec2(0), textureSize(source, 0) - 1);
    return vec4(texelFetch(source, at, 0).rgb, min(blocksOfDepth(depthAt(at, 0)), kFarthest));
#else
    return texelFetch(source, clamp(pixel, ivec2(0), textureSize(source, 0) - 1), 0);
#endif
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy), step = AXIS == AXIS_X ? ivec2(1, 0) : ivec2(0, 1);
    vec4 middle = tap(pixel);
    vec3 sum = middle.rgb * kWeights[0];
    float weights = kWeights[0];
    for (int k = 1; k < 5; ++k) {
        for (int side = -1; side <= 1; side += 2) {
            vec4 other = tap(pixel + side * k * step);
            float weight = kWeights[k] * smoothstep(0.4, 0.8, other.a / middle.a);
            sum += weight * other.rgb;
            weights += weight;
        }
    }
    outColor = vec4(sum / weights, middle.a);
}

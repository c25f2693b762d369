// Blurs the ambient occlusion along one axis: Gaussian of 9 taps, σ = 3, over pixels at a similar distance.
// AXIS: which one. MSAA_SAMPLES: of the depth. NEAREST_LAYER: as in ambient_occlusion.frag.glsl.
#include "terrane/render/frame/frame_uniforms.glsl"
#include "terrane/render/quads/gbuffer_read.glsl"
#include "terrane/render/frame/nearest_depth.glsl"

layout(binding = kOcclusionUnit) uniform sampler2D source;

layout(location = 0) out vec4 outVisibility;

const float kWeights[5] = float[](0.1509, 0.1427, 0.1208, 0.0915, 0.0620);

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy), step = AXIS == AXIS_X ? ivec2(1, 0) : ivec2(0, 1), last = textureSize(source, 0) - 1;
    bool isDrawn = isDrawnAt(pixel);
    if (!isDrawn) discard;
    float middle = blocksOfDepth(nearestDepthAt(pixel));
    float sum = 0.0, weights = 0.0;
    // Beyond kOcclusionReach all is open. Software renderers continue after a discard.
    int reach = isDrawn && middle <= kOcclusionReach ? 4 : 0;
    for (int k = -reach; k <= reach; ++k) {
        ivec2 at = clamp(pixel + k * step, ivec2(0), last);
        float difference = abs(blocksOfDepth(nearestDepthAt(at)) - middle);
        float weight = kWeights[abs(k)] * clamp(1.0 - difference / (0.5 + 0.02 * middle), 0.001, 1.0);
        sum += weight * texelFetch(source, at, 0).r;
        weights += weight;
    }
    outVisibility = vec4(sum / weights);
}

// A sample of the G-buffer that is farther away than all four neighbors is a hole between quads: it gets the farthest
// neighbor, which overlaps least. MSAA_SAMPLES: of the G-buffer; each sample fills its own holes.
#include "terrane/render/frame/frame_uniforms.glsl"
#include "terrane/render/quads/gbuffer_read.glsl"

layout(location = 0) out vec4 outSurface;

// Larger than the depth differences within a pixel where surfaces meet in a corner.
const float kFarther = 0.99;

const ivec2 kBeside[4] = ivec2[](ivec2(-1, 0), ivec2(1, 0), ivec2(0, -1), ivec2(0, 1));

void main() {
#if MSAA_SAMPLES > 1
    int number = gl_SampleID;
#else
    int number = 0;
#endif
    ivec2 pixel = ivec2(gl_FragCoord.xy), last = ivec2(frame.viewportSize) - 1, from = pixel;
    float farthest = 2.0;  // depths are reversed
    for (int k = 0; k < 4; ++k) {
        ivec2 at = clamp(pixel + kBeside[k], ivec2(0), last);
        float depth = depthAt(at, number);
        if (depth >= farthest) continue;
        farthest = depth;
        from = at;
    }
    if (depthAt(pixel, number) >= kFarther * farthest) discard;
    outSurface = packedSurfaceAt(from, number);
    gl_FragDepth = farthest;
}

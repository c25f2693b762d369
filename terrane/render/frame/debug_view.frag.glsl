// Shows the content of the G-buffer. MSAA_SAMPLES: of the G-buffer.
#include "terrane/render/frame/frame_uniforms.glsl"
#include "terrane/render/shading/light_sample.glsl"
#include "terrane/render/quads/gbuffer_read.glsl"
#define LAND 0
#define FAR 0
#include "terrane/render/shading/lighting.glsl"

layout(location = 1) in vec3 inRay;
layout(location = 0) out vec4 outColor;

vec3 lightView(vec3 position, Surface s) {
    vec4 levels = levelsAt(position, s);
    return max(levels.rgb, levels.a * vec3(0.85, 0.8, 0.65));
}

vec3 viewOf(vec4 packedSurface, float depth) {
    if (packedDirection(packedSurface) == kDirectionNone) return vec3(0.0);
    Surface s = unpackSurface(packedSurface);
    vec3 toPoint = inRay * blocksOfDepth(depth);
    uint view = frame.view;
    if (view == kViewMerging) return packedSurface.rgb;
    if (view == kViewNormal) return 0.5 + 0.5 * s.normal;
    if (view == kViewLight) return lightView(frame.cameraPosition.xyz + toPoint, s);
    return vec3(1.0 - clamp(length(toPoint) / frame.fogDistance, 0.0, 1.0));
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec3 sum = vec3(0.0);
    for (int k = 0; k < MSAA_SAMPLES; ++k) sum += viewOf(packedSurfaceAt(pixel, k), depthAt(pixel, k));
    outColor = vec4(sum / float(MSAA_SAMPLES), 1.0);
}

// Ambient visibility of a surface from screen-space depth: 1 open, 0 occluded. Two to eight points on a spiral in the
// hemisphere over the surface, fewer with distance, rotated differently in each of 4 × 4 pixels.
// MSAA_SAMPLES: of the G-buffer, whose first sample is used. NEAREST_LAYER: 1 for the nearest blended surface; pixels
// without one stay as they are.
#include "terrane/render/frame/frame_uniforms.glsl"
#include "terrane/render/quads/gbuffer_read.glsl"
#include "terrane/render/shading/packed_layer.glsl"
#include "terrane/render/frame/nearest_depth.glsl"
#include "terrane/shared/hash.h"

layout(location = 1) in vec3 inRay;
layout(location = 0) out vec4 outVisibility;

const float kRadius = 0.9;  // blocks

float occlusionAt(vec3 position, float bias) {
    vec4 clip = frame.viewProjection * vec4(position, 1.0);
    if (clip.w <= frame.nearPlane) return 0.0;
    vec2 screen = 0.5 + 0.5 * clip.xy / clip.w;
    if (screen != clamp(screen, 0.0, 1.0)) return 0.0;
    float seen = blocksOfDepth(nearestDepthAt(ivec2(screen * frame.viewportSize)));
    float inFront = clip.w - seen;
    // Surfaces far in front of the point do not occlude it.
    return inFront > bias ? clamp(1.0 - (inFront - kRadius) / kRadius, 0.0, 1.0) : 0.0;
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    bool isDrawn = isDrawnAt(pixel);
    if (!isDrawn) discard;
    float blocks = blocksOfDepth(nearestDepthAt(pixel));
    outVisibility = vec4(1.0);
#if NEAREST_LAYER == 1
    Surface surface = unpackLayer(texelFetch(nearestLayer, pixel, 0)).surface;
#else
    Surface surface = unpackSurface(packedSurfaceAt(pixel, 0));
#endif
    if (surface.direction == kDirectionNone || blocks > kOcclusionReach) return;
    vec3 normal = surface.normal;
    vec3 position = frame.cameraPosition.xyz + inRay * blocks;
    vec3 tangent = abs(normal.z) > 0.5 ? vec3(1.0, 0.0, 0.0) : vec3(0.0, 0.0, 1.0), side = cross(normal, tangent);
    float turn = float(hash2(uint(pixel.x) & 3u, uint(pixel.y) & 3u, 3u) >> 8) / 16777216.0;
    int count = isDrawn ? int(clamp(8.0 - 6.0 * blocks / 64.0, 2.0, 8.0)) : 0;  // as in occlusion_blur.frag.glsl
    float bias = 0.02 + 0.004 * blocks, occluded = 0.0;
    for (int k = 0; k < count; ++k) {
        float way = (float(k) + 0.5) / float(count), angle = 6.2831853 * (turn + 2.0 * way);
        vec3 offset = normalize(normal * (0.35 + 0.5 * way) + cos(angle) * tangent + sin(angle) * side);
        occluded += occlusionAt(position + offset * kRadius * (0.25 + 0.75 * way), bias);
    }
    outVisibility = vec4(1.0 - 0.85 * occluded / float(max(count, 1)));
}

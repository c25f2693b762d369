// The sky without disc, stars and clouds at the points of a grid over the screen, at depth 0: infinitely far. It is
// smooth between them. UNDER_WATER: 1 if the camera is.
#include "terrane/render/frame/frame_uniforms.glsl"
#include "terrane/render/sky/sky_color.glsl"
#include "terrane/render/frame/tone.glsl"
#include "terrane/shared/constants.h"

layout(location = 0) out vec3 outColor;

void main() {
    const uint kCellCorners = 0xDA4u;  // of two triangles, two bits each: 0, 1, 2, 2, 1, 3
    uint cell = uint(gl_VertexID) / 6u, corner = kCellCorners >> 2u * (uint(gl_VertexID) % 6u) & 3u;
    uvec2 at = uvec2(cell % kSkyGridColumns + (corner & 1u), cell / kSkyGridColumns + (corner >> 1u));
    vec2 screen = 2.0 * vec2(at) / vec2(kSkyGridColumns, kSkyGridRows) - 1.0;
    vec3 direction = normalize(rayAt(screen)), color = skyColor(direction);
#if UNDER_WATER == 1
    color = throughWindow(color, direction);
#endif
    outColor = displayColor(color);
    gl_Position = vec4(screen, 0.0, 1.0);
}

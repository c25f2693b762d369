// Conservative edge expansion covers the cracks between quads. If a corner of one quad lies on the edge of another, the
// rasterizer moves the corner to its grid of sub-pixels but not the edge with it, and a sample between the two shows
// the background. So every edge moves outward by the largest error that OpenGL allows (edge_expansion.cpp), far less
// than a pixel: neighbors overlap, and silhouettes stay where they are.

#include "terrane/shared/constants.h"

// Screen direction from a point toward another, which may lie behind the camera: the derivative of the projection.
vec2 screenDirection(vec4 from, vec4 to, vec2 halfViewport) {
    vec2 toward = (to.xy * from.w - from.xy * to.w) * halfViewport;
    float size = length(toward);
    return size > 0.0 ? toward / size : vec2(0.0);
}

// A corner in clip space moved so that the edges toward the neighboring corners move outward by `growth`
// pixels; the edge toward neighborU stays if `growsV` is 0. Depth stays. Corners behind the camera stay too:
// the clipped edge grows at least as much as its other end.
vec4 expandEdges(vec4 corner, vec4 neighborU, vec4 neighborV, vec2 viewport, float growth, float growsV) {
    if (corner.w <= 0.0) return corner;
    vec2 halfViewport = 0.5 * viewport;
    vec2 u = screenDirection(corner, neighborU, halfViewport),
         v = screenDirection(corner, neighborV, halfViewport);
    float sine = abs(u.x * v.y - u.y * v.x);
    vec2 outward = -(u + growsV * v) / max(sine, 1.0 / kLongestMiter);
    corner.xy += outward * growth / halfViewport * corner.w;
    return corner;
}

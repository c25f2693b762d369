// Quads for vertex shaders. A quad has four vertices, counted from 0 in each draw; its base
// instance selects its record. PASS: see shared/variants.h. Needs frame_uniforms.glsl.
#include "terrane/render/frame/edge_expansion.glsl"
#include "terrane/render/quads/waves.glsl"
#include "terrane/shared/quad.h"
#include "terrane/shared/mesh_section.h"
#include "terrane/shared/shape_face.h"
#include "terrane/render/quads/shape_tables.glsl"

layout(binding = kQuadsUnit) uniform usamplerBuffer quads;

layout(location = kDrawRecordAttribute) in ivec4 drawRecord;  // DrawRecord

#if PASS == PASS_SURFACES || PASS == PASS_CORNERS
layout(binding = kListedQuadsUnit) uniform usamplerBuffer listedQuads;
#endif

// Number of a quad in the arena, counted from the first of the draw, or from a list of those to draw.
int quadNumberOf(int vertex) {
    int number = drawRecord.w + (vertex >> 2);
#if PASS == PASS_SURFACES || PASS == PASS_CORNERS
    int place = number - int(kFirstListedQuad);
    if (place >= 0) number = int(texelFetch(listedQuads, place).r);
#endif
    return number;
}

Quad quadOf(int number) {
    uvec2 words = texelFetch(quads, number).rg;
    return Quad(words.x, words.y);
}

// Height of a corner on the surface of a liquid, as a share of the surface's height; 0 if it is not on it.
float surfaceShare(ShapeFace face, vec2 corner) {
    return surfaceShareOf(corner.y == 1.0 ? face.axisV : face.base);
}

struct QuadCorner {
    int number;  // of the quad, in its arena
    Quad quad;
    MaterialRecord material;
    ShapeFace face;
    ivec2 chunk;
    uint level;
    vec4 cell;            // the quad's lowest block in the chunk
    vec2 corner, extent;  // 0 or 1 along u and v; cells
    vec3 cellBlocks;      // size of a cell
    vec3 inChunk;         // place, at rest
};

QuadCorner pulledCorner(int vertex) {
    QuadCorner q;
    q.number = quadNumberOf(vertex);
    q.quad = quadOf(q.number);
    q.corner = vec2(vertex & 1, (vertex >> 1) & 1);
    q.extent = vec2(quadExtentU(q.quad), quadExtentV(q.quad));
    uint place = uint(drawRecord.z);
    q.cell = vec4(quadX(q.quad), quadY(q.quad), int(quadZ(q.quad)) + placeBase(place), 0.0);
    q.material = materialOf(quadMaterial(q.quad));
    q.face = shapeFaceOf(quadShapeFace(q.quad), q.material);
    q.chunk = drawRecord.xy;
    q.level = placeLevel(place);
    q.cellBlocks = vec3(vec2(columnBlocks(q.level)), 1.0);
    q.inChunk = q.cellBlocks * shapeFaceCorner(q.face, q.cell, q.corner, q.extent).xyz;
    return q;
}

// Place in the chunk, with the waves of plants and water.
vec3 wavedInChunk(QuadCorner q) {
    if ((frame.switches & kSwitchAnimation) == 0 || q.level > 0u) return q.inChunk;
    return q.inChunk + waveOffset(q.material, surfaceShare(q.face, q.corner), q.chunk, q.cell.xyz, q.inChunk, q.corner.y,
                                  frame.timeSeconds);
}

// Corner in clip space at a position, moved outward a little. Not for blended quads, whose overlap would be visible.
vec4 grownCorner(QuadCorner q, vec3 position) {
    // Depth offset of the sides of tiles for the depth test, in columns. Behind them is solid ground.
    const float kTileSideDepth = 0.25;
    vec4 clip = frame.viewProjection * vec4(position, 1.0);
    vec2 inward = (1.0 - 2.0 * q.corner) * q.extent;
    vec3 axisU = q.face.axisU.xyz + q.face.bend.xyz * q.corner.y, axisV = q.face.axisV.xyz + q.face.bend.xyz * q.corner.x;
    vec4 alongU = frame.viewProjection * vec4(q.cellBlocks * axisU * inward.x, 0.0);
    vec4 alongV = frame.viewProjection * vec4(q.cellBlocks * axisV * inward.y, 0.0);
    // A tile has sides under all of its border. Where the adjacent land is as high, dots of the sides would show. So
    // they do not grow beyond the top, whose own growth covers the edge, and have a larger depth than faces at the same
    // place.
    bool isTileSide = q.level > 0u && q.face.axisV.z > 0.0;
    float growsV = isTileSide && q.corner.y > 0.0 ? 0.0 : 1.0;
    clip = expandEdges(clip, clip + alongU, clip + alongV, frame.viewportSize, frame.edgeExpansion, growsV);
    if (isTileSide) clip.z *= clip.w / (clip.w + kTileSideDepth * columnBlocks(q.level));
    return clip;
}

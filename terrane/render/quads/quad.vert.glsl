// PASS, ALPHA_CLASS: see shared/variants.h. FACE_SAMPLING: see block_texture.glsl. TINT: see block_tint.glsl.
// Pulls a quad's corner from the quad buffer. A quad has four vertices, counted from 0 in each draw; its base instance
// selects its record.
#include "terrane/render/frame/edge_expansion.glsl"
#include "terrane/render/frame/frame_uniforms.glsl"
#include "terrane/render/quads/waves.glsl"
#include "terrane/shared/hash.h"
#include "terrane/shared/quad.h"
#include "terrane/shared/mesh_section.h"
#include "terrane/shared/shape_face.h"
#if PASS == PASS_SHADOWS
#include "terrane/shared/shadow.h"

layout(std140, binding = kShadowDrawBinding) uniform ShadowDrawBlock {
    ShadowDraw shadowDraw;
};

// Shadows of waving leaves and plants do not move: their casters are this many blocks farther from the light than at
// rest, so that a plant never shades itself.
const float kWaveSink = 0.14;
#endif

layout(binding = kQuadsUnit) uniform usamplerBuffer quads;
layout(binding = kShapeFacesUnit) uniform samplerBuffer shapeFaces;  // four texels a face
layout(binding = kMaterialsUnit) uniform usamplerBuffer materials;

layout(location = kDrawRecordAttribute) in ivec4 drawRecord;  // DrawRecord

#if PASS == PASS_SURFACES || PASS == PASS_CORNERS
layout(binding = kListedQuadsUnit) uniform usamplerBuffer listedQuads;
#endif

// Layers are peeled by comparing depths of two programs.
invariant gl_Position;

// Faces of a liquid are this many blocks inside of it: those against glass would share a plane with the glass, and
// which of the two is nearer would change from pixel to pixel.
const float kLiquidInset = 1.0 / 1024.0;

// Depth offset of the sides of tiles for the depth test, in columns. Behind them is solid ground.
const float kTileSideDepth = 0.25;

#if PASS != PASS_CORNERS
layout(location = 0) out vec2 outTexel;        // in textures; row 0 of the image is at integer v
layout(location = 1) flat out uvec2 outFace;   // see packed_face.glsl; a number of the quad's own
#if FACE_SAMPLING == 1
layout(location = 2) flat out uint outSampling;
#endif
#endif
#if TINT == 1
#include "terrane/render/quads/tint_place.glsl"
#endif
#include "terrane/render/quads/packed_face.glsl"
#if PASS == PASS_CORNERS
#include "terrane/render/corners/quad_corner.glsl"
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

// Only faces of models have a bend: others do without the fourth read. The surface of a liquid is as high as its
// material says, and lower where it flows.
ShapeFace shapeFaceOf(Quad quad, MaterialRecord material) {
    uint number = quadShapeFace(quad);
    int first = 4 * int(number);
    ShapeFace face = ShapeFace(texelFetch(shapeFaces, first), texelFetch(shapeFaces, first + 1),
                               texelFetch(shapeFaces, first + 2), flatBend());
    if (number >= kShapeFaceCount) face.bend = texelFetch(shapeFaces, first + 3);
    float low = face.base.z, high = low + face.axisV.z;
    float lowShare = surfaceShareOf(face.base), highShare = surfaceShareOf(face.axisV);
    if (lowShare > 0.0) low = lowShare * optionsSurfaceHeight(material.options);
    if (highShare > 0.0) high = highShare * optionsSurfaceHeight(material.options);
    if (lowShare + highShare > 0.0) {
        face.base.z = low;
        face.axisV.z = high - low;
    }
    return face;
}

// Height of a corner on the surface of a liquid, as a share of the surface's height; 0 if it is not on it.
float surfaceShare(ShapeFace face, vec2 corner) {
    return surfaceShareOf(corner.y == 1.0 ? face.axisV : face.base);
}

// Texture coordinates in the quad, 0 to 1. The side of a flowing liquid shows the part of the texture at its height,
// which the material decides.
vec2 texelOf(Quad quad, ShapeFace face, vec2 corner) {
    vec2 texel = shapeFaceTexel(face, corner);
    uint number = quadShapeFace(quad);
    if (number >= kShapeFaceFlowSide && number < kShapeFaceCount) texel.y = 1.0 - (face.base.z + face.axisV.z * corner.y);
    return texel;
}

MaterialRecord materialOf(Quad quad) {
    uvec4 words = texelFetch(materials, int(quadMaterial(quad)));
    return MaterialRecord(words.x, words.y, words.z, words.w);
}

void main() {
    int number = quadNumberOf(gl_VertexID);
    Quad quad = quadOf(number);
    vec2 corner = vec2(gl_VertexID & 1, (gl_VertexID >> 1) & 1);
    vec2 extent = vec2(quadExtentU(quad), quadExtentV(quad));
    uint place = uint(drawRecord.z);
    vec4 cell = vec4(quadX(quad), quadY(quad), int(quadZ(quad)) + placeBase(place), 0.0);
    MaterialRecord material = materialOf(quad);
    ShapeFace face = shapeFaceOf(quad, material);
    ivec2 chunk = drawRecord.xy;
    uint level = placeLevel(place);
    vec3 cellBlocks = vec3(vec2(columnBlocks(level)), 1.0);
    vec3 inChunk = cellBlocks * shapeFaceCorner(face, cell, corner, extent).xyz;
#if PASS == PASS_SHADOWS
    uint animation = lookAnimation(material.look);
    if (ALPHA_CLASS == ALPHA_TESTED && level == 0u && (animation == kAnimationTopWaves || animation == kAnimationWholeWaves))
        inChunk -= kWaveSink * shadowDraw.toLight.xyz;
    vec3 position = inChunk + vec3(chunkCorner(chunk, level, shadowDraw.anchorChunk), 0.0);
    gl_Position = shadowDraw.toClip * vec4(position, 1.0);
#else
    if ((frame.switches & kSwitchAnimation) != 0 && level == 0u) {
        inChunk += waveOffset(material, surfaceShare(face, corner), chunk, cell.xyz, inChunk, corner.y, frame.timeSeconds);
    }
#if PASS == PASS_LAYERS
    if (lookAnimation(material.look) == kAnimationLiquidSurface) inChunk -= kLiquidInset * normalOf(faceDirectionOf(face));
#endif
    vec3 position = inChunk + vec3(chunkCorner(chunk, level, frame.cameraChunk), 0.0);
    gl_Position = frame.viewProjection * vec4(position, 1.0);
#endif
#if PASS == PASS_SURFACES || (PASS == PASS_CORNERS && ALPHA_CLASS != ALPHA_BLENDED)
    // Not for blended quads, whose overlap would be visible.
    vec2 inward = (1.0 - 2.0 * corner) * extent;
    vec3 axisU = face.axisU.xyz + face.bend.xyz * corner.y, axisV = face.axisV.xyz + face.bend.xyz * corner.x;
    vec4 alongU = frame.viewProjection * vec4(cellBlocks * axisU * inward.x, 0.0);
    vec4 alongV = frame.viewProjection * vec4(cellBlocks * axisV * inward.y, 0.0);
    // A tile has sides under all of its border. Where the adjacent land is as high, dots of the sides would show. So
    // they do not grow beyond the top, whose own growth covers the edge, and have a larger depth than faces at the same
    // place.
    bool isTileSide = level > 0u && face.axisV.z > 0.0;
    float growsV = isTileSide && corner.y > 0.0 ? 0.0 : 1.0;
    gl_Position = expandEdges(gl_Position, gl_Position + alongU, gl_Position + alongV, frame.viewportSize,
                              frame.edgeExpansion, growsV);
    if (isTileSide) gl_Position.z *= gl_Position.w / (gl_Position.w + kTileSideDepth * columnBlocks(level));
#endif
    uint packedFace = packFace(quad, material, level, faceDirectionOf(face));
    vec2 texel = texelOf(quad, face, corner) * extentOf(packedFace);
#if TINT == 1
    setTintPlace(cellBlocks.xy * cell.xy + chunkCorner(chunk, level, frame.cameraChunk), position.xy);
#endif
#if PASS == PASS_CORNERS
    shadeCorner(number, uint(gl_VertexID & 3), packedFace, material, texel, position - frame.cameraPosition.xyz);
#else
    uint seed = hash2(uint(chunk.x), uint(chunk.y), quadMaterial(quad));
    outFace = uvec2(packedFace, quad.word0 ^ seed);
#if FACE_SAMPLING == 1
    outSampling = optionsSampling(material.options);
#endif
    outTexel = texel;
#endif
}

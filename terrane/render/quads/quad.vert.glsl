// Places a quad's corner, for shading later or for shadows. PASS, ALPHA_CLASS: see shared/variants.h. FACE_SAMPLING: see
// block_texture.glsl. TINT: see block_tint.glsl.
#include "terrane/render/frame/frame_uniforms.glsl"
#include "terrane/render/quads/quad_pull.glsl"
#include "terrane/shared/hash.h"
#if PASS == PASS_SHADOWS
#include "terrane/shared/shadow.h"

layout(std140, binding = kShadowDrawBinding) uniform ShadowDrawBlock {
    ShadowDraw shadowDraw;
};

// Shadows of waving leaves and plants do not move: their casters are this many blocks farther from the light than at
// rest, so that a plant never shades itself.
const float kWaveSink = 0.14;
#endif

// Layers are peeled by comparing depths of two programs.
invariant gl_Position;

layout(location = 0) out vec2 outTexel;        // in textures; row 0 of the image is at integer v
layout(location = 1) flat out uvec2 outFace;   // see packed_face.glsl; a number of the quad's own
#if FACE_SAMPLING == 1
layout(location = 2) flat out uint outSampling;
#endif
#if TINT == 1
#include "terrane/render/quads/tint_place.glsl"
#endif

void main() {
    QuadCorner q = pulledCorner(gl_VertexID);
    uint animation = lookAnimation(q.material.look);
#if PASS == PASS_SHADOWS
    vec3 inChunk = q.inChunk;
    if (ALPHA_CLASS == ALPHA_TESTED && q.level == 0u && (animation == kAnimationTopWaves || animation == kAnimationWholeWaves))
        inChunk -= kWaveSink * shadowDraw.toLight.xyz;
    vec3 position = inChunk + vec3(chunkCorner(q.chunk, q.level, shadowDraw.anchorChunk), 0.0);
    gl_Position = shadowDraw.toClip * vec4(position, 1.0);
#else
    vec3 inChunk = wavedInChunk(q);
#if PASS == PASS_LAYERS
    if (animation == kAnimationLiquidSurface) inChunk -= kLiquidInset * normalOf(faceDirectionOf(q.face));
#endif
    vec3 position = inChunk + vec3(chunkCorner(q.chunk, q.level, frame.cameraChunk), 0.0);
#if PASS == PASS_SURFACES
    gl_Position = grownCorner(q, position);
#else
    gl_Position = frame.viewProjection * vec4(position, 1.0);
#endif
#endif
    uint seed = hash2(uint(q.chunk.x), uint(q.chunk.y), quadMaterial(q.quad));
    outFace = uvec2(packFace(q.quad, q.material, q.level, faceDirectionOf(q.face)), q.quad.word0 ^ seed);
#if FACE_SAMPLING == 1
    outSampling = optionsSampling(q.material.options);
#endif
#if TINT == 1
    setTintPlace(q.cellBlocks.xy * q.cell.xy + chunkCorner(q.chunk, q.level, frame.cameraChunk), position.xy);
#endif
    outTexel = texelOf(quadShapeFace(q.quad), q.face, q.corner) * extentOf(outFace.x);
}

// ALPHA_CLASS: 0 opaque, 1 tested, 2 blended.
// Pulls a quad's corner from the quad buffer. Four vertices a quad; the base vertex of a draw is four times its first
// quad, its base instance the number of its draw record.
#include "terrane/render/crack_cover.glsl"
#include "terrane/render/frame_uniforms.glsl"
#include "terrane/shared/hash.h"
#include "terrane/shared/quad.h"
#include "terrane/shared/shape_face.h"

layout(std430, binding = kQuadsBinding) readonly buffer Quads {
    Quad quads[];
};
layout(std430, binding = kShapeFacesBinding) readonly buffer ShapeFaces {
    ShapeFace shapeFaces[];
};
layout(std430, binding = kMaterialsBinding) readonly buffer Materials {
    MaterialRecord materials[];
};
layout(std430, binding = kDrawsBinding) readonly buffer Draws {
    DrawRecord draws[];
};

layout(location = 0) out vec3 outPosition;  // in blocks, from the corner of the camera's chunk
layout(location = 1) out vec2 outTexel;     // in textures; row 0 of the image is at integer v
layout(location = 2) flat out vec3 outNormal;
layout(location = 3) flat out uvec4 outMaterial;  // texture, alpha mode, animation; number of the quad
layout(location = 4) flat out uint outIsOblique;
layout(location = 5) flat out vec2 outExtent;  // of outTexel

void main() {
    Quad quad = quads[gl_VertexID >> 2];
    vec2 corner = vec2(gl_VertexID & 1, (gl_VertexID >> 1) & 1);
    vec2 extent = vec2(quadExtentU(quad), quadExtentV(quad));
    vec4 cell = vec4(quadX(quad), quadY(quad), quadZ(quad), 0.0);
    ShapeFace face = shapeFaces[quadShapeFace(quad)];
    vec4 origin = draws[gl_BaseInstanceARB].origin;
    outPosition = (origin + shapeFaceCorner(face, cell, corner, extent)).xyz;
    gl_Position = frame.viewProjection * vec4(outPosition, 1.0);
#if ALPHA_CLASS < 2
    // Blended quads would show their overlap.
    vec2 inward = (1.0 - 2.0 * corner) * extent;
    vec4 alongU = frame.viewProjection * vec4(face.axisU.xyz * inward.x, 0.0);
    vec4 alongV = frame.viewProjection * vec4(face.axisV.xyz * inward.y, 0.0);
    gl_Position = coverCracks(gl_Position, gl_Position + alongU, gl_Position + alongV, frame.viewport.xy, frame.viewport.z);
#endif

    MaterialRecord material = materials[quadMaterial(quad)];
    outTexel = vec2(corner.x, 1.0 - corner.y) * extent;
    outExtent = extent;
    outNormal = face.normal.xyz;
    uint number = hash3(quad.word0, quad.word1, uint(origin.w), 0u);
    outMaterial = uvec4(material.texture, material.alphaMode, material.animation, number);
    outIsOblique = quadShapeFace(quad) >= kShapeFaceCross && quadShapeFace(quad) < kShapeFaceInset ? 1u : 0u;
}

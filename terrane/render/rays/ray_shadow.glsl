// Share of the sun's or moon's light that no block stops: one ray toward it. Needs frame_uniforms.glsl.
#include "terrane/render/quads/shape_tables.glsl"
#include "terrane/render/quads/block_texture.glsl"
#define RAY_LAYER RAY_SURFACES
#include "terrane/render/rays/ray_surfaces.glsl"

// Holes are those of the texture itself: a shadow has no pixels of its own.
float alphaOf(FaceLook look) {
    return nearestTexel(look.packedFace, look.texel, 0).a;
}

// Rays begin so many blocks off a surface, and further from far ones, whose place is known from their depth; and what
// is nearer does not shade: a plant would shade itself.
const float kShadowOffset = 1.0 / 128.0, kShadowOffsetFar = 1.0 / 8192.0;

// Faces that face away from the light are dark anyway.
float lightShare(vec3 position, vec3 normal, float distance, float landShare) {
    if (dot(normal, frame.lightDirection.xyz) <= 0.0) return 1.0;
    float offset = kShadowOffset + kShadowOffsetFar * distance;
    rayAcrossPixel = rayUpPixel = vec3(0.0);
    rayLeastT = 2.0 * offset;
    return findSurface(rayFrom(position + offset * normal, frame.lightDirection.xyz, kEndOfRays)) ? 0.0 : 1.0;
}

// The tables of shapes and materials. Needs frame_uniforms.glsl.
#include "terrane/shared/quad.h"
#include "terrane/shared/shape_face.h"
#include "terrane/render/quads/packed_face.glsl"

layout(binding = kShapeFacesUnit) uniform samplerBuffer shapeFaces;  // four texels a face
layout(binding = kMaterialsUnit) uniform usamplerBuffer materials;

// Faces of a liquid are this many blocks inside of it: those against glass would share a plane with the glass, and
// which of the two is nearer would change from pixel to pixel.
const float kLiquidInset = 1.0 / 1024.0;

// Only faces of models have a bend: others do without the fourth read. The surface of a liquid is as high as its
// material says, and lower where it flows.
ShapeFace shapeFaceOf(uint number, MaterialRecord material) {
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

// Texture coordinates in the quad, 0 to 1. The side of a flowing liquid shows the part of the texture at its height,
// which the material decides.
vec2 texelOf(uint number, ShapeFace face, vec2 corner) {
    vec2 texel = shapeFaceTexel(face, corner);
    if (number >= kShapeFaceFlowSide && number < kShapeFaceCount) texel.y = 1.0 - (face.base.z + face.axisV.z * corner.y);
    return texel;
}

MaterialRecord materialOf(uint number) {
    uvec4 words = texelFetch(materials, int(number));
    return MaterialRecord(words.x, words.y, words.z, words.w);
}

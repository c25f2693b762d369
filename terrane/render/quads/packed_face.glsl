// Data of a quad for its fragments, packed into 32 bits: bits 0–11 texture, 12–14 alpha mode, 15–17 direction, 18
// surface of a liquid, 19–22 and 23–26 extents in columns less one, 27–30 level, 31 tinted. Needs quad.h, shape_face.h,
// frame.h.
#include "terrane/shared/material.h"
#include "terrane/shared/mesh_section.h"
#include "terrane/render/quads/packed_gbuffer.glsl"

uint packFace(Quad quad, MaterialRecord material, uint level, uint direction) {
    uint isLiquid = lookAnimation(material.look) == kAnimationLiquidSurface ? 1u : 0u;
    return (material.look & 0x7FFFu) | direction << 15 | isLiquid << 18 |
           (quadExtentU(quad) - 1u) << 19 | (quadExtentV(quad) - 1u) << 23 | level << 27 |
           optionsTinted(material.options) << 31;
}

uint directionOfFace(uint face) {
    return face >> 15 & 7u;
}

uint alphaModeOf(uint face) {
    return face >> 12 & 7u;
}

bool isTinted(uint face) {
    return (face >> 31) != 0u;
}

bool isFarFace(uint face) {
    return (face >> 27 & 15u) != 0u;
}

// Extents in blocks: a texture covers one block at every level. Heights of columns are those of blocks.
vec2 extentOf(uint face) {
    vec2 columns = vec2((face >> 19 & 15u) + 1u, (face >> 23 & 15u) + 1u);
    float width = columnBlocks(face >> 27 & 15u);
    bool isLevel = directionOfFace(face) >> 1 == 2u;
    return columns * vec2(width, isLevel ? width : 1.0);
}

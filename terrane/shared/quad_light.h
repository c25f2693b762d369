// The light at the corners of a quad, for Shading::Corners: four light values (light/chunk_light.h), 16 bits
// each, of corners 0, 1 and of corners 2, 3 (shape_face.h).
#ifndef TERRANE_SHARED_QUAD_LIGHT_H
#define TERRANE_SHARED_QUAD_LIGHT_H

#include "terrane/shared/language.h"

SHARED_BEGIN

struct QuadLight {
    uint corners01;
    uint corners23;
};

// Red in bits 0–3, green 4–7, blue 8–11, daylight 12–15.
SHARED_FN uint lightOfCorner(QuadLight light, uint corner) {
    uint two = corner < 2u ? light.corners01 : light.corners23;
    return (two >> (16u * (corner & 1u))) & 65535u;
}

SHARED_END

#ifdef __cplusplus
namespace terrane::shared {
static_assert(sizeof(QuadLight) == 8);
}  // namespace terrane::shared
#endif
#endif

// The 8-byte record of one textured rectangle (a quad), written by the mesher and read by the vertex shader.
//
//   word 0, bits  0–3   x of the quad's lowest block in its chunk
//                 4–7   y
//                 8–15  z in its slab of 256 layers; the quad's mesh section says which (mesh_section.h)
//                 16–23 shape face, its low bits: index into the table of mesh/shape_faces.h
//                 24–27 extent along the face's u axis, minus one (1…16 blocks)
//                 28–31 extent along the face's v axis, minus one
//   word 1, bits  0–15  material: index into the material table (texture, animation, …)
//                 16–18 shape face, its high bits
//                 19–29 zero
//                 30    zero from the mesher; on the GPU: the quad could be seen when it was tested last
//                 31    zero from the mesher; on the GPU: it can be seen and is not drawn yet in this frame
#ifndef TERRANE_SHARED_QUAD_H
#define TERRANE_SHARED_QUAD_H

#include "terrane/shared/language.h"

SHARED_BEGIN

const uint kQuadBytes = 8u;

// Layers of a slab. Slab n has layers 256 n … 256 n + 255; no mesh section is in two of them.
const uint kQuadSlab = 256u;

// Bits of word 1: see render/cull/cull_pass.h.
const uint kQuadSeen = 1u << 30;
const uint kQuadNew = 1u << 31;

struct Quad {
    uint word0;
    uint word1;
};

SHARED_FN uint quadX(Quad q) {
    return q.word0 & 15u;
}
SHARED_FN uint quadY(Quad q) {
    return (q.word0 >> 4) & 15u;
}
SHARED_FN uint quadZ(Quad q) {
    return (q.word0 >> 8) & 255u;
}
SHARED_FN uint quadShapeFace(Quad q) {
    return ((q.word0 >> 16) & 255u) | ((q.word1 >> 8) & 0x700u);
}
SHARED_FN uint quadExtentU(Quad q) {
    return ((q.word0 >> 24) & 15u) + 1u;
}
SHARED_FN uint quadExtentV(Quad q) {
    return (q.word0 >> 28) + 1u;
}
SHARED_FN uint quadMaterial(Quad q) {
    return q.word1 & 65535u;
}

SHARED_END

#ifdef __cplusplus
namespace terrane::shared {

static_assert(sizeof(Quad) == kQuadBytes);

struct QuadFields {
    uint x, y, z;                   // lowest block of the quad, in the chunk and the slab
    uint shapeFace;                 // 0…2047
    uint extentU = 1, extentV = 1;  // 1…16 blocks
    uint material = 0;              // 0…65535
};

constexpr int quadSlab(int z) {
    return z >> 8;
}
constexpr uint quadZOf(int z) {  // in its slab
    return static_cast<uint>(z) & (kQuadSlab - 1);
}

constexpr Quad packQuad(const QuadFields& f) {
    return {
        f.x | f.y << 4 | f.z << 8 | (f.shapeFace & 255) << 16 | (f.extentU - 1) << 24 | (f.extentV - 1) << 28,
        f.material | (f.shapeFace >> 8) << 16};
}

constexpr bool operator==(const Quad& a, const Quad& b) {
    return a.word0 == b.word0 && a.word1 == b.word1;
}

}  // namespace terrane::shared
#endif
#endif

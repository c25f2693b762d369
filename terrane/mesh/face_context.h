// How faces are sorted for drawing: by what a draw call needs (context) and by the direction they look to
// (group). The mesher sorts by it, the renderer draws by it. Pure functions; any thread.
#pragma once

#include <cstdint>

#include "terrane/mesh/shape_faces.h"
#include "terrane/world/block_type.h"

namespace terrane::mesh {

// What the alpha channel demands of a draw call, then whether back faces are culled: two contexts an alpha
// class.
enum class AlphaClass : std::uint8_t { Opaque, Tested, Blended };

constexpr int kContextCount = 6;
// Groups 0–5: one-sided quads that look along an axis, in the order of world::Face. From behind none can be
// seen.
constexpr int kGroupAlways = 6;  // two-sided or oblique quads: drawn wherever the camera is
constexpr int kGroupCount = 7;

constexpr AlphaClass alphaClass(world::AlphaMode alpha) {
    switch (alpha) {
        case world::AlphaMode::Test:
        case world::AlphaMode::TestGlow:
            return AlphaClass::Tested;
        case world::AlphaMode::Blend:
            return AlphaClass::Blended;
        default:
            return AlphaClass::Opaque;
    }
}

constexpr int faceContext(AlphaClass alpha, bool twoSided) {
    return 2 * static_cast<int>(alpha) + (twoSided ? 1 : 0);
}
constexpr int faceContext(const world::Material& material) {
    return faceContext(alphaClass(material.alpha), material.twoSided);
}
constexpr AlphaClass contextAlphaClass(int context) {
    return static_cast<AlphaClass>(context / 2);
}
constexpr bool contextTwoSided(int context) {
    return context % 2 == 1;
}

inline int faceGroup(shared::uint shapeFace, const world::Material& material) {
    static_assert(kGroupAlways == world::kFaceCount, "shapeFaceSide of oblique faces is the last group");
    return material.twoSided ? kGroupAlways : shapeFaceSide(shapeFace);
}

}  // namespace terrane::mesh

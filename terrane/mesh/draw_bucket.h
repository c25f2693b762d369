// Sorting of faces for drawing: by draw bucket (the needs of a draw call) and by face direction. The mesher
// and the renderer use it. All functions are pure; any thread may call them.
#pragma once

#include <cstdint>

#include "terrane/mesh/shape_faces.h"
#include "terrane/shared/variants.h"
#include "terrane/world/blocks/block_type.h"

namespace terrane::mesh {

// Needs of the alpha channel in a draw call. Each alpha class has two draw buckets: with back faces culled,
// and without.
enum class AlphaClass : std::uint8_t {
    Opaque = ALPHA_OPAQUE,
    Tested = ALPHA_TESTED,
    Blended = ALPHA_BLENDED
};

constexpr int kDrawBucketCount = 6;
// Directions 0–5: one-sided quads that face along an axis, in the order of world::Face. They are invisible
// from behind.
constexpr int kAnyDirection = 6;  // two-sided or oblique quads: drawn wherever the camera is
constexpr int kFaceDirectionCount = 7;

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

constexpr int drawBucket(AlphaClass alpha, bool twoSided) {
    return 2 * static_cast<int>(alpha) + (twoSided ? 1 : 0);
}
constexpr int drawBucket(const world::Material& material) {
    return drawBucket(alphaClass(material.alpha), material.twoSided);
}
constexpr AlphaClass bucketAlphaClass(int bucket) {
    return static_cast<AlphaClass>(bucket / 2);
}
constexpr bool bucketTwoSided(int bucket) {
    return bucket % 2 == 1;
}

inline int faceDirection(shared::uint shapeFace, const world::Material& material) {
    static_assert(kAnyDirection == world::kFaceCount, "shapeFaceSide of oblique faces is the last direction");
    return material.twoSided ? kAnyDirection : shapeFaceSide(shapeFace);
}

}  // namespace terrane::mesh

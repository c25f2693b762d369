#include "terrane/mesh/draw_bucket.h"

#include <gtest/gtest.h>

namespace terrane::mesh {
namespace {

using world::AlphaMode;
using world::Material;

TEST(DrawBucket, AlphaModesFallIntoThreeClasses) {
    EXPECT_EQ(alphaClass(AlphaMode::Unused), AlphaClass::Opaque);
    EXPECT_EQ(alphaClass(AlphaMode::Glow), AlphaClass::Opaque);
    EXPECT_EQ(alphaClass(AlphaMode::Test), AlphaClass::Tested);
    EXPECT_EQ(alphaClass(AlphaMode::TestGlow), AlphaClass::Tested);
    EXPECT_EQ(alphaClass(AlphaMode::Blend), AlphaClass::Blended);
}

TEST(DrawBucket, DrawBucketsAreNumberedWithoutGaps) {
    int expected = 0;
    for (const AlphaClass alpha : {AlphaClass::Opaque, AlphaClass::Tested, AlphaClass::Blended}) {
        for (const bool twoSided : {false, true}) {
            const int bucket = drawBucket(alpha, twoSided);
            EXPECT_EQ(bucket, expected++);
            EXPECT_EQ(bucketAlphaClass(bucket), alpha);
            EXPECT_EQ(bucketTwoSided(bucket), twoSided);
        }
    }
    EXPECT_EQ(expected, kDrawBucketCount);
}

TEST(DrawBucket, TwoSidedAndObliqueFacesAreAlwaysDrawn) {
    const Material oneSided, twoSided{.twoSided = true};
    for (shared::uint face = 0; face < shared::kShapeFaceCount; ++face) {
        EXPECT_EQ(faceDirection(face, twoSided), kAnyDirection);
        const bool oblique = face == shared::kShapeFaceCross || face == shared::kShapeFaceCross + 1;
        EXPECT_EQ(faceDirection(face, oneSided) == kAnyDirection, oblique) << face;
    }
    EXPECT_EQ(faceDirection(shared::kShapeFaceInset + 3, oneSided), world::kFacePosY);
}

}  // namespace
}  // namespace terrane::mesh

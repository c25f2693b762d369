#include "terrane/mesh/face_context.h"

#include <gtest/gtest.h>

namespace terrane::mesh {
namespace {

using world::AlphaMode;
using world::Material;

TEST(FaceContext, AlphaModesFallIntoThreeClasses) {
    EXPECT_EQ(alphaClass(AlphaMode::Unused), AlphaClass::Opaque);
    EXPECT_EQ(alphaClass(AlphaMode::Glow), AlphaClass::Opaque);
    EXPECT_EQ(alphaClass(AlphaMode::Test), AlphaClass::Tested);
    EXPECT_EQ(alphaClass(AlphaMode::TestGlow), AlphaClass::Tested);
    EXPECT_EQ(alphaClass(AlphaMode::Blend), AlphaClass::Blended);
}

TEST(FaceContext, ContextsAreNumberedWithoutGaps) {
    int expected = 0;
    for (const AlphaClass alpha : {AlphaClass::Opaque, AlphaClass::Tested, AlphaClass::Blended}) {
        for (const bool twoSided : {false, true}) {
            const int context = faceContext(alpha, twoSided);
            EXPECT_EQ(context, expected++);
            EXPECT_EQ(contextAlphaClass(context), alpha);
            EXPECT_EQ(contextTwoSided(context), twoSided);
        }
    }
    EXPECT_EQ(expected, kContextCount);
}

TEST(FaceContext, TwoSidedAndObliqueFacesAreAlwaysDrawn) {
    const Material oneSided, twoSided{.twoSided = true};
    for (shared::uint face = 0; face < shared::kShapeFaceCount; ++face) {
        EXPECT_EQ(faceGroup(face, twoSided), kGroupAlways);
        const bool oblique = face == shared::kShapeFaceCross || face == shared::kShapeFaceCross + 1;
        EXPECT_EQ(faceGroup(face, oneSided) == kGroupAlways, oblique) << face;
    }
    EXPECT_EQ(faceGroup(shared::kShapeFaceInset + 3, oneSided), world::kFacePosY);
}

}  // namespace
}  // namespace terrane::mesh

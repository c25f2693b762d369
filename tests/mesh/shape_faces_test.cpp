#include "terrane/mesh/shape_faces.h"

#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "tests/mesh/mesh_fixture.h"
#include "tests/mesh/random_blocks.h"

namespace terrane::mesh {
namespace {

using shared::ShapeFace;
using shared::vec2;
using shared::vec4;

constexpr float kEpsilon = 1e-5f;

struct Bounds {
    glm::vec3 min{1e9f}, max{-1e9f};

    void cover(vec4 p) {
        min = glm::min(min, glm::vec3(p));
        max = glm::max(max, glm::vec3(p));
    }
};

Bounds boundsOf(const ShapeFace& face, vec4 cell, vec2 extent) {
    Bounds bounds;
    for (const vec2 corner : {vec2(0, 0), vec2(1, 0), vec2(0, 1), vec2(1, 1)}) {
        bounds.cover(shapeFaceCorner(face, cell, corner, extent));
    }
    return bounds;
}

void expectNear(glm::vec3 a, glm::vec3 b) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], kEpsilon) << "axis " << i;
}

TEST(ShapeFaces, NormalsAreTheCrossProductOfTheAxes) {
    ASSERT_EQ(shapeFaces().size(), shared::kShapeFaceCount);
    for (const ShapeFace& face : shapeFaces()) {
        const glm::vec3 normal = glm::normalize(glm::cross(glm::vec3(face.axisU), glm::vec3(face.axisV)));
        expectNear(normal, normalOf(face));
    }
}

// Edges on the surface of a liquid of the usual height lie where the shares say; others have none.
TEST(ShapeFaces, SharesOfTheSurfaceFitTheHeights) {
    constexpr float kSurface = shared::kLiquidSurfaceSixteenths / 16.0f;
    std::size_t onSurface = 0;
    for (const ShapeFace& face : shapeFaces()) {
        const float low = face.base.z, high = low + face.axisV.z;
        const float lowShare = shared::surfaceShareOf(face.base),
                    highShare = shared::surfaceShareOf(face.axisV);
        if (lowShare > 0) {
            EXPECT_NEAR(lowShare * kSurface, low, kEpsilon);
        }
        if (highShare > 0) {
            EXPECT_NEAR(highShare * kSurface, high, kEpsilon);
        }
        onSurface += lowShare > 0 || highShare > 0;
    }
    EXPECT_EQ(onSurface, 8u + 4 + 4 * (45 - 1)) << "tops, sides of sources, all other sides but the full one";
}

TEST(ShapeFaces, UprightFacesStandOnTheirV) {
    for (shared::uint i = 0; i < shared::kShapeFaceCount; ++i) {
        const bool level = i == 4 || i == 5 ||
                           (i >= shared::kShapeFaceFlowTop && i < shared::kShapeFaceFlowSide) ||
                           i == shared::kShapeFaceLiquidTop;
        EXPECT_EQ(shapeFaces()[i].axisV.z > 0, !level) << i;
    }
}

// Places of the planes of each kind in the cell: for the sides of x and y the coordinate across, in table
// order.
TEST(ShapeFaces, PlanesLieWhereTheirShapeSays) {
    struct Row {
        shared::uint first;
        float negative, positive, height;
    };
    constexpr float kLow = 14.0f / 16;
    for (const Row& row : {Row{shared::kShapeFaceCube, 0, 1, 1}, Row{shared::kShapeFaceHash, 0.25f, 0.75f, 1},
                           Row{shared::kShapeFaceInset, 1 / 16.0f, 15 / 16.0f, 1},
                           Row{shared::kShapeFaceLiquidSide, 0, 1, kLow}}) {
        for (shared::uint side = 0; side < 4; ++side) {
            const int across = static_cast<int>(side / 2);
            glm::vec3 min(0), max(1, 1, row.height);
            min[across] = max[across] = side % 2 == 0 ? row.negative : row.positive;
            const Bounds bounds = boundsOf(shapeFaces()[row.first + side], vec4(0), vec2(1));
            expectNear(bounds.min, min);
            expectNear(bounds.max, max);
            EXPECT_EQ(shapeFaceSide(row.first + side), side);
        }
    }
}

TEST(ShapeFaces, LevelFaces) {
    const Bounds bottom = boundsOf(shapeFaces()[4], vec4(0), vec2(1));
    expectNear(bottom.min, {0, 0, 0});
    expectNear(bottom.max, {1, 1, 0});
    const Bounds top = boundsOf(shapeFaces()[5], vec4(0), vec2(1));
    expectNear(top.min, {0, 0, 1});
    expectNear(top.max, {1, 1, 1});
    const Bounds liquid = boundsOf(shapeFaces()[shared::kShapeFaceLiquidTop], vec4(0), vec2(1));
    expectNear(liquid.min, {0, 0, 0.875f});
    expectNear(liquid.max, {1, 1, 0.875f});
    EXPECT_EQ(shapeFaceSide(4), world::kFaceNegZ);
    EXPECT_EQ(shapeFaceSide(shared::kShapeFaceLiquidTop), world::kFacePosZ);
}

TEST(ShapeFaces, CrossPlanesAreCenteredDiagonalsOfWidthOne) {
    for (shared::uint i : {shared::kShapeFaceCross, shared::kShapeFaceCross + 1}) {
        const ShapeFace& face = shapeFaces()[i];
        const Bounds bounds = boundsOf(face, vec4(0), vec2(1));
        expectNear((bounds.min + bounds.max) / 2.0f, glm::vec3(0.5f));
        EXPECT_NEAR(glm::length(glm::vec3(face.axisU)), 1, kEpsilon);
        EXPECT_EQ(shapeFaceSide(i), world::kFaceCount);
    }
    const float across = glm::dot(glm::vec3(shapeFaces()[6].axisU), glm::vec3(shapeFaces()[7].axisU));
    EXPECT_NEAR(across, 0, kEpsilon) << "the planes stand at right angles";
}

// u runs to the right and v up as seen from outside: corner (0,0) is the texture's lower left.
TEST(ShapeFaces, TexturesStartAtTheLowerLeft) {
    const std::array<glm::vec3, 6> start{{{0, 1, 0}, {1, 0, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}}};
    for (std::size_t i = 0; i < start.size(); ++i) {
        expectNear(glm::vec3(shapeFaceCorner(shapeFaces()[i], vec4(0), vec2(0), vec2(1))), start[i]);
    }
}

// The shader reads no bend for the faces of the program's own shapes: they are flat, and their upper right
// corner is the texture's, but on the sides of flowing liquids, whose texture the shader cuts off at their
// height.
TEST(ShapeFaces, TheProgramsOwnFacesShowTheWholeTexture) {
    for (shared::uint i = 0; i < shared::kShapeFaceCount; ++i) {
        const ShapeFace& face = shapeFaces()[i];
        EXPECT_EQ(glm::vec3(face.bend), glm::vec3(0)) << i;
        EXPECT_FALSE(shared::isTwoSidedFace(face)) << i;
        for (const vec2 corner : {vec2(0, 0), vec2(1, 0), vec2(0, 1), vec2(1, 1)}) {
            const float height = face.base.z + face.axisV.z * corner.y;
            const bool isFlowSide = i >= shared::kShapeFaceFlowSide;
            const vec2 expected(corner.x, 1 - (isFlowSide ? height : corner.y));
            EXPECT_EQ(shapeFaceTexel(face, corner), expected) << i;
        }
    }
}

TEST(ShapeFaces, DirectionsAreSidesOrThoseOfPlants) {
    for (shared::uint i = 0; i < shared::kShapeFaceCount; ++i) {
        const bool isPlant = i >= shared::kShapeFaceCross && i < shared::kShapeFaceInset;
        EXPECT_EQ(faceDirectionOf(shapeFaces()[i]),
                  isPlant ? shared::kDirectionPlant : shared::uint{shapeFaceSide(i)})
            << i;
    }
}

// A merged quad spans exactly what the faces of its blocks span.
TEST(ShapeFaces, QuadsSpanTheFacesOfTheirBlocks) {
    const std::vector<ShapeFace> table = shapeFaces(testBlocks());
    for (const shared::Quad q : meshOf(Area(randomBlocks(Mix::Lumps, 5))).quads) {
        const ShapeFace& face = table[quadShapeFace(q)];
        const vec4 cell(quadX(q), quadY(q), quadZ(q), 0);
        const auto up = [](vec4 axis) { return vec4(glm::notEqual(axis, vec4(0))); };
        Bounds expected;
        for (unsigned v = 0; v < quadExtentV(q); ++v) {
            for (unsigned u = 0; u < quadExtentU(q); ++u) {
                const vec4 at =
                    cell + up(face.axisU) * static_cast<float>(u) + up(face.axisV) * static_cast<float>(v);
                const Bounds one = boundsOf(face, at, vec2(1));
                expected.cover(vec4(one.min, 0));
                expected.cover(vec4(one.max, 0));
            }
        }
        const Bounds bounds = boundsOf(face, cell, vec2(quadExtentU(q), quadExtentV(q)));
        expectNear(bounds.min, expected.min);
        expectNear(bounds.max, expected.max);
    }
}

}  // namespace
}  // namespace terrane::mesh

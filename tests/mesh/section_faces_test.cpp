// The rules of shapes on blocks placed by hand.
#include "terrane/mesh/section_faces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/mesh/mesh_fixture.h"

namespace terrane::mesh {
namespace {

using testing::IsEmpty;
using testing::UnorderedElementsAre;

// A quad in the terms of the rules: lowest block, shape face, size.
struct Seen {
    unsigned x, y, z, shapeFace, extentU = 1, extentV = 1;
    bool operator==(const Seen&) const = default;
    friend void PrintTo(const Seen& s, std::ostream* out) {
        *out << "{" << s.x << ", " << s.y << ", " << s.z << ", face " << s.shapeFace << ", " << s.extentU
             << " x " << s.extentV << "}";
    }
};

// The quads whose shape faces are first … last.
std::vector<Seen> quadsOf(const Area& area, unsigned first, unsigned last) {
    std::vector<Seen> seen;
    for (const shared::Quad q : meshOf(area).quads) {
        if (quadShapeFace(q) < first || quadShapeFace(q) > last) continue;
        seen.push_back({quadX(q), quadY(q), quadZ(q), quadShapeFace(q), quadExtentU(q), quadExtentV(q)});
    }
    return seen;
}

std::vector<Seen> allQuads(const Area& area) {
    return quadsOf(area, 0, shared::kShapeFaceCount - 1);
}

constexpr unsigned kTop = shared::kShapeFaceLiquidTop;
constexpr unsigned kNegX = shared::kShapeFaceLiquidSide, kPosX = kNegX + 1, kNegY = kNegX + 2,
                   kPosY = kNegX + 3;

TEST(SectionFaces, LoneWaterIsLoweredOnAllSides) {
    EXPECT_THAT(allQuads(placed({{5, 6, 40, "water"}})),
                UnorderedElementsAre(Seen{5, 6, 40, kNegX}, Seen{5, 6, 40, kPosX}, Seen{5, 6, 40, kNegY},
                                     Seen{5, 6, 40, kPosY}, Seen{5, 6, 40, 4}, Seen{5, 6, 40, kTop}));
}

TEST(SectionFaces, WaterUnderWaterIsFull) {
    EXPECT_THAT(
        allQuads(placed({{5, 6, 40, "water"}, {5, 6, 41, "water"}})),
        UnorderedElementsAre(Seen{5, 6, 40, 0}, Seen{5, 6, 40, 1}, Seen{5, 6, 40, 2}, Seen{5, 6, 40, 3},
                             Seen{5, 6, 40, 4}, Seen{5, 6, 41, kNegX}, Seen{5, 6, 41, kPosX},
                             Seen{5, 6, 41, kNegY}, Seen{5, 6, 41, kPosY}, Seen{5, 6, 41, kTop}));
}

TEST(SectionFaces, WaterUnderAnOpaqueCubeIsFullAndHasNoTop) {
    EXPECT_THAT(quadsOf(placed({{5, 6, 40, "water"}, {5, 6, 41, "stone"}}), kTop, kPosY), IsEmpty());
    EXPECT_THAT(quadsOf(placed({{5, 6, 40, "water"}, {5, 6, 41, "stone"}}), 0, 3).size(), 8u);
}

TEST(SectionFaces, WaterUnderGlassAndOtherLiquidsKeepsItsTop) {
    for (const auto above : {"glass", "lava", "leaves", "tuft"}) {
        EXPECT_THAT(quadsOf(placed({{5, 6, 47, "water"}, {5, 6, 48, above}}), kTop, kTop),
                    testing::Contains(Seen{5, 6, 47, kTop}))
            << above;
    }
}

// The full block's strip above the surface beside it is left out, as is the surface block's side.
TEST(SectionFaces, SurfaceBesideFullWaterHasNoFaceBetween) {
    const Area area = placed({{5, 6, 40, "water"}, {6, 6, 40, "water"}, {6, 6, 41, "water"}});
    EXPECT_THAT(quadsOf(area, 0, 1), UnorderedElementsAre(Seen{6, 6, 40, 1}));
    EXPECT_THAT(quadsOf(area, kNegX, kPosX),
                UnorderedElementsAre(Seen{5, 6, 40, kNegX}, Seen{6, 6, 41, kNegX}, Seen{6, 6, 41, kPosX}));
}

TEST(SectionFaces, WaterSurfaceMergesOnTopAndAlongItsSides) {
    const Area area([](int x, int y, int z) {
        return x >= 0 && x < 8 && y >= 0 && y < 4 && z >= 40 && z < 43 ? idOf("water") : world::kAir;
    });
    EXPECT_THAT(allQuads(area), UnorderedElementsAre(Seen{0, 0, 40, 0, 4, 2}, Seen{7, 0, 40, 1, 4, 2},
                                                     Seen{0, 0, 40, 2, 8, 2}, Seen{0, 3, 40, 3, 8, 2},
                                                     Seen{0, 0, 40, 4, 8, 4}, Seen{0, 0, 42, kNegX, 4},
                                                     Seen{7, 0, 42, kPosX, 4}, Seen{0, 0, 42, kNegY, 8},
                                                     Seen{0, 3, 42, kPosY, 8}, Seen{0, 0, 42, kTop, 8, 4}));
}

TEST(SectionFaces, LiquidsHaveNoInnerFaces) {
    ASSERT_TRUE(testBlocks().find("lava")->innerFaces);
    const Area area = placed({{5, 6, 40, "lava"}, {6, 6, 40, "lava"}});
    EXPECT_THAT(quadsOf(area, kNegX, kPosX),
                UnorderedElementsAre(Seen{5, 6, 40, kNegX}, Seen{6, 6, 40, kPosX}));
}

// Water by its form at 15, 6, 40 and at 16, 6, 40, which lies in the next chunk; on stone.
std::vector<Seen> besideFlow(std::uint16_t form, std::uint16_t beyond, bool isSource) {
    Area area = placed({{15, 6, 40, "water"}, {16, 6, 40, "water"}, {15, 6, 39, "stone"}});
    area.center.setBlockState(world::blockIndex(15, 6, 40), form);
    area.beside[1].setBlockState(world::blockIndex(0, 6, 40), beyond);
    return isSource ? quadsOf(area, kTop, kPosY)
                    : quadsOf(area, shared::kShapeFaceFlowTop, shared::kShapeFaceCount - 1);
}

TEST(SectionFaces, FlowingWaterIsAsHighAsItsLevel) {
    constexpr unsigned kTopOf3 = shared::kShapeFaceFlowTop + 2;
    EXPECT_THAT(besideFlow(3, 3, false),
                UnorderedElementsAre(Seen{15, 6, 40, kTopOf3}, Seen{15, 6, 40, shared::flowSideFace(0, 0, 5)},
                                     Seen{15, 6, 40, shared::flowSideFace(2, 0, 5)},
                                     Seen{15, 6, 40, shared::flowSideFace(3, 0, 5)}));
}

TEST(SectionFaces, TheHigherWaterDrawsTheStepDown) {
    using testing::Contains;
    const Seen step{15, 6, 40, shared::flowSideFace(1, 3, 5)};
    EXPECT_THAT(besideFlow(3, 5, false), Contains(step));
    EXPECT_THAT(besideFlow(3, 1, false),
                testing::Not(Contains(testing::Field(&Seen::shapeFace, step.shapeFace))));
    EXPECT_EQ(besideFlow(3, 1, false).size(), 4u) << "its top and three sides";
    const Seen downFromSource{15, 6, 40, shared::flowSideFace(1, 3, 8)};
    EXPECT_THAT(besideFlow(0, 5, false), UnorderedElementsAre(downFromSource))
        << "a source beside what flows";
    EXPECT_EQ(besideFlow(0, 5, true).size(), 4u) << "its top and three sides are as ever";
    const Seen downFromFall{15, 6, 40, shared::flowSideFace(1, 8, 9)};
    EXPECT_THAT(besideFlow(8, 0, false), Contains(downFromFall));
}

TEST(SectionFaces, UnsettledSourcesAreMeshedLikeOthers) {
    constexpr std::uint16_t kUnsettled = 1u << 15;
    EXPECT_EQ(besideFlow(kUnsettled, 0, true), besideFlow(0, 0, true));
    EXPECT_THAT(besideFlow(kUnsettled, 0, false), IsEmpty());
}

TEST(SectionFaces, WaterAtTheTopOfTheWorldIsSurface) {
    EXPECT_THAT(quadsOf(placed({{5, 6, 255, "water"}}), kTop, kTop),
                UnorderedElementsAre(Seen{5, 6, 255, kTop}));
}

TEST(SectionFaces, LowerLeavesDrawTheFaceBetween) {
    EXPECT_THAT(allQuads(placed({{4, 4, 40, "leaves"}, {4, 4, 41, "leaves"}})),
                UnorderedElementsAre(Seen{4, 4, 40, 0, 1, 2}, Seen{4, 4, 40, 1, 1, 2},
                                     Seen{4, 4, 40, 2, 1, 2}, Seen{4, 4, 40, 3, 1, 2}, Seen{4, 4, 40, 4},
                                     Seen{4, 4, 40, 5}, Seen{4, 4, 41, 5}));
}

TEST(SectionFaces, LeavesAcrossChunksDrawTheFaceOnce) {
    EXPECT_THAT(quadsOf(placed({{-1, 4, 40, "leaves"}, {0, 4, 40, "leaves"}}), 0, 1),
                UnorderedElementsAre(Seen{0, 4, 40, 1}));
    EXPECT_THAT(quadsOf(placed({{15, 4, 40, "leaves"}, {16, 4, 40, "leaves"}}), 0, 1),
                UnorderedElementsAre(Seen{15, 4, 40, 0}, Seen{15, 4, 40, 1}));
}

TEST(SectionFaces, OneSidedInnerFacesAreBothDrawn) {
    EXPECT_THAT(
        quadsOf(placed({{4, 4, 40, "grate"}, {5, 4, 40, "grate"}}), 0, 1),
        UnorderedElementsAre(Seen{4, 4, 40, 0}, Seen{4, 4, 40, 1}, Seen{5, 4, 40, 0}, Seen{5, 4, 40, 1}));
}

TEST(SectionFaces, TransparentBlocksOfTwoTypesBothDraw) {
    EXPECT_THAT(
        quadsOf(placed({{4, 4, 40, "glass"}, {5, 4, 40, "hedge"}}), 0, 1),
        UnorderedElementsAre(Seen{4, 4, 40, 0}, Seen{4, 4, 40, 1}, Seen{5, 4, 40, 0}, Seen{5, 4, 40, 1}));
    EXPECT_THAT(quadsOf(placed({{4, 4, 40, "glass"}, {5, 4, 40, "glass"}}), 0, 1),
                UnorderedElementsAre(Seen{4, 4, 40, 0}, Seen{5, 4, 40, 1}));
}

TEST(SectionFaces, OpaqueFacesTowardGlassAreDrawnAndGlassTowardOpaqueIsNot) {
    EXPECT_THAT(quadsOf(placed({{4, 4, 40, "stone"}, {5, 4, 40, "glass"}}), 0, 1),
                UnorderedElementsAre(Seen{4, 4, 40, 0}, Seen{4, 4, 40, 1}, Seen{5, 4, 40, 1}));
}

TEST(SectionFaces, PlantsAreDrawnAlsoInsideStone) {
    const Area area(
        [](int x, int y, int z) { return x == 4 && y == 4 && z == 40 ? idOf("tuft") : idOf("stone"); });
    EXPECT_THAT(quadsOf(area, 6, 11), UnorderedElementsAre(Seen{4, 4, 40, 6}, Seen{4, 4, 40, 7}));
    EXPECT_EQ(quadsOf(area, 0, 5).size(), 6u + 1u);  // the stone around it, and the top of the world
}

TEST(SectionFaces, CactusStackHidesItsInnerTops) {
    const Area area = placed({{4, 4, 40, "cactus"}, {4, 4, 41, "cactus"}});
    EXPECT_THAT(quadsOf(area, 0, 5), UnorderedElementsAre(Seen{4, 4, 40, 4}, Seen{4, 4, 41, 5}));
    EXPECT_EQ(quadsOf(area, shared::kShapeFaceInset, shared::kShapeFaceInset + 3).size(), 8u);
}

TEST(SectionFaces, FacesWhoseTopWavesAreNotMerged) {
    const Area area([](int x, int y, int z) {
        return x >= 4 && x < 7 && y == 4 && z == 40 ? idOf("hedge") : world::kAir;
    });
    EXPECT_EQ(allQuads(area).size(), 14u);
}

}  // namespace
}  // namespace terrane::mesh

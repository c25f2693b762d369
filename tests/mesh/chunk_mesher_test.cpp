#include "terrane/mesh/chunk_mesher.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "tests/mesh/mesh_fixture.h"
#include "tests/mesh/random_blocks.h"
#include "tests/mesh/reference_faces.h"
#include "tests/support/depth.h"

namespace terrane::mesh {
namespace {

const unsigned kSeeds = atDepth(2u, 6u);  // × 9 mixes × 5 methods
constexpr int kMeshSectionHeights[] = {8, 16, 32, 64, 128};

// Every visible face is covered once, no other face is.
void expectExact(const MeshInput& input, const ChunkMesh& mesh) {
    const std::vector<CellFace> expected = ReferenceFaces(input).find();
    const std::vector<CellFace> covered = coveredFaces(mesh.quads, testBlocks());
    if (expected == covered) return;
    const auto [e, c] = std::mismatch(expected.begin(), expected.end(), covered.begin(), covered.end());
    ADD_FAILURE() << "expected " << (e == expected.end() ? "no more" : describe(*e)) << ", covered "
                  << (c == covered.end() ? "no more" : describe(*c));
}

const shared::ShapeFace& shapeFaceOf(const shared::Quad q) {
    static const std::vector<shared::ShapeFace> table = shapeFaces(testBlocks());
    return table[quadShapeFace(q)];
}

bool mayMerge(const shared::Quad q, const world::Material& material) {
    const unsigned shape = quadShapeFace(q);
    if (material.animation == world::Animation::TopWaves) return false;
    return shape < shared::kShapeFaceCross ||
           (shape >= shared::kShapeFaceLiquidTop && shape < shared::kShapeFaceCount);
}

// Quads stay inside cells of the method, sections and mesh sections.
void expectInside(const shared::Quad q, const MeshOptions& options) {
    const auto cell = options.method == MergeMethod::Greedy ? 16u : 8u;
    const auto cellZ = std::min(cell, static_cast<unsigned>(options.meshSectionHeight));
    const bool upright = shapeFaceOf(q).axisV.z != 0;
    const unsigned topZ = quadZ(q) + (upright ? quadExtentV(q) : 1) - 1;
    EXPECT_EQ(quadZ(q) / cellZ, topZ / cellZ);
    const bool uAlongX = shapeFaceOf(q).axisU.x != 0;
    const unsigned u = uAlongX ? quadX(q) : quadY(q);
    EXPECT_EQ(u / cell, (u + quadExtentU(q) - 1) / cell);
    if (!upright) {
        EXPECT_EQ(quadY(q) / cell, (quadY(q) + quadExtentV(q) - 1) / cell);
    }
}

void expectWellFormed(const shared::Quad q, const MeshOptions& options) {
    ASSERT_LT(quadShapeFace(q), shared::kShapeFaceCount + testBlocks().modelFaces().size());
    ASSERT_LT(quadMaterial(q), testBlocks().materials().size());
    EXPECT_EQ(q.word1 >> 19, 0u);
    expectInside(q, options);
    if (options.method == MergeMethod::None || !mayMerge(q, testBlocks().materials()[quadMaterial(q)])) {
        EXPECT_EQ(quadExtentU(q), 1u);
        EXPECT_EQ(quadExtentV(q), 1u);
    }
    if (quadShapeFace(q) >= shared::kShapeFaceLiquidSide) {
        EXPECT_EQ(quadExtentV(q), 1u);
    }
}

// The draw bucket and direction of a range against the quads in it, by the words of mesh_section_quads.h.
void expectSorted(const shared::Quad q, int bucket, int direction) {
    const world::Material& material = testBlocks().materials()[quadMaterial(q)];
    const auto alpha = material.alpha;
    const bool opaque = alpha == world::AlphaMode::Unused || alpha == world::AlphaMode::Glow;
    const bool blended = alpha == world::AlphaMode::Blend;
    const bool twoSided = material.twoSided || shared::isTwoSidedFace(shapeFaceOf(q));
    EXPECT_EQ(bucket, (opaque ? 0 : blended ? 4 : 2) + (twoSided ? 1 : 0));
    const glm::vec3 normal = normalOf(shapeFaceOf(q));
    if (direction == kAnyDirection) {
        const bool oblique = (normal.x != 0) + (normal.y != 0) + (normal.z != 0) > 1;
        EXPECT_TRUE(twoSided || oblique);
    } else {
        EXPECT_FALSE(twoSided);
        EXPECT_EQ(normal[direction / 2], direction % 2 == 0 ? -1.0f : 1.0f);
    }
}

struct Height {
    int min = world::kChunkHeight, max = 0;

    void cover(const shared::Quad q) {
        const int z = static_cast<int>(quadZ(q));
        const bool upright = shapeFaceOf(q).axisV.z != 0;
        min = std::min(min, z);
        max = std::max(max, z + (upright ? static_cast<int>(quadExtentV(q)) : 1));
    }
};

void expectMeshSections(const ChunkMesh& mesh, int meshSectionHeight) {
    ASSERT_EQ(static_cast<int>(mesh.meshSections.size()), world::kChunkHeight / meshSectionHeight);
    std::uint32_t next = 0;
    for (std::size_t r = 0; r < mesh.meshSections.size(); ++r) {
        const MeshSection& meshSection = mesh.meshSections[r];
        const std::uint32_t first = next;
        Height height;
        for (int bucket = 0; bucket < kDrawBucketCount; ++bucket) {
            for (int direction = 0; direction < kFaceDirectionCount; ++direction) {
                const QuadRange range = meshSection.ranges[bucket][direction];
                ASSERT_EQ(range.first, next);
                next += range.count;
                ASSERT_LE(next, mesh.quads.size());
                for (std::uint32_t i = range.first; i < next; ++i) {
                    expectSorted(mesh.quads[i], bucket, direction);
                    EXPECT_EQ(quadZ(mesh.quads[i]) / static_cast<unsigned>(meshSectionHeight), r);
                    height.cover(mesh.quads[i]);
                }
            }
        }
        EXPECT_EQ(meshSection.minZ, next == first ? 0 : height.min);
        EXPECT_EQ(meshSection.maxZ, next == first ? 0 : height.max);
    }
    EXPECT_EQ(next, mesh.quads.size());
}

struct MixAndMethod : testing::TestWithParam<std::tuple<int, int>> {
    static Mix mix() { return static_cast<Mix>(std::get<0>(GetParam())); }
    static MergeMethod method() { return static_cast<MergeMethod>(std::get<1>(GetParam())); }
};

TEST_P(MixAndMethod, CoverEachVisibleFaceOnce) {
    MeshScratch scratch;  // shared by all: nothing must be left from chunk to chunk
    for (unsigned seed = 0; seed < kSeeds; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        Area area(randomBlocks(mix(), seed + 100 * static_cast<unsigned>(method())));
        if (seed % 2 == 1) area.addBlockState(seed);
        if (seed % 3 == 1) area.addFlow(seed);
        const MeshOptions options{method(), kMeshSectionHeights[seed % std::size(kMeshSectionHeights)]};
        MeshInput input = area.input(options);
        // Some borders are open, in the last chunk all.
        const bool hasOpenBorders = seed >= kSeeds / 2;
        for (unsigned side = 0; hasOpenBorders && side < 4; ++side) {
            if (side % 2 == seed % 2 || seed == kSeeds - 1) input.neighbors[side] = nullptr;
        }
        const ChunkMesh mesh = meshChunk(input, scratch);
        expectExact(input, mesh);
        expectMeshSections(mesh, options.meshSectionHeight);
        for (const shared::Quad q : mesh.quads) expectWellFormed(q, options);
        MeshScratch fresh;
        EXPECT_EQ(mesh, meshChunk(input, fresh)) << "a fresh scratch gives the same";
        if (HasFailure()) return;
    }
}

INSTANTIATE_TEST_SUITE_P(All, MixAndMethod,
                         testing::Combine(testing::Range(0, static_cast<int>(Mix::Count)),
                                          testing::Range(0, static_cast<int>(MergeMethod::Count))));

// Among the methods without unlimited runs the later ones merge more.
TEST(ChunkMesher, MethodsMergeMoreAndMore) {
    for (unsigned seed = 0; seed < 5; ++seed) {
        const Area area(randomBlocks(Mix::Terrain, seed));
        const auto count = [&](MergeMethod method) { return meshOf(area, {.method = method}).quads.size(); };
        const std::size_t none = count(MergeMethod::None), lines = count(MergeMethod::Lines);
        const std::size_t squares = count(MergeMethod::Squares), ext = count(MergeMethod::SquaresExt);
        EXPECT_LT(lines, none);
        EXPECT_LT(squares, none);
        EXPECT_LT(ext, squares);
        EXPECT_LT(count(MergeMethod::Greedy), std::min(lines, ext));
    }
}

// Edits leave ids in the palette that no block has, and forms that are wider than needed.
TEST(ChunkMesher, FormOfSectionsDoesNotMatter) {
    Area area(randomBlocks(Mix::Terrain, 3));
    const ChunkMesh before = meshOf(area);
    for (int z = 0; z < 64; ++z) {
        const world::BlockIndex i = world::blockIndex(z % 16, 5, z);
        const world::BlockId old = area.center.block(i);
        for (world::BlockId id = 0; id < 300; ++id) area.center.setBlock(i, id);
        area.center.setBlock(i, old);
    }
    ASSERT_TRUE(area.center.section(1).isDense());
    const ChunkMesh after = meshOf(area);
    EXPECT_EQ(coveredFaces(before.quads, testBlocks()), coveredFaces(after.quads, testBlocks()));
    EXPECT_EQ(before.quads.size(), after.quads.size());
}

TEST(ChunkMesher, MeshSectionHeightOnlyRegroups) {
    const Area area(randomBlocks(Mix::Terrain, 7));
    const std::vector<CellFace> faces = coveredFaces(meshOf(area).quads, testBlocks());
    for (const int height : kMeshSectionHeights) {
        EXPECT_EQ(coveredFaces(meshOf(area, {.meshSectionHeight = height}).quads, testBlocks()), faces);
    }
}

TEST(ChunkMesher, EmptyChunkHasEmptyMeshSections) {
    const ChunkMesh mesh = meshOf(placed({}), {.meshSectionHeight = 64});
    EXPECT_TRUE(mesh.quads.empty());
    ASSERT_EQ(mesh.meshSections.size(), 4u);
    EXPECT_EQ(mesh.meshSections[0], MeshSection{});
}

TEST(ChunkMesher, SolidWorldShowsOnlyItsTop) {
    const Area area([](int, int, int) { return idOf("stone"); });
    const ChunkMesh mesh = meshOf(area);
    ASSERT_EQ(mesh.quads.size(), 1u);
    const auto expected =
        shared::packQuad({.x = 0,
                          .y = 0,
                          .z = 255,
                          .shapeFace = world::kFacePosZ,
                          .extentU = 16,
                          .extentV = 16,
                          .material = testBlocks().find("stone")->material[world::kFacePosZ]});
    EXPECT_EQ(mesh.quads[0], expected);
}

TEST(ChunkMesher, SectionSizedCubeIsSixQuads) {
    const Area area([](int x, int y, int z) {
        const bool inside = x >= 0 && x < 16 && y >= 0 && y < 16 && z >= 32 && z < 48;
        return inside ? idOf("stone") : world::kAir;
    });
    const ChunkMesh mesh = meshOf(area, {.meshSectionHeight = 64});
    ASSERT_EQ(mesh.quads.size(), 6u);
    for (const shared::Quad q : mesh.quads) {
        EXPECT_EQ(quadExtentU(q), 16u);
        EXPECT_EQ(quadExtentV(q), 16u);
    }
    EXPECT_EQ(mesh.meshSections[0].minZ, 32);
    EXPECT_EQ(mesh.meshSections[0].maxZ, 48);
}

// The column's top is in the next mesh section, so that its sides alone reach up to the end of the first.
TEST(ChunkMesher, BoundsOfMeshSectionsAreTight) {
    std::vector<Placed> blocks{{8, 4, 62, "stone"}, {4, 8, 62, "stone"}};
    for (int z = 60; z < 66; ++z) blocks.push_back({4, 4, z, "stone"});
    const ChunkMesh mesh = meshOf(placed(blocks), {.meshSectionHeight = 64});
    EXPECT_EQ(mesh.meshSections[0].minZ, 60);
    EXPECT_EQ(mesh.meshSections[0].maxZ, 64);
    EXPECT_EQ(mesh.meshSections[1].minZ, 64);
    EXPECT_EQ(mesh.meshSections[1].maxZ, 66);
    EXPECT_EQ(mesh.meshSections[2].maxZ, 0);
}

TEST(ChunkMesher, BottomOfTheWorldIsNotDrawn) {
    const ChunkMesh mesh = meshOf(placed({{4, 4, 0, "stone"}, {8, 8, 0, "water"}, {12, 4, 0, "cactus"}}));
    for (const shared::Quad q : mesh.quads) EXPECT_NE(quadShapeFace(q), unsigned{world::kFaceNegZ});
    EXPECT_EQ(mesh.quads.size(), 15u);
}

TEST(MeshChunk, NeedsAChunkItsBlocksAndAHeight) {
    const Area area([](int, int, int) { return world::kAir; });
    MeshScratch scratch;
    std::vector<shared::Quad> quads;
    const auto refuses = [&](auto change) {
        MeshInput input = area.input();
        change(input);
        EXPECT_THROW(meshChunk(input, scratch), std::invalid_argument);
    };
    refuses([](MeshInput& input) { input.center = nullptr; });
    refuses([](MeshInput& input) { input.blocks = nullptr; });
    for (const int height : {0, -16, 4, 24, 256})
        refuses([=](MeshInput& input) { input.options.meshSectionHeight = height; });
    for (const int number : {-1, 4})
        EXPECT_THROW(buildMeshSection(area.input({MergeMethod::None, 64}), number, scratch, quads),
                     std::invalid_argument);
}

}  // namespace
}  // namespace terrane::mesh

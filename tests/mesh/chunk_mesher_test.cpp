#include "terrane/mesh/chunk_mesher.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "terrane/mesh/remesh.h"
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
    const std::vector<FaceNumber> expected = ReferenceFaces(input).find();
    const std::vector<FaceNumber> covered = coveredFaces(mesh, testBlocks());
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
    int min = world::kHighestTop, max = world::kLowestBottom;

    void cover(const shared::Quad q, int base) {
        const int z = base + static_cast<int>(quadZ(q));
        const bool upright = shapeFaceOf(q).axisV.z != 0;
        min = std::min(min, z);
        max = std::max(max, z + (upright ? static_cast<int>(quadExtentV(q)) : 1));
    }
};

void expectMeshSections(const ChunkMesh& mesh, int meshSectionHeight) {
    std::uint32_t next = 0;
    int end = world::kLowestBottom;
    for (const MeshSection& meshSection : mesh.meshSections) {
        ASSERT_GE(meshSection.bottom, end) << "lowest first";
        end = meshSection.top;
        ASSERT_EQ(meshSection.bottom & (meshSectionHeight - 1), 0);
        ASSERT_EQ(meshSection.top - meshSection.bottom, meshSectionHeight);
        ASSERT_GT(quadCount(meshSection), 0u);
        Height height;
        for (int bucket = 0; bucket < kDrawBucketCount; ++bucket) {
            for (int direction = 0; direction < kFaceDirectionCount; ++direction) {
                const QuadRange range = meshSection.ranges[bucket][direction];
                ASSERT_EQ(range.first, next);
                next += range.count;
                ASSERT_LE(next, mesh.quads.size());
                for (std::uint32_t i = range.first; i < next; ++i) {
                    expectSorted(mesh.quads[i], bucket, direction);
                    height.cover(mesh.quads[i], quadBase(meshSection));
                }
            }
        }
        EXPECT_EQ(meshSection.minZ, height.min);
        EXPECT_EQ(meshSection.maxZ, height.max);
        EXPECT_GE(meshSection.minZ, meshSection.bottom);
        EXPECT_LE(meshSection.maxZ, meshSection.top);
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
    EXPECT_EQ(coveredFaces(before, testBlocks()), coveredFaces(after, testBlocks()));
    EXPECT_EQ(before.quads.size(), after.quads.size());
}

TEST(ChunkMesher, MeshSectionHeightOnlyRegroups) {
    const Area area(randomBlocks(Mix::Terrain, 7));
    const std::vector<FaceNumber> faces = coveredFaces(meshOf(area), testBlocks());
    for (const int height : kMeshSectionHeights) {
        EXPECT_EQ(coveredFaces(meshOf(area, {.meshSectionHeight = height}), testBlocks()), faces);
    }
}

TEST(ChunkMesher, EmptyChunkHasNoMeshSections) {
    EXPECT_EQ(meshOf(placed({}), {.meshSectionHeight = 64}), ChunkMesh());
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
    EXPECT_EQ(mesh.meshSections.size(), 2u);
}

constexpr world::Heights kTallHeights[] = {{-64, 320}, {-2048, -1808}, {1936, 2048}, {512, 1024}, {-16, 0}};

// The blocks of a source from the bottom of a world on.
BlockSource movedUp(const BlockSource& source, int blocks) {
    return [=](int x, int y, int z) { return source(x, y, z - blocks); };
}

// Also with mesh sections that reach beyond the world.
TEST(ChunkMesher, AnyHeightsCoverEachVisibleFaceOnce) {
    MeshScratch scratch;
    unsigned seed = 0;
    for (const world::Heights heights : kTallHeights) {
        for (const int meshSectionHeight : kMeshSectionHeights) {
            SCOPED_TRACE(world::describe(heights) + ", mesh sections of " +
                         std::to_string(meshSectionHeight));
            const auto mix = static_cast<Mix>(seed % static_cast<unsigned>(Mix::Count));
            Area area(movedUp(randomBlocks(mix, seed), heights.bottom), heights);
            if (++seed % 2 == 1) area.addBlockState(seed);
            if (seed % 3 == 1) area.addFlow(seed);
            const MeshOptions options{MergeMethod::Greedy, meshSectionHeight};
            MeshInput input = area.input(options);
            if (seed % 4 == 0) input.neighbors[seed / 4 % 4] = nullptr;
            const ChunkMesh mesh = meshChunk(input, scratch);
            expectExact(input, mesh);
            expectMeshSections(mesh, meshSectionHeight);
            for (const shared::Quad q : mesh.quads) expectWellFormed(q, options);
            if (HasFailure()) return;
        }
    }
}

// Slices of the random blocks between air and solid ground: sections of one block are left out by the mesher.
BlockSource tallBlocks(Mix mix, unsigned seed) {
    return [=, slice = randomBlocks(mix, seed)](int x, int y, int z) -> world::BlockId {
        switch (hashAt(x >> 6, y >> 6, z >> 5, seed) % 4) {
            case 0:
                return slice(x, y, z & 127);
            case 1:
                return hashAt(x >> 2, y >> 2, z >> 6, seed) % 3 == 0 ? world::kAir : idOf("stone");
            case 2:
                return world::kAir;
            default:
                return idOf("stone");
        }
    };
}

// Ten columns up to the heights that there are. In most of them each chunk is made to a depth of its own.
TEST(ChunkMesher, TallChunksThatAreNotMadeWholeCoverEachVisibleFaceOnce) {
    constexpr world::Heights kColumns[] = {{-2048, 2048}, {-1024, 1792}, {-512, 512}, {-64, 320}, {0, 1024}};
    MeshScratch scratch;
    for (unsigned seed = 0; seed < 10; ++seed) {
        const world::Heights heights = kColumns[seed % std::size(kColumns)];
        SCOPED_TRACE("seed " + std::to_string(seed) + ", " + world::describe(heights));
        const auto mix = static_cast<Mix>(seed % static_cast<unsigned>(Mix::UnknownIds));
        Area area(tallBlocks(mix, seed), heights);
        if (seed % 3 == 1) area.addFlow(seed);
        const auto unmake = [&](world::Chunk& chunk, unsigned number) {
            const int depth = static_cast<int>(hashAt(static_cast<int>(number), 0, 0, seed) %
                                               static_cast<unsigned>(heights.sections()));
            chunk.unmakeBelow(heights.firstSection() + depth);
        };
        if (seed % 5 != 4) unmake(area.center, 4);
        for (unsigned side = 0; side < 4; ++side)
            if ((seed >> side & 1) == 0) unmake(area.beside[side], side);
        const MeshOptions options{MergeMethod::Greedy,
                                  kMeshSectionHeights[seed % std::size(kMeshSectionHeights)]};
        MeshInput input = area.input(options);
        if (seed % 4 == 3) input.neighbors[seed / 4 % 4] = nullptr;
        const ChunkMesh mesh = meshChunk(input, scratch);
        expectExact(input, mesh);
        expectMeshSections(mesh, options.meshSectionHeight);
        for (const shared::Quad q : mesh.quads) expectWellFormed(q, options);
        EXPECT_GT(mesh.quads.size(), 100u);
        if (HasFailure()) return;
    }
}

// Land in the middle of a world of 4,096 layers: its mesh has what the land has, and no more.
TEST(ChunkMesher, HeightAddsNothing) {
    const world::Heights tall{world::kLowestBottom, world::kHighestTop};
    const BlockSource land = randomBlocks(Mix::Terrain, 5);
    const auto deepLand = [&](int x, int y, int z) { return z < 0 ? idOf("stone") : land(x, y, z); };
    const Area area(deepLand, tall);
    const ChunkMesh expected = meshOf(Area(land));
    EXPECT_EQ(meshOf(area), expected);
    MeshScratch scratch;
    EXPECT_EQ(buildMeshSections(area.input(), MeshSectionSet::all(tall), scratch), expected);
}

// Moved by whole slabs, quads are the same; by other steps their z changes.
TEST(ChunkMesher, QuadsCountFromTheirSlab) {
    const world::Heights tall{world::kLowestBottom, world::kHighestTop};
    const BlockSource lumps = [](int x, int y, int z) {
        return z < 0 || z >= 200 ? world::kAir : randomBlocks(Mix::Lumps, 3)(x, y, z);
    };
    const ChunkMesh at0 = meshOf(Area(lumps, tall));
    for (const int slabs : {-7, -1, 7}) {
        const ChunkMesh moved = meshOf(Area(movedUp(lumps, 256 * slabs), tall));
        EXPECT_TRUE(moved.quads == at0.quads);
        ASSERT_EQ(moved.meshSections.size(), at0.meshSections.size());
        for (std::size_t k = 0; k < moved.meshSections.size(); ++k) {
            EXPECT_EQ(moved.meshSections[k].minZ, at0.meshSections[k].minZ + 256 * slabs);
            EXPECT_EQ(quadBase(moved.meshSections[k]), 256 * slabs);
        }
    }
}

// Caves of the chunks beside may be as deep as the world.
TEST(ChunkMesher, OpenSidesReachTheBottom) {
    const world::Heights tall{world::kLowestBottom, 512};
    const Area area([](int, int, int z) { return z < 80 ? idOf("stone") : world::kAir; }, tall);
    MeshScratch scratch;
    const ChunkMesh mesh = meshTile(area.center, testBlocks(), {}, scratch);
    ASSERT_FALSE(mesh.meshSections.empty());
    EXPECT_EQ(mesh.meshSections.front().minZ, tall.bottom);
    EXPECT_EQ(mesh.quads.size(), 1u + 4 * static_cast<std::size_t>((80 - tall.bottom) / world::kSectionSize));
    MeshInput input = area.input();
    input.neighbors = {};
    expectExact(input, mesh);
}

// The chunk that stands for those beyond the world's edge has other heights.
TEST(ChunkMesher, BeyondTheHeightsOfANeighborIsAir) {
    const world::Heights tall{-64, 320};
    const Area area(randomBlocks(Mix::Dense, 4), tall);
    const world::Chunk none, noneAsTall(tall);
    MeshScratch scratch;
    MeshInput input = area.input(), same = input;
    input.neighbors[0] = input.neighbors[3] = &none;
    same.neighbors[0] = same.neighbors[3] = &noneAsTall;
    EXPECT_EQ(meshChunk(input, scratch), meshChunk(same, scratch));
    const MeshBlocks blocks{std::make_shared<const world::Chunk>(area.center), nullptr, nullptr, nullptr,
                            nullptr};
    EXPECT_EQ(meshChunk(meshInput(blocks, testBlocks(), {}), scratch), meshAlone(area.center, testBlocks()));
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
    for (const int bottom : {-64, 32, 256})
        EXPECT_THROW(buildMeshSection(area.input({MergeMethod::None, 64}), bottom, scratch, quads),
                     std::invalid_argument);
}

}  // namespace
}  // namespace terrane::mesh

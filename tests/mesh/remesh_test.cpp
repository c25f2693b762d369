#include "terrane/mesh/remesh.h"

#include <gtest/gtest.h>

#include <limits>
#include <stdexcept>

#include "terrane/shared/hash.h"
#include "tests/mesh/mesh_fixture.h"
#include "tests/mesh/random_blocks.h"

namespace terrane::mesh {
namespace {

using Touched = std::vector<TouchedChunk>;

MeshSectionSet setOf(std::initializer_list<int> parts) {
    MeshSectionSet set;
    for (const int part : parts) set.add(part);
    return set;
}

TEST(MeshSectionSet, HasThePartsThatWereAdded) {
    MeshSectionSet set = setOf({-256, -1, 0, 255});
    EXPECT_EQ(set.count(), 4u);
    EXPECT_FALSE(set.isEmpty());
    EXPECT_TRUE(MeshSectionSet().isEmpty());
    std::vector<int> parts;
    set.forEach([&](int part) { parts.push_back(part); });
    EXPECT_EQ(parts, (std::vector<int>{-256, -1, 0, 255}));
    EXPECT_TRUE(set.has(-1));
    EXPECT_FALSE(set.has(-2));
    set |= setOf({-2});
    EXPECT_TRUE(set.has(-2));
    EXPECT_EQ(MeshSectionSet::all({-64, 16}), setOf({-8, -7, -6, -5, -4, -3, -2, -1, 0, 1}));
    EXPECT_EQ(kAllMeshSections.count(), 512u);
}

TEST(MeshSectionSet, AMeshSectionIsInItIfAPartIs) {
    const MeshSectionSet set = setOf({-1, 3});
    EXPECT_TRUE(set.hasAny(-128, 0));
    EXPECT_TRUE(set.hasAny(16, 32));
    EXPECT_FALSE(set.hasAny(0, 16));
    EXPECT_FALSE(set.hasAny(-128, -16));
    EXPECT_FALSE(set.hasAny(world::kLowestBottom - 64, world::kLowestBottom));
    EXPECT_FALSE(set.hasAny(world::kHighestTop, world::kHighestTop + 64));
}

TEST(MeshSectionsTouchedBy, ABlockInTheMiddleTouchesItsPart) {
    EXPECT_EQ(meshSectionsTouchedBy({5, 6, 70}), (Touched{{{0, 0}, setOf({8})}}));
    EXPECT_EQ(meshSectionsTouchedBy({-5, -6, -70}), (Touched{{{-1, -1}, setOf({-9})}}));
}

TEST(MeshSectionsTouchedBy, BordersTouchWhatIsBeyond) {
    EXPECT_EQ(meshSectionsTouchedBy({5, 6, 64}), (Touched{{{0, 0}, setOf({7, 8})}}));
    EXPECT_EQ(meshSectionsTouchedBy({5, 6, -1}), (Touched{{{0, 0}, setOf({-1, 0})}}));
    EXPECT_EQ(meshSectionsTouchedBy({16, 6, 70}), (Touched{{{1, 0}, setOf({8})}, {{0, 0}, setOf({8})}}));
    EXPECT_EQ(meshSectionsTouchedBy({-1, 15, 63}),
              (Touched{{{-1, 0}, setOf({7, 8})}, {{0, 0}, setOf({7})}, {{-1, 1}, setOf({7})}}));
}

TEST(MeshSectionsTouchedBy, NothingIsOutsideOfEveryWorld) {
    EXPECT_EQ(meshSectionsTouchedBy({5, 6, -2048}), (Touched{{{0, 0}, setOf({-256})}}));
    EXPECT_EQ(meshSectionsTouchedBy({5, 6, 2047}), (Touched{{{0, 0}, setOf({255})}}));
    const auto last = std::numeric_limits<std::int32_t>::max();
    EXPECT_EQ(meshSectionsTouchedBy({last, last, 9}),
              (Touched{{{world::kMaxChunk, world::kMaxChunk}, setOf({1})}}));
}

// Chunk 0, 0 and one beside it, of which blocks are changed.
struct Edited {
    Area area;
    explicit Edited(const BlockSource& source, world::Heights heights = {}) : area(source, heights) {}

    // x −16…31 or y −16…31: in the chunk or beside it.
    world::Chunk& chunkAt(int x, int y) {
        if (x < 0) return area.beside[0];
        if (x > 15) return area.beside[1];
        if (y < 0) return area.beside[2];
        if (y > 15) return area.beside[3];
        return area.center;
    }
};

// Height of mesh sections, and the bottom of a world of 256 layers.
class RemeshHeights : public testing::TestWithParam<std::tuple<int, int>> {};

// After any edit in or beside the chunk the touched mesh sections are enough, whatever the block types.
TEST_P(RemeshHeights, TouchedMeshSectionsAreEnough) {
    const int meshSectionHeight = std::get<0>(GetParam()), bottom = std::get<1>(GetParam());
    const MeshOptions options{MergeMethod::Greedy, meshSectionHeight};
    const BlockSource terrain = [=](int x, int y, int z) {
        return randomBlocks(Mix::Terrain, 11)(x, y, z - bottom);
    };
    Edited edited(terrain, {bottom, bottom + 256});
    MeshScratch scratch;
    ChunkMesh mesh = meshChunk(edited.area.input(options), scratch);
    for (unsigned step = 0; step < 300; ++step) {
        const auto random = [&](unsigned k, unsigned count) {
            return static_cast<int>(shared::hash2(step, k, 5) % count);
        };
        int x = random(0, 16), y = random(1, 16);
        const int z = bottom + (step % 8 == 7 ? 255 * random(2, 2) : 24 + random(2, 40));
        if (random(3, 4) == 0) (random(4, 2) == 0 ? x : y) = random(5, 2) == 0 ? -1 : 16;
        edited.chunkAt(x, y).setBlock(world::blockIndex(x & 15, y & 15, z), anyId(shared::hash2(step, 6, 5)));
        MeshSectionSet meshSections;
        for (const TouchedChunk& touched : meshSectionsTouchedBy({x, y, z})) {
            if (touched.pos == world::ChunkPos{0, 0}) meshSections = touched.meshSections;
        }
        EXPECT_FALSE(meshSections.isEmpty());
        mesh = withMeshSections(mesh, buildMeshSections(edited.area.input(options), meshSections, scratch),
                                meshSections);
        ASSERT_EQ(mesh, meshChunk(edited.area.input(options), scratch)) << x << ' ' << y << ' ' << z;
    }
}

INSTANTIATE_TEST_SUITE_P(All, RemeshHeights,
                         testing::Combine(testing::Values(8, 16, 32, 64, 128),
                                          testing::Values(0, -2048, 1792, -144)));

constexpr MeshOptions kFourMeshSections{.meshSectionHeight = 64};

// The mesh sections left out are not read: they stay as they were even if that is wrong by now.
TEST(WithMeshSections, OthersAreCopied) {
    Edited edited(randomBlocks(Mix::Terrain, 12));
    MeshScratch scratch;
    const ChunkMesh before = meshChunk(edited.area.input(kFourMeshSections), scratch);
    edited.area.center.setBlock(world::blockIndex(8, 8, 40), idOf("lava"));
    edited.area.center.setBlock(world::blockIndex(8, 8, 120), idOf("lava"));
    const ChunkMesh after = meshChunk(edited.area.input(kFourMeshSections), scratch);
    EXPECT_EQ(withMeshSections(before, after, {}), before);
    EXPECT_EQ(withMeshSections(before, after, kAllMeshSections), after);
    const ChunkMesh upper = withMeshSections(before, after, setOf({14}));
    EXPECT_EQ(upper.meshSections[0], before.meshSections[0]);
    ASSERT_EQ(upper.meshSections.size(), 2u);
    EXPECT_EQ(before.meshSections.size(), 1u) << "air";
}

// A mesh section may get its first quads, or lose its last ones.
TEST(WithMeshSections, TheyComeAndGo) {
    Edited edited([](int, int, int z) { return z == 100 ? idOf("stone") : world::kAir; }, {-2048, 2048});
    MeshScratch scratch;
    ChunkMesh mesh = meshChunk(edited.area.input(), scratch);
    const ChunkMesh before = mesh;
    const auto setBlock = [&](int z, world::BlockId id) {
        edited.area.center.setBlock(world::blockIndex(8, 8, z), id);
        const MeshSectionSet touched = meshSectionsTouchedBy({8, 8, z})[0].meshSections;
        mesh = withMeshSections(mesh, buildMeshSections(edited.area.input(), touched, scratch), touched);
        EXPECT_EQ(mesh, meshChunk(edited.area.input(), scratch));
    };
    for (const int z : {-2048, 40, 2047, -16, 100}) setBlock(z, idOf("lava"));
    EXPECT_EQ(mesh.meshSections.size(), 5u);
    for (const int z : {40, 2047, -16, -2048}) setBlock(z, world::kAir);
    setBlock(100, idOf("stone"));
    EXPECT_EQ(mesh, before);
}

TEST(BuildMeshSections, OthersAreLeftOut) {
    const Area area(randomBlocks(Mix::Terrain, 13));
    MeshScratch scratch;
    const ChunkMesh all = meshChunk(area.input(kFourMeshSections), scratch);
    ASSERT_EQ(all.meshSections.front().bottom, 0);
    const MeshSectionSet upper = MeshSectionSet::all({64, 256});
    const ChunkMesh none = buildMeshSections(area.input(kFourMeshSections), upper, scratch);
    EXPECT_EQ(none, ChunkMesh());
    EXPECT_EQ(withMeshSections(all, none, upper), all);
    EXPECT_EQ(buildMeshSections(area.input(kFourMeshSections), kAllMeshSections, scratch), all);
}

TEST(MeshSectionsTouchedBy, RefusesBlocksOutsideOfEveryWorld) {
    EXPECT_THROW(meshSectionsTouchedBy({5, 6, -2049}), std::invalid_argument);
    EXPECT_THROW(meshSectionsTouchedBy({5, 6, 2048}), std::invalid_argument);
}

}  // namespace
}  // namespace terrane::mesh

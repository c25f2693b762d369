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

TEST(MeshSectionsTouchedBy, ABlockInTheMiddleTouchesItsMeshSection) {
    EXPECT_EQ(meshSectionsTouchedBy({5, 6, 70}, 64), (Touched{{{0, 0}, 0b0010}}));
    EXPECT_EQ(meshSectionsTouchedBy({-5, -6, 70}, 8), (Touched{{{-1, -1}, 1u << 8}}));
}

TEST(MeshSectionsTouchedBy, BordersTouchWhatIsBeyond) {
    EXPECT_EQ(meshSectionsTouchedBy({5, 6, 64}, 64), (Touched{{{0, 0}, 0b0011}}));
    EXPECT_EQ(meshSectionsTouchedBy({5, 6, 63}, 64), (Touched{{{0, 0}, 0b0011}}));
    EXPECT_EQ(meshSectionsTouchedBy({16, 6, 70}, 64), (Touched{{{1, 0}, 0b0010}, {{0, 0}, 0b0010}}));
    EXPECT_EQ(meshSectionsTouchedBy({-1, 15, 63}, 64),
              (Touched{{{-1, 0}, 0b0011}, {{0, 0}, 0b0001}, {{-1, 1}, 0b0001}}));
}

TEST(MeshSectionsTouchedBy, NothingIsOutsideTheWorld) {
    EXPECT_EQ(meshSectionsTouchedBy({5, 6, 0}, 32), (Touched{{{0, 0}, 1}}));
    EXPECT_EQ(meshSectionsTouchedBy({5, 6, 255}, 32), (Touched{{{0, 0}, 0x80}}));
    const auto last = std::numeric_limits<std::int32_t>::max();
    EXPECT_EQ(meshSectionsTouchedBy({last, last, 9}, 32),
              (Touched{{{world::kMaxChunk, world::kMaxChunk}, 1}}));
}

// Chunk 0, 0 and one beside it, of which blocks are changed.
struct Edited {
    Area area;
    explicit Edited(const BlockSource& source) : area(source) {}

    // x −16…31 or y −16…31: in the chunk or beside it.
    world::Chunk& chunkAt(int x, int y) {
        if (x < 0) return area.beside[0];
        if (x > 15) return area.beside[1];
        if (y < 0) return area.beside[2];
        if (y > 15) return area.beside[3];
        return area.center;
    }
};

class RemeshHeights : public testing::TestWithParam<int> {};

// After any edit in or beside the chunk the touched mesh sections are enough, whatever the block types.
TEST_P(RemeshHeights, TouchedMeshSectionsAreEnough) {
    const MeshOptions options{MergeMethod::Greedy, GetParam()};
    Edited edited(randomBlocks(Mix::Terrain, 11));
    MeshScratch scratch;
    ChunkMesh mesh = meshChunk(edited.area.input(options), scratch);
    for (unsigned step = 0; step < 300; ++step) {
        const auto random = [&](unsigned k, unsigned count) {
            return static_cast<int>(shared::hash2(step, k, 5) % count);
        };
        int x = random(0, 16), y = random(1, 16);
        const int z = 24 + random(2, 40);
        if (random(3, 4) == 0) (random(4, 2) == 0 ? x : y) = random(5, 2) == 0 ? -1 : 16;
        edited.chunkAt(x, y).setBlock(world::blockIndex(x & 15, y & 15, z), anyId(shared::hash2(step, 6, 5)));
        MeshSectionSet meshSections = 0;
        for (const TouchedChunk& touched : meshSectionsTouchedBy({x, y, z}, options.meshSectionHeight)) {
            if (touched.pos == world::ChunkPos{0, 0}) meshSections = touched.meshSections;
        }
        EXPECT_NE(meshSections, 0u);
        mesh = withMeshSections(mesh, buildMeshSections(edited.area.input(options), meshSections, scratch),
                                meshSections);
        ASSERT_EQ(mesh, meshChunk(edited.area.input(options), scratch)) << x << ' ' << y << ' ' << z;
    }
}

INSTANTIATE_TEST_SUITE_P(All, RemeshHeights, testing::Values(8, 16, 32, 64, 128));

constexpr MeshOptions kFourMeshSections{.meshSectionHeight = 64};

// The mesh sections left out are not read: they stay as they were even if that is wrong by now.
TEST(WithMeshSections, OthersAreCopied) {
    Edited edited(randomBlocks(Mix::Terrain, 12));
    MeshScratch scratch;
    const ChunkMesh before = meshChunk(edited.area.input(kFourMeshSections), scratch);
    edited.area.center.setBlock(world::blockIndex(8, 8, 40), idOf("lava"));
    edited.area.center.setBlock(world::blockIndex(8, 8, 120), idOf("lava"));
    const ChunkMesh after = meshChunk(edited.area.input(kFourMeshSections), scratch);
    EXPECT_EQ(withMeshSections(before, after, 0), before);
    EXPECT_EQ(withMeshSections(before, after, kAllMeshSections), after);
    const ChunkMesh upper = withMeshSections(before, after, 0b0010);
    EXPECT_EQ(upper.meshSections[0], before.meshSections[0]);
    EXPECT_NE(upper.meshSections[1], before.meshSections[1]);
}

TEST(BuildMeshSections, OthersAreEmpty) {
    const Area area(randomBlocks(Mix::Terrain, 13));
    MeshScratch scratch;
    const ChunkMesh all = meshChunk(area.input(kFourMeshSections), scratch);
    ASSERT_GT(all.meshSections[0].maxZ, 0);
    const ChunkMesh none = buildMeshSections(area.input(kFourMeshSections), 0b1110, scratch);
    EXPECT_EQ(none.meshSections[0], MeshSection{});
    EXPECT_EQ(withMeshSections(all, none, 0b1110), all);
    EXPECT_EQ(buildMeshSections(area.input(kFourMeshSections), kAllMeshSections, scratch), all);
}

TEST(MeshSectionsTouchedBy, RefusesWhatIsNotInTheWorld) {
    EXPECT_THROW(meshSectionsTouchedBy({5, 6, -1}, 64), std::invalid_argument);
    EXPECT_THROW(meshSectionsTouchedBy({5, 6, 256}, 64), std::invalid_argument);
    EXPECT_THROW(meshSectionsTouchedBy({5, 6, 7}, 0), std::invalid_argument);
}

TEST(WithMeshSections, NeedsMeshesOfOneHeight) {
    const Area area(randomBlocks(Mix::Dense, 1));
    const ChunkMesh low = meshOf(area, {MergeMethod::None, 32}), high = meshOf(area, {MergeMethod::None, 64});
    EXPECT_THROW(withMeshSections(low, high, 1), std::invalid_argument);
}

}  // namespace
}  // namespace terrane::mesh

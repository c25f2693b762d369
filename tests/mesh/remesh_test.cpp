#include "terrane/mesh/remesh.h"

#include <gtest/gtest.h>

#include <limits>

#include "terrane/shared/hash.h"
#include "tests/mesh/mesh_fixture.h"
#include "tests/mesh/random_blocks.h"

namespace terrane::mesh {
namespace {

using Touched = std::vector<TouchedChunk>;

TEST(RegionsTouchedBy, ABlockInTheMiddleTouchesItsRegion) {
    EXPECT_EQ(regionsTouchedBy({5, 6, 70}, 64), (Touched{{{0, 0}, 0b0010}}));
    EXPECT_EQ(regionsTouchedBy({-5, -6, 70}, 8), (Touched{{{-1, -1}, 1u << 8}}));
}

TEST(RegionsTouchedBy, BordersTouchWhatIsBeyond) {
    EXPECT_EQ(regionsTouchedBy({5, 6, 64}, 64), (Touched{{{0, 0}, 0b0011}}));
    EXPECT_EQ(regionsTouchedBy({5, 6, 63}, 64), (Touched{{{0, 0}, 0b0011}}));
    EXPECT_EQ(regionsTouchedBy({16, 6, 70}, 64), (Touched{{{1, 0}, 0b0010}, {{0, 0}, 0b0010}}));
    EXPECT_EQ(regionsTouchedBy({-1, 15, 63}, 64),
              (Touched{{{-1, 0}, 0b0011}, {{0, 0}, 0b0001}, {{-1, 1}, 0b0001}}));
}

TEST(RegionsTouchedBy, NothingIsOutsideTheWorld) {
    EXPECT_EQ(regionsTouchedBy({5, 6, 0}, 32), (Touched{{{0, 0}, 1}}));
    EXPECT_EQ(regionsTouchedBy({5, 6, 255}, 32), (Touched{{{0, 0}, 0x80}}));
    const auto last = std::numeric_limits<std::int32_t>::max();
    EXPECT_EQ(regionsTouchedBy({last, last, 9}, 32), (Touched{{{world::kMaxChunk, world::kMaxChunk}, 1}}));
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
        return area.centre;
    }
};

class RemeshHeights : public testing::TestWithParam<int> {};

// After any edit in or beside the chunk the touched regions are enough, whatever the block types.
TEST_P(RemeshHeights, TouchedRegionsAreEnough) {
    const MeshOptions options{Method::Greedy, GetParam()};
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
        RegionSet regions = 0;
        for (const TouchedChunk& touched : regionsTouchedBy({x, y, z}, options.regionHeight)) {
            if (touched.pos == world::ChunkPos{0, 0}) regions = touched.regions;
        }
        EXPECT_NE(regions, 0u);
        mesh = withRegions(mesh, meshRegions(edited.area.input(options), regions, scratch), regions);
        ASSERT_EQ(mesh, meshChunk(edited.area.input(options), scratch)) << x << ' ' << y << ' ' << z;
    }
}

INSTANTIATE_TEST_SUITE_P(All, RemeshHeights, testing::Values(8, 16, 32, 64, 128));

constexpr MeshOptions kFourRegions{.regionHeight = 64};

// The regions left out are not looked at: they stay as they were even where that is wrong by now.
TEST(WithRegions, OthersAreCopied) {
    Edited edited(randomBlocks(Mix::Terrain, 12));
    MeshScratch scratch;
    const ChunkMesh before = meshChunk(edited.area.input(kFourRegions), scratch);
    edited.area.centre.setBlock(world::blockIndex(8, 8, 40), idOf("lava"));
    edited.area.centre.setBlock(world::blockIndex(8, 8, 120), idOf("lava"));
    const ChunkMesh after = meshChunk(edited.area.input(kFourRegions), scratch);
    EXPECT_EQ(withRegions(before, after, 0), before);
    EXPECT_EQ(withRegions(before, after, kAllRegions), after);
    const ChunkMesh upper = withRegions(before, after, 0b0010);
    EXPECT_EQ(upper.regions[0], before.regions[0]);
    EXPECT_NE(upper.regions[1], before.regions[1]);
}

TEST(MeshRegions, OthersAreEmpty) {
    const Area area(randomBlocks(Mix::Terrain, 13));
    MeshScratch scratch;
    const ChunkMesh all = meshChunk(area.input(kFourRegions), scratch);
    ASSERT_GT(all.regions[0].maxZ, 0);
    const ChunkMesh none = meshRegions(area.input(kFourRegions), 0b1110, scratch);
    EXPECT_EQ(none.regions[0], RegionMesh{});
    EXPECT_EQ(withRegions(all, none, 0b1110), all);
    EXPECT_EQ(meshRegions(area.input(kFourRegions), kAllRegions, scratch), all);
}

}  // namespace
}  // namespace terrane::mesh

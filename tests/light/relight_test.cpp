#include "terrane/light/relight.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "tests/light/lit_area.h"
#include "tests/light/reference_light.h"
#include "tests/light/tall_worlds.h"
#include "tests/support/default_heights.h"
#include "tests/support/depth.h"

namespace terrane::light {
namespace {

using world::BlockId;
using world::BlockPos;
using world::ChunkPos;

TestArea::Source airAbove(int height) {
    const BlockId stone = contentBlock("stone");
    return [=](int, int, int z) { return z < height ? stone : world::kAir; };
}

// Stone with an empty layer at z = 50.
TestArea::Source darkHall() {
    const BlockId stone = contentBlock("stone");
    return [=](int, int, int z) { return z == 50 ? world::kAir : stone; };
}

TEST(Relight, LampIsPlacedAndRemovedAtACorner) {
    LitArea lit(TestArea(3, 3, darkHall()), {-1, -1});
    lit.set(16, 16, 50, contentBlock("lamp_green"));
    lit.relightEdits();
    EXPECT_EQ(levelOf(lit.at(16, 16, 50), kGreen), 15);
    EXPECT_EQ(levelOf(lit.at(15, 16, 50), kGreen), 14);
    EXPECT_EQ(levelOf(lit.at(15, 15, 50), kGreen), 13);
    EXPECT_EQ(levelOf(lit.at(9, 9, 50), kGreen), 1);
    EXPECT_EQ(levelOf(lit.at(9, 8, 50), kGreen), 0);
    EXPECT_EQ(levelOf(lit.at(30, 16, 50), kGreen), 1);
    lit.set(16, 16, 50, world::kAir);
    lit.relightEdits();
    for (int x = 0; x < 48; ++x) EXPECT_EQ(lit.at(x, 16, 50), kDark) << x;
}

// A lamp's last levels lie in the brick above or below.
TEST(Relight, LampInAShaftReachesFourteenBlocksUpAndDown) {
    const BlockId stone = contentBlock("stone");
    LitArea lit(
        TestArea(1, 1, [&](int x, int y, int z) { return x == 8 && y == 8 && z < 90 ? world::kAir : stone; }),
        {0, 0});
    for (const int z : {28, 19, 7, 16}) {
        lit.set(8, 8, z, contentBlock("lamp_red"));
        lit.relightEdits();
        EXPECT_EQ(levelOf(lit.at(8, 8, z + 14), kRed), 1);
        EXPECT_EQ(levelOf(lit.at(8, 8, z + 15), kRed), 0);
        if (z >= 14) {
            EXPECT_EQ(levelOf(lit.at(8, 8, z - 14), kRed), 1);
        }
        lit.set(8, 8, z, world::kAir);
        lit.relightEdits();
        for (int k = 0; k < 90; ++k) EXPECT_EQ(lit.at(8, 8, k), kDark) << k;
    }
}

// The light of the other lamp fills the place of a removed one.
TEST(Relight, OtherLampsShineOn) {
    LitArea lit(TestArea(3, 3, darkHall()), {5, 5});
    lit.set(20, 24, 50, contentBlock("lamp_red"));
    lit.set(28, 24, 50, contentBlock("lamp_red"));
    lit.relightEdits();
    EXPECT_EQ(levelOf(lit.at(21, 24, 50), kRed), 14);
    EXPECT_EQ(levelOf(lit.at(24, 24, 50), kRed), 11);
    lit.set(20, 24, 50, world::kAir);
    lit.relightEdits();
    EXPECT_EQ(levelOf(lit.at(27, 24, 50), kRed), 14);
    EXPECT_EQ(levelOf(lit.at(21, 24, 50), kRed), 8);
    EXPECT_EQ(levelOf(lit.at(20, 24, 50), kRed), 7);
}

// A roof over a hall 90 blocks high: the opened column is daylit to the floor.
TEST(Relight, RoofIsOpenedAndClosed) {
    const BlockId stone = contentBlock("stone");
    LitArea lit(TestArea(3, 3, [&](int, int, int z) { return z < 10 || z == 100 ? stone : world::kAir; }),
                {0, 0});
    EXPECT_EQ(lit.at(20, 20, 10), kDark);
    lit.set(20, 20, 100, world::kAir);
    const auto changes = lit.relightEdits();
    EXPECT_EQ(levelOf(lit.at(20, 20, 100), kDaylight), 15);
    EXPECT_EQ(levelOf(lit.at(20, 20, 10), kDaylight), 15);
    EXPECT_EQ(levelOf(lit.at(20, 20, 9), kDaylight), 0);
    EXPECT_EQ(levelOf(lit.at(15, 20, 10), kDaylight), 10);
    EXPECT_EQ(levelOf(lit.at(22, 23, 60), kDaylight), 10);
    EXPECT_EQ(levelOf(lit.at(20, 6, 40), kDaylight), 1);
    // 14 blocks aside, of which 5 lead out at −x and −y, 12 at +x and +y: of the chunks at the corners only
    // the one at −x −y.
    EXPECT_EQ(changes.size(), 6u);
    for (const LightChange& change : changes)
        EXPECT_EQ(change.bricks, world::SectionSet::all({0, 112})) << change.pos.x;
    lit.set(20, 20, 100, contentBlock("oak_leaves"));
    lit.relightEdits();
    EXPECT_EQ(levelOf(lit.at(20, 20, 10), kDaylight), 12);
    EXPECT_EQ(levelOf(lit.at(20, 23, 60), kDaylight), 9);
    lit.set(20, 20, 100, stone);
    lit.relightEdits();
    EXPECT_EQ(lit.at(20, 20, 10), kDark);
    EXPECT_EQ(lit.at(22, 23, 60), kDark);
}

TEST(Relight, WallShadesFromALamp) {
    LitArea lit(TestArea(3, 3, darkHall()), {0, 0});
    lit.set(24, 24, 50, contentBlock("lamp_blue"));
    lit.relightEdits();
    EXPECT_EQ(levelOf(lit.at(26, 24, 50), kBlue), 13);
    lit.set(25, 24, 50, contentBlock("stone"));
    lit.relightEdits();
    EXPECT_EQ(levelOf(lit.at(25, 24, 50), kBlue), 0);
    EXPECT_EQ(levelOf(lit.at(26, 24, 50), kBlue), 11);  // round the wall: four blocks
    lit.set(25, 24, 50, contentBlock("water"));
    lit.relightEdits();
    EXPECT_EQ(levelOf(lit.at(25, 24, 50), kBlue), 13);
    EXPECT_EQ(levelOf(lit.at(26, 24, 50), kBlue), 12);
}

TEST(Relight, ReportsNothingWhereNoLightChanges) {
    LitArea lit(TestArea(1, 1, airAbove(100)), {0, 0});
    lit.set(5, 5, 50, contentBlock("dirt"));  // stone before: both opaque
    EXPECT_TRUE(lit.relightEdits().empty());
    EXPECT_TRUE(lit.relightEdits().empty());
}

TEST(Relight, TakesASeveralTimesChangedBlockFromItsFirst) {
    LitArea lit(TestArea(1, 1, darkHall()), {0, 0});
    lit.set(5, 5, 50, contentBlock("lamp_red"));
    lit.set(5, 5, 50, contentBlock("lamp_blue"));
    lit.relightEdits();
    EXPECT_EQ(lit.at(6, 5, 50), 14 << 8);
}

TEST(Relight, LeavesChunksWithoutLightAlone) {
    LitChunks chunks;
    chunks[{0, 0}] = {std::make_shared<world::Chunk>(), nullptr};
    const world::BlockEdit edits[] = {{{3, 3, 3}, contentBlock("stone"), world::kAir},
                                      {{99, 99, 3}, contentBlock("stone"), world::kAir}};
    LightScratch scratch;
    EXPECT_TRUE(relight(chunks, edits, contentTable(), scratch).empty());
    EXPECT_EQ((chunks[{0, 0}].light), nullptr);
}

// Snapshots of the old light stay unchanged; unchanged chunks keep their snapshot.
TEST(Relight, MakesNewSnapshots) {
    LightScratch scratch;
    world::Chunk chunk = TestArea::makeChunk(0, 0, darkHall());
    const TestArea area(1, 1, darkHall());
    LightWindow window;
    const ChunkLightPtr before = std::make_shared<ChunkLight>(area.lights()[0]);
    chunk.setBlock(world::blockIndex(8, 8, 50), contentBlock("lamp_red"));
    window.chunks[kCenterChunk] = &chunk;
    window.lights[kCenterChunk] = before;
    const BlockChange changes[] = {{world::blockIndex(8, 8, 50), world::kAir}};
    const ChangedBricks bricks = relight(window, changes, contentTable(), scratch);
    EXPECT_EQ(bricks[kCenterChunk], world::SectionSet::all({48, 64}));
    EXPECT_EQ(before->get(8, 8, 50), kDark);
    EXPECT_EQ(window.lights[kCenterChunk]->get(8, 8, 50), 15);
    const ChunkLightPtr lit = window.lights[kCenterChunk];
    EXPECT_EQ(relight(window, {}, contentTable(), scratch), ChangedBricks{});
    EXPECT_EQ(window.lights[kCenterChunk], lit);
}

void expectFromScratch(const LitArea& lit) {
    const std::vector<ChunkLight> expected = lit.area().lights(), found = lit.lights();
    for (std::size_t k = 0; k < expected.size(); ++k) {
        if (found[k] == expected[k]) continue;
        const world::Heights heights = lit.area().heights;
        for (world::BlockIndex i = 256 * heights.bottom; i < 256 * heights.top; ++i) {
            ASSERT_EQ(found[k].at(i), expected[k].at(i))
                << "chunk " << k << " at " << (i & 15) << ' ' << (i >> 4 & 15) << ' ' << (i >> 8);
        }
    }
}

const int kEditsAWorld = atDepth(200, 1500);

// Edits single blocks and batches of 2 to 12, and compares after the first and then after every 10 edits or
// more.
void editRandomly(const TestArea::Source& source, std::uint32_t seed, ChunkPos corner,
                  world::Heights heights = {}) {
    LitArea lit(TestArea(3, 3, source, heights), corner);
    Random random(seed);
    int untilCompared = 0;
    for (int edits = 0; edits < kEditsAWorld && !testing::Test::HasFatalFailure();) {
        const int batch = random.below(4) == 0 ? 2 + random.below(11) : 1;
        for (int k = 0; k < batch; ++k) {
            const BlockPos p = randomPlace(random, lit.area());
            lit.set(p.x, p.y, p.z, randomBlock(random));
        }
        lit.relightEdits();
        edits += batch;
        untilCompared -= batch;
        if (untilCompared > 0) continue;
        SCOPED_TRACE("after edit " + std::to_string(edits));
        expectFromScratch(lit);
        untilCompared = 10;
    }
    expectFromScratch(lit);
    // The formula takes a minute where a world is very tall.
    if (heights.layers() <= 512) expectReference(lit.area(), lit.area().flatten(lit.lights()), heights.top);
}

TEST(RelightRandom, CavesAtTheOrigin) {
    editRandomly(caves(1), 1, {0, 0});
}
TEST(RelightRandom, CavesAtNegativeCoordinates) {
    editRandomly(caves(2), 2, {-2, -2});
}
TEST(RelightRandom, ScatteredBlocks) {
    editRandomly(scattered(3, 6), 3, {-1, 7});
}
TEST(RelightRandom, FewBlocks) {
    editRandomly(scattered(4, 60), 4, {-1, -1});
}
TEST(RelightRandom, Layers) {
    editRandomly(layers(5), 5, {world::kMaxChunk - 2, world::kMinChunk});
}
TEST(RelightRandom, SolidGround) {
    const BlockId stone = contentBlock("stone");
    editRandomly([=](int, int, int z) { return z < kFilledHeight ? stone : world::kAir; }, 6, {3, -3});
}
TEST(RelightRandom, Sea) {
    const BlockId water = contentBlock("water");
    editRandomly([=](int, int, int z) { return z < kFilledHeight ? water : world::kAir; }, 7, {0, 0});
}

TEST(RelightRandom, WorldsOfOtherHeights) {
    for (std::uint32_t seed = 0; seed < 10; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const TallWorld world = tallWorld(seed);
        editRandomly(world, seed, {-1, static_cast<int>(seed)}, world.heights);
        if (HasFailure()) return;
    }
}

// A shaft through the whole world, opened and closed at its top, through rock and through caves, at the
// border of chunks and inside one.
TEST(Relight, ShaftsOfAnyDepthAreOpenedAndClosed) {
    for (const std::uint32_t seed : {0u, 1u, 3u, 7u}) {
        const TallWorld world = tallWorld(seed);
        const BlockId stone = contentBlock("stone");
        const int cap = world.heights.top - 3;
        for (const bool isInRock : {true, false}) {
            for (const int at : {24, 16}) {
                LitArea lit(TestArea(
                                3, 3,
                                [&](int x, int y, int z) {
                                    if (z == cap) return stone;
                                    if (x == at && y == 24) return world::kAir;
                                    return isInRock ? stone : world(x, y, z);
                                },
                                world.heights),
                            {0, 0});
                for (const BlockId id : {world::kAir, contentBlock("oak_leaves"), stone}) {
                    lit.set(at, 24, cap, id);
                    lit.relightEdits();
                    const int level = id == stone ? 0 : id == world::kAir ? 15 : 12;
                    if (isInRock) {
                        EXPECT_EQ(levelOf(lit.at(at, 24, world.heights.bottom), kDaylight), level);
                    }
                    expectFromScratch(lit);
                }
                if (HasFailure()) return;
            }
        }
    }
}

// Chunks around the changed one may be missing: light from and through them is lost.
TEST(Relight, NeighborsMayBeMissingInTallWorlds) {
    const TallWorld world = tallWorld(7);
    for (const int missing : {1, 3, 8}) {
        TestArea area(3, 3, world, world.heights);
        const BlockId stone = contentBlock("stone"), lamp = contentBlock("lamp_white");
        area.chunks[static_cast<std::size_t>(missing)] = TestArea::makeChunk(
            0, 0, [&](int, int, int) { return stone; }, world.heights);
        LightWindow window;
        std::vector<ChunkLight> lights = area.lights();
        for (std::size_t k = 0; k < lights.size(); ++k) {
            if (k == static_cast<std::size_t>(missing)) continue;
            window.chunks[k] = &area.chunks[k];
            window.lights[k] = std::make_shared<ChunkLight>(lights[k]);
        }
        LightScratch scratch;
        for (const int z : {-1024, -1009, -512, -1, 0, 300, 1008, 1023}) {
            const BlockChange change{world::blockIndex(15, 1, z),
                                     area.chunks[kCenterChunk].block(world::blockIndex(15, 1, z))};
            area.chunks[kCenterChunk].setBlock(change.index, lamp);
            relight(window, {&change, 1}, contentTable(), scratch);
        }
        lights = area.lights();
        for (std::size_t k = 0; k < lights.size(); ++k) {
            if (window.lights[k]) {
                EXPECT_TRUE(*window.lights[k] == lights[k]) << missing << ' ' << k;
            }
        }
    }
}

TEST(Relight, NeedsTheChunkThatChanged) {
    LightWindow window;
    LightScratch scratch;
    EXPECT_THROW(relight(window, {}, LightTable(contentBlocks()), scratch), std::invalid_argument);
}

}  // namespace
}  // namespace terrane::light

#include "terrane/stream/edited_tiles.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

#include "terrane/stream/tile_table.h"
#include "tests/stream/edited_world.h"
#include "tests/support/depth.h"

namespace terrane::stream {
namespace {

using world::BlockBox;
using world::BlockPos;
using world::ChunkPos;
using world::ChunkPtr;

const gen::LevelGenerators& flat() {
    static const gen::LevelGenerators all = generatorsOf("flat");
    return all;
}

const gen::LevelGenerators& hills() {
    static const gen::LevelGenerators all(hillsOf, 5);
    return all;
}

TEST(EditedTiles, WithoutEditsNothingIsGenerated) {
    std::set<int> made;
    const gen::LevelGenerators generators(
        [&](int level) {
            made.insert(level);
            return hillsOf(level);
        },
        5);
    const auto none = [](ChunkPos) { return ChunkPtr(); };
    const std::vector<ChunkPos> chunks{{-3, 2}, {0, 0}};
    EXPECT_TRUE(tilesAfterEdits(generators, EditedWorld::rule(), chunks, none).empty());
    EXPECT_TRUE(made.empty());
}

TEST(EditedTiles, AChunkAsGeneratedChangesNothing) {
    EditedWorld world(hills(), 6);
    world.restore({{-20, -20, 50}, {20, 20, 70}});
    EXPECT_TRUE(world.update().empty());
}

// Eight blocks in a square, at negative and positive coordinates.
TEST(EditedTiles, OnlyColumnsOverEditsDiffer) {
    for (const int x : {-24, -8, 8, 40}) {
        EditedWorld world(hills(), 3);
        world.fill({{x, -8, 100}, {x + 7, -1, 110}}, "stone");
        const auto changes = world.update();
        ASSERT_EQ(changes.size(), 3u);
        for (std::size_t k = 0; k < 3; ++k) {
            const ChunkPos pos = changes[k].pos;
            const int level = static_cast<int>(k) + 1;
            ASSERT_EQ(int{pos.level}, level) << "lowest level first";
            for (int i = 0; i < 256; ++i) {
                const auto index = world::blockIndex(i & 15, i >> 4, 105);
                const BlockPos at = world::blockPos(pos, index);
                const bool isInside = at.x >= x && at.x <= x + 7 && at.y >= -8 && at.y <= -1;
                ASSERT_EQ(changes[k].tile->block(index), isInside ? contentBlock("stone") : world::kAir);
                for (int z = 0; z < 256 && !isInside; ++z) {
                    const auto below = world::blockIndex(i & 15, i >> 4, z);
                    ASSERT_EQ(changes[k].tile->block(below), world.generated(pos).block(below));
                }
            }
        }
    }
}

TEST(EditedTiles, MinesAreNotSeen) {
    EditedWorld world(flat(), 6);
    world.fill({{-40, -3, 40}, {40, 3, 60}}, "air");
    EXPECT_TRUE(world.update().empty());
    world.fill({{-5, -3, 61}, {5, 3, 80}}, "air");
    world.update();
    EXPECT_EQ(world.block(1, 0, 0, 50), world::kAir) << "open from above";
    EXPECT_EQ(world.block(1, 0, 0, 39), contentBlock("stone"));
    EXPECT_EQ(world.block(1, -17, 0, 50), contentBlock("stone")) << "another chunk, closed";
}

TEST(EditedTiles, ASmallThingEndsTheClimb) {
    EditedWorld world(hills(), world::kMaxLevel);
    std::size_t highest = 0;
    for (int x = 0; x < 64; ++x) {
        world.fill({{x * 16, 0, 120}, {x * 16, 0, 130}}, "stone");
        highest = std::max(highest, world.update().size());
    }
    EXPECT_GE(highest, 2u);
    EXPECT_LT(highest, 9u) << "of 64 towers about one reaches level 3";
}

// Blocks placed and broken, towers, pits, walls, pools, lamps, and generated blocks put back.
class RandomEdits {
  public:
    explicit RandomEdits(EditedWorld& world) : world_(world) {}

    void make() {
        static const std::vector<std::string> blocks{"stone", "oak_leaves", "cyan_glass", "lamp_red",
                                                     "poppy", "water",      "sand",       "glowing_ore"};
        const BlockPos low{between(-40, 40), between(-40, 40), between(40, 90)};
        const std::string& block = blocks[random_() % blocks.size()];
        switch (random_() % 8) {
            case 0:
            case 1:
                return world_.set(low, block);
            case 2:
            case 3:
                return world_.set(low, "air");
            case 4:
                return world_.fill({low, {low.x, low.y, low.z + between(1, 60)}}, block);
            case 5:
                return world_.fill(boxAt(low, 6, 12), "air");
            case 6:
                return world_.fill(boxAt(low, 5, 5), block);
            default:
                return world_.restore(boxAt(low, 16, 100));
        }
    }

  private:
    int between(int low, int high) {
        return low + static_cast<int>(random_() % static_cast<std::uint32_t>(high - low + 1));
    }
    BlockBox boxAt(BlockPos low, int width, int height) {
        return {low, {low.x + between(0, width), low.y + between(0, width), low.z + between(0, height)}};
    }

    EditedWorld& world_;
    std::mt19937 random_{9};
};

TEST(EditedTiles, StepByStepIsAsFromScratch) {
    const int kBatches = atDepth(30, 200);
    constexpr int kEdits = 50;
    EditedWorld world(hills(), 6);
    RandomEdits edits(world);
    for (int batch = 1; batch <= kBatches; ++batch) {
        for (int k = 0; k < (batch % 3 == 0 ? 3 * kEdits + 2 : 1); ++k) edits.make();
        world.update();
        if (batch % 20 != 0) continue;
        EXPECT_GT(world.tiles().size(), 10u);
        expectSameTiles(world.tiles(), world.tilesFromScratch());
        if (HasFatalFailure()) return;
    }
    world.restoreAll();
    world.update();
    EXPECT_TRUE(world.tiles().empty());
}

TEST(EditedTiles, TheOverworldToo) {
    const gen::LevelGenerators overworld = generatorsOf("overworld");
    EditedWorld world(overworld, 6);
    RandomEdits edits(world);
    for (int batch = 0; batch < 5; ++batch) {
        for (int k = 0; k < 10; ++k) edits.make();
        world.update();
    }
    world.fill({{-20, -20, 180}, {20, 20, 182}}, "stone");
    world.update();
    EXPECT_FALSE(world.tiles().empty());
    expectSameTiles(world.tiles(), world.tilesFromScratch());
    world.restoreAll();
    world.update();
    EXPECT_TRUE(world.tiles().empty());
}

TEST(EditedTiles, TheCornersOfTheWorldHaveTiles) {
    for (const std::int32_t corner : {INT32_MIN, INT32_MAX - 15}) {
        EditedWorld world(flat(), world::kMaxLevel);
        world.fill({{corner, corner, 150}, {corner + 15, corner + 15, 151}}, "lamp_white");
        EXPECT_EQ(world.update().size(), static_cast<std::size_t>(world::kMaxLevel));
        expectSameTiles(world.tiles(), world.tilesFromScratch());
    }
}

}  // namespace
}  // namespace terrane::stream

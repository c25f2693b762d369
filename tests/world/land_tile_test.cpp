#include "terrane/world/tint.h"

#include <gtest/gtest.h>

#include "tests/world/content_blocks.h"

namespace terrane::world {
namespace {

TEST(LandTile, HasTheTopmostBlockOfEachColumn) {
    Chunk chunk;
    chunk.setBlock(blockIndex(0, 0, 70), contentBlock("stone"));
    chunk.setBlock(blockIndex(3, 0, 70), contentBlock("stone"));
    chunk.setBlock(blockIndex(3, 0, 200), contentBlock("grass"));
    chunk.setBlock(blockIndex(0, 5, 255), contentBlock("stone"));
    chunk.setBlock(blockIndex(1, 5, 0), contentBlock("stone"));
    const LandTile tile = landTileOf(chunk, contentBlocks());
    EXPECT_EQ(tile.height[0], 71);
    EXPECT_EQ(tile.ground[0], contentBlock("stone"));
    EXPECT_EQ(tile.height[3], 201);
    EXPECT_EQ(tile.ground[3], contentBlock("grass"));
    EXPECT_EQ(tile.height[5 * 16], 256);
    EXPECT_EQ(tile.height[5 * 16 + 1], 1);
    EXPECT_EQ(tile.height[1], 0) << "nothing";
    EXPECT_EQ(tile.ground[1], kAir);
}

TEST(LandTile, WaterCountsAndPlantsDoNot) {
    Chunk chunk;
    int liquid = -1, plant = -1;
    for (std::size_t id = 0; id < contentBlocks().types().size(); ++id) {
        const Shape shape = contentBlocks().type(static_cast<BlockId>(id)).shape;
        if (shape == Shape::Liquid) liquid = static_cast<int>(id);
        if (shape == Shape::Cross) plant = static_cast<int>(id);
    }
    ASSERT_TRUE(liquid > 0 && plant > 0);
    chunk.setBlock(blockIndex(2, 2, 60), static_cast<BlockId>(liquid));
    chunk.setBlock(blockIndex(2, 2, 61), static_cast<BlockId>(plant));
    const LandTile tile = landTileOf(chunk, contentBlocks());
    EXPECT_EQ(tile.height[2 + 2 * 16], 61);
    EXPECT_EQ(tile.ground[2 + 2 * 16], liquid);
}

}  // namespace
}  // namespace terrane::world

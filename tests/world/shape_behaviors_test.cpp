#include "terrane/world/blocks/block_behavior.h"

#include <gtest/gtest.h>

#include <memory>

#include "terrane/world/blocks/block_model.h"
#include "terrane/world/changes/block_edit.h"
#include "tests/world/content_blocks.h"

namespace terrane::world {
namespace {

class ShapeBehaviors : public testing::Test {
  protected:
    ShapeBehaviors() { world_.insert({0, 0}, std::make_shared<Chunk>()); }
    std::size_t change(BlockPos pos, const BlockChange& what) {
        std::vector<BlockEdit> edits;
        applyChange(world_, contentBlocks(), pos, what, edits);
        return edits.size();
    }
    std::size_t put(BlockPos pos, std::string_view name, std::uint16_t state = 0) {
        return change(pos, SetBlock{contentBlock(name), state});
    }
    std::string_view at(BlockPos pos) const { return contentBlocks().type(world_.block(pos)).name; }
    World world_;
};

TEST_F(ShapeBehaviors, ATorchGoesWithWhatItStandsOn) {
    put({5, 5, 5}, "stone");
    put({5, 5, 6}, "torch");
    EXPECT_EQ(at({5, 5, 6}), "torch");
    put({5, 5, 5}, "air");
    EXPECT_EQ(at({5, 5, 6}), "air");
}

TEST_F(ShapeBehaviors, ATorchOnAWallGoesWithTheWallOnly) {
    put({5, 5, 5}, "stone");
    put({6, 5, 4}, "stone");
    put({6, 5, 5}, "torch", 1 | kStateOther);  // facing -x: the wall at x = 5
    EXPECT_EQ(at({6, 5, 5}), "torch");
    put({6, 5, 4}, "air");
    EXPECT_EQ(at({6, 5, 5}), "torch");
    put({5, 5, 5}, "air");
    EXPECT_EQ(at({6, 5, 5}), "air");
}

TEST_F(ShapeBehaviors, NothingStandsOrLeansOnAir) {
    put({5, 5, 6}, "torch");
    EXPECT_EQ(at({5, 5, 6}), "air");
    put({5, 5, 6}, "ladder", 2);
    EXPECT_EQ(at({5, 5, 6}), "air");
}

TEST_F(ShapeBehaviors, ALanternHangs) {
    put({5, 5, 7}, "stone");
    put({5, 5, 6}, "lantern", kStateUpsideDown);
    EXPECT_EQ(at({5, 5, 6}), "lantern");
    put({5, 5, 7}, "air");
    EXPECT_EQ(at({5, 5, 6}), "air");
}

TEST_F(ShapeBehaviors, FencesHaveArmsTowardEachOtherAndWalls) {
    put({5, 5, 5}, "oak_fence");
    EXPECT_EQ(world_.blockState({5, 5, 5}), 0);
    put({6, 5, 5}, "oak_fence");
    put({5, 4, 5}, "stone");
    EXPECT_EQ(world_.blockState({5, 5, 5}), (1u << kFacePosX | 1u << kFaceNegY) << kStateArmShift);
    EXPECT_EQ(world_.blockState({6, 5, 5}), 1u << kFaceNegX << kStateArmShift);
    put({6, 5, 5}, "air");
    put({5, 4, 5}, "torch");
    EXPECT_EQ(world_.blockState({5, 5, 5}), 0);
}

TEST_F(ShapeBehaviors, ADoorHasTwoHalves) {
    put({5, 5, 5}, "stone");
    put({5, 5, 6}, "oak_door", 2);
    EXPECT_EQ(at({5, 5, 7}), "oak_door_top");
    EXPECT_EQ(world_.blockState({5, 5, 7}), 2);
    EXPECT_EQ(change({5, 5, 7}, UseBlock{}), 2u);
    EXPECT_EQ(world_.blockState({5, 5, 6}), 2 | kStateOther);
    EXPECT_EQ(world_.blockState({5, 5, 7}), 2 | kStateOther);
    EXPECT_EQ(change({5, 5, 6}, UseBlock{}), 2u);
    EXPECT_EQ(world_.blockState({5, 5, 6}), 2);
    put({5, 5, 7}, "air");
    EXPECT_EQ(at({5, 5, 6}), "air");
}

TEST_F(ShapeBehaviors, ADoorGoesWithItsGroundAndNeedsRoom) {
    put({5, 5, 5}, "stone");
    put({5, 5, 7}, "stone");
    EXPECT_EQ(put({5, 5, 6}, "oak_door"), 0u);
    put({5, 5, 7}, "air");
    put({5, 5, 6}, "oak_door");
    put({5, 5, 5}, "air");
    EXPECT_EQ(at({5, 5, 6}), "air");
    EXPECT_EQ(at({5, 5, 7}), "air");
}

TEST_F(ShapeBehaviors, UsingAStoneDoesNothing) {
    put({5, 5, 5}, "stone");
    EXPECT_EQ(change({5, 5, 5}, UseBlock{}), 0u);
}

std::uint16_t stateOf(std::string_view name, const Placement& placement) {
    return placedState(*contentBlocks().find(name), placement);
}

TEST(PlacedState, StairsRiseWhereThePlayerLooks) {
    EXPECT_EQ(stateOf("stone_stairs", {kFacePosZ, 1, 90}), 0);
    EXPECT_EQ(stateOf("stone_stairs", {kFacePosZ, 1, 180}), 1);
    EXPECT_EQ(stateOf("stone_stairs", {kFacePosZ, 1, -95}), 2);
    EXPECT_EQ(stateOf("stone_stairs", {kFacePosZ, 1, 359}), 3);
}

TEST(PlacedState, UpsideDownUnderABlockAndAtTheUpperHalfOfASide) {
    EXPECT_EQ(stateOf("stone_stairs", {kFaceNegZ, 0, 90}), kStateUpsideDown);
    EXPECT_EQ(stateOf("stone_stairs", {kFaceNegX, 0.7f, 90}), kStateUpsideDown);
    EXPECT_EQ(stateOf("stone_stairs", {kFaceNegX, 0.3f, 90}), 0);
}

TEST(PlacedState, TorchesAndLaddersLeanAtTheWallThatIsBuiltOn) {
    EXPECT_EQ(stateOf("torch", {kFacePosX, 0.7f, 90}), 1 | kStateOther) << "the wall is at -x";
    EXPECT_EQ(stateOf("torch", {kFacePosZ, 1, 90}), 0);
    EXPECT_EQ(stateOf("ladder", {kFaceNegY, 0.7f, 0}), 0) << "the wall is at +y";
    EXPECT_EQ(stateOf("stone", {kFaceNegY, 0.7f, 0}), 0);
}

}  // namespace
}  // namespace terrane::world

#include "terrane/game/block_interaction.h"

#include "tests/game/session_fixture.h"

namespace terrane::game {
namespace {

class BlockInteractionTest : public SessionTest {
  protected:
    BlockInteractionTest() { session_.setPlayer(kLocalPlayer, player_.pose()); }

    void act(HeldButton& button) {
        button.press();
        interaction_.act(session_, kLocalPlayer, player_, 0.01);
        button.release();
    }

    // Looks straight down from 5 blocks above the ground.
    Player player_{{.position = {5.5, 5.5, kGroundHeight + 5.0}, .pitch = -89.9f}, Movement::Noclip};
    BlockInteraction interaction_{contentBlocks()};
};

TEST_F(BlockInteractionTest, BreaksTheBlockThatIsLookedAt) {
    act(interaction_.breaking);
    EXPECT_EQ(session_.world().block({5, 5, kGroundHeight - 1}), world::kAir);
    ASSERT_TRUE(interaction_.target());
    EXPECT_EQ(interaction_.target()->block, (world::BlockPos{5, 5, kGroundHeight - 2})) << "what is seen now";
}

TEST_F(BlockInteractionTest, BuildsOnTheFaceThatIsLookedAt) {
    selectBlock(interaction_.hotbar, contentBlock("sand"));
    act(interaction_.building);
    EXPECT_EQ(session_.world().block({5, 5, kGroundHeight}), contentBlock("sand"));
}

TEST_F(BlockInteractionTest, WhatIsBuiltTakesThePlaceOfGrass) {
    const world::BlockPos meadow{5, 5, kGroundHeight};
    session_.edit({kNoPlayer, meadow, world::SetBlock{contentBlock("tall_grass")}, {}});
    selectBlock(interaction_.hotbar, contentBlock("lamp_white"));
    act(interaction_.building);
    EXPECT_EQ(session_.world().block(meadow), contentBlock("lamp_white"));
    ASSERT_EQ(session_.undoOrRedo(kLocalPlayer, HistoryWay::Undo).blocks, 1u);
    EXPECT_EQ(session_.world().block(meadow), contentBlock("tall_grass"));
}

TEST_F(BlockInteractionTest, GrassBesideTheFaceIsReplaced) {
    const world::BlockPos stone{5, 5, kGroundHeight}, grass{6, 5, kGroundHeight};
    session_.edit({kNoPlayer, stone, world::SetBlock{contentBlock("stone")}, {}});
    session_.edit({kNoPlayer, grass, world::SetBlock{contentBlock("grass_tuft")}, {}});
    // Over the grass, at the stone's side.
    player_.placeAt({.position = {8.5, 5.5, kGroundHeight + 0.9}, .yaw = 180, .pitch = 0}, Movement::Noclip);
    session_.setPlayer(kLocalPlayer, player_.pose());
    selectBlock(interaction_.hotbar, contentBlock("glass"));
    act(interaction_.building);
    ASSERT_EQ(session_.world().block(grass), contentBlock("glass"));
    EXPECT_EQ(session_.world().block({7, 5, kGroundHeight}), world::kAir);
}

TEST_F(BlockInteractionTest, FlowersAndGrassOfTheSameKindStay) {
    for (const char* name : {"poppy", "tall_grass"}) {
        const world::BlockPos meadow{5, 5, kGroundHeight};
        session_.edit({kNoPlayer, meadow, world::SetBlock{contentBlock(name)}, {}});
        selectBlock(interaction_.hotbar, contentBlock("tall_grass"));
        act(interaction_.building);
        EXPECT_EQ(session_.world().block(meadow), contentBlock(name));
    }
}

TEST_F(BlockInteractionTest, WaterIsPlacedFlowsAndIsTaken) {
    const world::BlockId water = contentBlock("water");
    selectBlock(interaction_.hotbar, water);
    act(interaction_.building);
    ASSERT_EQ(session_.world().block({5, 5, kGroundHeight}), water);
    for (int second = 0; second < 4; ++second) session_.advance(1, {0, 0});
    EXPECT_EQ(session_.world().block({8, 5, kGroundHeight}), water);
    EXPECT_EQ(session_.world().blockState({8, 5, kGroundHeight}), 3);
    EXPECT_EQ(session_.world().blockState({5, 5, kGroundHeight}), 0);
    act(interaction_.building);
    EXPECT_EQ(session_.world().blockState({5, 5, kGroundHeight}), 0) << "there is a source already";
    act(interaction_.breaking);
    EXPECT_EQ(session_.world().block({5, 5, kGroundHeight}), world::kAir);
    EXPECT_EQ(session_.world().block({5, 5, kGroundHeight - 1}), contentBlock("stone"));
    for (int second = 0; second < 8; ++second) session_.advance(1, {0, 0});
    EXPECT_EQ(session_.world().block({8, 5, kGroundHeight}), world::kAir) << "it ran dry";
}

TEST_F(BlockInteractionTest, FlowingWaterIsReplacedByASourceAndNotTaken) {
    const world::BlockId water = contentBlock("water");
    session_.edit({kNoPlayer, {6, 5, kGroundHeight}, world::SetBlock{water}, {}});
    for (int second = 0; second < 4; ++second) session_.advance(1, {0, 0});
    ASSERT_EQ(session_.world().blockState({5, 5, kGroundHeight}), 1);
    selectBlock(interaction_.hotbar, water);
    act(interaction_.building);
    session_.advance(1, {0, 0});
    EXPECT_EQ(session_.world().blockState({5, 5, kGroundHeight}), 0);
    ASSERT_EQ(session_.undoOrRedo(kLocalPlayer, HistoryWay::Undo).blocks, 1u);
    for (int second = 0; second < 4; ++second) session_.advance(1, {0, 0});
    EXPECT_EQ(session_.world().blockState({5, 5, kGroundHeight}), 1) << "again what flows there";
    selectBlock(interaction_.hotbar, contentBlock("stone"));
    act(interaction_.breaking);
    EXPECT_EQ(session_.world().block({5, 5, kGroundHeight - 1}), world::kAir) << "rays pass water";
}

TEST_F(BlockInteractionTest, NeverBuildsIntoThePlayer) {
    player_.placeAt({.position = {5.5, 5.5, kGroundHeight + world::kEyeHeight}, .pitch = -89.9f},
                    Movement::Fly);
    session_.setPlayer(kLocalPlayer, player_.pose());
    selectBlock(interaction_.hotbar, contentBlock("stone"));
    act(interaction_.building);
    EXPECT_EQ(session_.world().block({5, 5, kGroundHeight}), world::kAir);
}

TEST_F(BlockInteractionTest, NothingWithinReachChangesNothing) {
    player_.placeAt({.position = {5.5, 5.5, kGroundHeight + 30.0}, .pitch = -89.9f}, Movement::Noclip);
    session_.setPlayer(kLocalPlayer, player_.pose());
    act(interaction_.breaking);
    EXPECT_FALSE(interaction_.target());
    EXPECT_EQ(session_.world().block({5, 5, kGroundHeight - 1}), contentBlock("stone"));
}

TEST_F(BlockInteractionTest, PicksTheBlockThatIsLookedAt) {
    EXPECT_FALSE(interaction_.pick(session_)) << "nothing was looked at yet";
    act(interaction_.breaking);
    EXPECT_TRUE(interaction_.pick(session_));
    EXPECT_EQ(interaction_.block(), contentBlock("stone"));
}

TEST_F(BlockInteractionTest, TellsWhatBecameOfTheCommand) {
    EXPECT_EQ(interaction_.act(session_, kLocalPlayer, player_, 0.01), std::nullopt);
    interaction_.breaking.press();
    EXPECT_EQ(interaction_.act(session_, kLocalPlayer, player_, 0.01), EditResult::Applied);
}

TEST_F(BlockInteractionTest, AnEmptySlotBuildsNothing) {
    interaction_.hotbar.blocks[interaction_.hotbar.selected] = world::kAir;
    act(interaction_.building);
    EXPECT_EQ(session_.world().block({5, 5, kGroundHeight}), world::kAir);
}

}  // namespace
}  // namespace terrane::game

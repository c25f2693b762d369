#include "terrane/game/sounds.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/game/session_fixture.h"

namespace terrane::game {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using world::BlockEdit;
using world::SoundMaterial;
using Kind = BlockSound::Kind;

constexpr world::BlockPos kPos{1, 2, 70};

std::vector<BlockSound> heard(std::vector<BlockEdit> edits, bool isPlayers = true) {
    return soundsOf(contentBlocks(), edits, isPlayers);
}

TEST(BlockSounds, BlocksAreBrokenAndPlaced) {
    const world::BlockId log = contentBlock("oak_log"), sand = contentBlock("sand");
    EXPECT_THAT(heard({{kPos, log, world::kAir}}),
                ElementsAre(BlockSound{Kind::Break, SoundMaterial::Wood, kPos}));
    EXPECT_THAT(heard({{kPos, world::kAir, sand}}),
                ElementsAre(BlockSound{Kind::Place, SoundMaterial::Sand, kPos}));
    EXPECT_THAT(heard({{kPos, contentBlock("water"), log}}),
                ElementsAre(BlockSound{Kind::Place, SoundMaterial::Wood, kPos}));
}

TEST(BlockSounds, EveryBlockOfTheProgramHasASound) {
    for (const world::BlockType& type : contentBlocks().types()) {
        if (type.id == world::kAir || type.id == contentBlocks().missing()) continue;
        EXPECT_NE(type.sound, SoundMaterial::None) << type.name;
    }
    EXPECT_EQ(contentBlocks().find("glass_pane")->sound, SoundMaterial::Glass);
    EXPECT_EQ(contentBlocks().find("oak_stairs")->sound, SoundMaterial::Wood);
    EXPECT_EQ(contentBlocks().find("poppy")->sound, SoundMaterial::Grass);
}

TEST(BlockSounds, WaterIsHeardWhereAPlayerPoursIt) {
    const world::BlockId water = contentBlock("water");
    const BlockSound pour{Kind::Place, SoundMaterial::Water, kPos};
    EXPECT_THAT(heard({{kPos, world::kAir, water}}), ElementsAre(pour));
    EXPECT_THAT(heard({{kPos, water, world::kAir}}), ElementsAre(pour));
    EXPECT_THAT(heard({{kPos, world::kAir, water}}, false), IsEmpty()) << "it flows";
}

TEST(BlockSounds, DoorsKnockAndPlantsGrowInSilence) {
    const world::BlockId gate = contentBlock("oak_gate"), wheat = contentBlock("wheat");
    EXPECT_THAT(heard({{kPos, gate, gate}}), ElementsAre(BlockSound{Kind::Place, SoundMaterial::Wood, kPos}));
    EXPECT_THAT(heard({{kPos, wheat, wheat}}), IsEmpty());
}

TEST(BlockSounds, LargeChangesAreNoLouder) {
    std::vector<BlockEdit> edits;
    for (int x = 0; x < 100; ++x) edits.push_back({{x, 0, 70}, contentBlock("stone"), world::kAir});
    EXPECT_EQ(heard(edits).size(), kMaxSoundsPerChange);
    edits.clear();
    for (int z = 70; z < 80; ++z) edits.push_back({{0, 0, z}, contentBlock("sand"), world::kAir});
    EXPECT_EQ(heard(edits).size(), 1u) << "a column is one sound";
}

TEST_F(SessionTest, EditsAreTold) {
    std::vector<PlayerId> players;
    std::vector<BlockEdit> told;
    session_.setPlayer(kLocalPlayer, {.position = {0.5, 0.5, 66}});
    const Subscription heard = session_.events.edited.add([&](const BlocksEdited& event) {
        players.push_back(event.player);
        told.insert(told.end(), event.edits.begin(), event.edits.end());
    });
    const world::BlockPos pos{1, 0, 63};
    session_.edit({kLocalPlayer, pos, world::SetBlock{world::kAir}, {}});
    session_.edit({kLocalPlayer, pos, world::SetBlock{world::kAir}, {}});
    (void)session_.undoOrRedo(kLocalPlayer, HistoryWay::Undo);
    EXPECT_THAT(players, ElementsAre(kLocalPlayer, kLocalPlayer)) << "of what changed nothing is told";
    EXPECT_THAT(told, ElementsAre(BlockEdit{pos, contentBlock("stone"), world::kAir},
                                  BlockEdit{pos, world::kAir, contentBlock("stone")}));
}

TEST_F(SessionTest, WhatFlowsIsTold) {
    const world::BlockPos source{5, 5, kGroundHeight};
    session_.edit({kNoPlayer, source, world::SetBlock{contentBlock("water")}, {}});
    std::vector<BlockEdit> told;
    const Subscription heard = session_.events.edited.add([&](const BlocksEdited& event) {
        EXPECT_EQ(event.player, kNoPlayer);
        told.insert(told.end(), event.edits.begin(), event.edits.end());
    });
    session_.advance(1, {0, 0});
    EXPECT_THAT(told,
                testing::Contains(BlockEdit{{6, 5, kGroundHeight}, world::kAir, contentBlock("water")}));
}

}  // namespace
}  // namespace terrane::game

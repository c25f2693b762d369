#include "terrane/game/player_state.h"

#include <gtest/gtest.h>

#include "terrane/store/overlay_store.h"

namespace terrane::game {
namespace {

const PlayerState kState{{{1.5, -2, 80.25}, 30, -5}, 0.625, "0 lamp"};

TEST(PlayerState, ComesBack) {
    store::MemoryStore store({1, "flat", 1});
    EXPECT_FALSE(loadPlayer(store).pose || loadPlayer(store).timeDay || loadPlayer(store).hotbar);
    std::optional<PlayerState> saved;
    savePlayer(store, kState, saved);
    const SavedPlayer again = loadPlayer(store);
    EXPECT_EQ(again.pose, kState.pose);
    EXPECT_EQ(again.timeDay, kState.timeDay);
    EXPECT_EQ(again.hotbar, kState.hotbar);
}

// A player who stands still writes nothing.
TEST(PlayerState, OnlyWhatChangedIsSaved) {
    store::MemoryStore store({1, "flat", 1});
    std::optional<PlayerState> saved;
    savePlayer(store, kState, saved);
    const store::SaveNumber all = store.status().queued;
    savePlayer(store, kState, saved);
    EXPECT_EQ(store.status().queued, all);
    PlayerState other = kState;
    other.hotbar = "0 sand";
    savePlayer(store, other, saved);
    EXPECT_EQ(store.status().queued, all + 1);
    EXPECT_EQ(loadPlayer(store).hotbar, "0 sand");
}

TEST(PlayerState, TheHandOfFormerSavesIsTheFirstSlot) {
    store::MemoryStore store({1, "flat", 1});
    store.setMetadata("hand", "chest");
    EXPECT_EQ(loadPlayer(store).hotbar, "0 chest");
    store.setMetadata("hotbar", "1 sand");
    EXPECT_EQ(loadPlayer(store).hotbar, "1 sand");
}

// They belong to the world, not to the player.
TEST(PlayerState, MovementAndTexturesComeBack) {
    store::MemoryStore store({1, "flat", 1});
    std::optional<PlayerState> saved;
    savePlayer(store, kState, saved);
    EXPECT_FALSE(loadPlayer(store).movement);
    EXPECT_FALSE(loadPlayer(store).resourcePack);
    PlayerState other = kState;
    other.movement = "fast";
    other.resourcePack = "/packs/wood";
    savePlayer(store, other, saved);
    EXPECT_EQ(loadPlayer(store).movement, "fast");
    EXPECT_EQ(loadPlayer(store).resourcePack, "/packs/wood");
    // A reset value is saved as empty, even if another program had set it.
    std::optional<PlayerState> unknown;
    savePlayer(store, kState, unknown);
    EXPECT_EQ(loadPlayer(store).resourcePack, "");
}

TEST(PlayerState, WhatIsNoneIsLeftOut) {
    store::MemoryStore store({1, "flat", 1});
    store.setMetadata("camera", "3000000000 0 0 0 0");
    store.setMetadata("time", "nan");
    EXPECT_FALSE(loadPlayer(store).pose);
    EXPECT_FALSE(loadPlayer(store).timeDay);
}

}  // namespace
}  // namespace terrane::game

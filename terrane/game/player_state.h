// What a save keeps of its player besides the world. Metadata of a store: saved in the same order and within
// the same time as blocks.
#pragma once

#include <optional>
#include <string>

#include "terrane/store/chunk_store.h"
#include "terrane/world/pose.h"

namespace terrane::game {

struct PlayerState {
    world::Pose pose;
    double timeDay = 0;  // of the world, 0 to 1
    std::string hotbar;  // as textOf(Hotbar) says it
    // How the player moves, by name, and the folder of textures that it chose for the world; empty: none.
    std::string movement = {}, resourcePack = {};

    bool operator==(const PlayerState&) const = default;
};

// Nothing where a save has none yet, or something else, which is logged.
struct SavedPlayer {
    std::optional<world::Pose> pose;
    std::optional<double> timeDay;
    std::optional<std::string> hotbar;                  // any text
    std::optional<std::string> movement, resourcePack;  // may name anything
};

SavedPlayer savedPlayer(store::ReadableStore& store);

// Hands the parts that differ from `saved` to the store, without waiting, and sets `saved`; all of them where
// that is empty. Cheap enough for every frame.
void savePlayer(store::ChunkStore& store, const PlayerState& now, std::optional<PlayerState>& saved);

// The time of day alone, 0 to 1, as of a world that has no one player.
store::SaveNumber saveTimeDay(store::ChunkStore& store, double timeDay);

}  // namespace terrane::game

// The player's state in a save. Metadata of a store: saved in the same order and within the same time as
// blocks.
#pragma once

#include <optional>
#include <string>

#include "terrane/store/chunk_store.h"
#include "terrane/world/pose.h"

namespace terrane::game {

struct PlayerState {
    world::Pose pose;
    double timeDay = 0;  // of the world, 0 to 1
    std::string hotbar;  // in the format of textOf(Hotbar)
    // The name of the movement, and the folder of textures chosen for the world; empty: none.
    std::string movement = {}, resourcePack = {};

    bool operator==(const PlayerState&) const = default;
};

// Members are empty if the save has none or invalid ones, which are logged.
struct SavedPlayer {
    std::optional<world::Pose> pose;
    std::optional<double> timeDay;
    std::optional<std::string> hotbar;                  // any text
    std::optional<std::string> movement, resourcePack;  // may name anything
};

SavedPlayer savedPlayer(store::ReadableStore& store);

// Writes the parts that differ from `saved` to the store without waiting, all of them if that is empty, and
// sets `saved`. Cheap enough for every frame.
void savePlayer(store::ChunkStore& store, const PlayerState& now, std::optional<PlayerState>& saved);

// Writes only the time of day, 0 to 1, for worlds without a single player.
store::SaveNumber saveTimeDay(store::ChunkStore& store, double timeDay);

}  // namespace terrane::game

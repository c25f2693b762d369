// The player's state in a save. Metadata of a store: saved in the same order and within the same time as
// blocks.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>

#include "terrane/store/chunk_store.h"
#include "terrane/world/pose.h"

namespace terrane::game {

// Formats a pose as "X Y Z YAW PITCH", for saves and files of bookmarks. parsePose() returns the same pose.
std::string textOf(const world::Pose& pose);
// Parses a pose. Returns nothing if the text is invalid, the position is not in the world
// (world::isInWorld()) or the direction is none.
std::optional<world::Pose> parsePose(const std::string& text);

// The clock of a world: its time of day.
struct DayClock {
    double timeDay = 0.38;   // 0 midnight, 0.2 dawn, 0.5 noon, 0.8 dusk
    double dayMinutes = 20;  // length of a day
    bool isRunning = true;

    void advance(double seconds) {
        if (isRunning) shift(seconds / (60 * std::max(dayMinutes, 0.01)));
    }
    // Shifts by a part of a day, forward or back.
    void shift(double days) { timeDay = timeDay + days - std::floor(timeDay + days); }
};

// Parses a time of day as saves store it; nothing unless it is a number from 0 to 1.
inline std::optional<double> parseTimeDay(std::string_view text) {
    double time = 0;
    const char* end = text.data() + text.size();
    const auto [next, error] = std::from_chars(text.data(), end, time);
    const bool isGood = error == std::errc() && next == end && time >= 0 && time <= 1;
    return isGood ? std::optional(time) : std::nullopt;
}

struct PlayerState {
    world::Pose pose;
    double timeDay = 0;  // of the world, 0 to 1
    std::string hotbar;  // in the format of textOf(Hotbar)
    // The name of the movement, and the folder of textures chosen for the world; empty: none.
    std::string movement = {}, resourcePack = {};

    bool operator==(const PlayerState&) const = default;
};

// A member has no value if the save has none or an invalid one, which is logged.
struct SavedPlayer {
    std::optional<world::Pose> pose;
    std::optional<double> timeDay;
    std::optional<std::string> hotbar;                  // any text
    std::optional<std::string> movement, resourcePack;  // may name anything
};

SavedPlayer loadPlayer(store::ReadableStore& store);

// Writes the parts that differ from `saved` to the store without waiting, all of them if that is empty, and
// sets `saved`. Cheap enough for every frame.
void savePlayer(store::ChunkStore& store, const PlayerState& now, std::optional<PlayerState>& saved);

// Writes only the time of day, 0 to 1, for worlds without a single player.
store::SaveNumber saveTimeDay(store::ChunkStore& store, double timeDay);

}  // namespace terrane::game

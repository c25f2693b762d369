// The time of day of the world that is played.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace terrane::game {

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
inline std::optional<double> timeDayFrom(std::string_view text) {
    double time = 0;
    const char* end = text.data() + text.size();
    const auto [next, error] = std::from_chars(text.data(), end, time);
    const bool isGood = error == std::errc() && next == end && time >= 0 && time <= 1;
    return isGood ? std::optional(time) : std::nullopt;
}

}  // namespace terrane::game

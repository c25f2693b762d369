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
    double dayMinutes = 20;  // how long a day takes
    bool isRunning = true;

    void advance(double seconds) {
        if (isRunning) shift(seconds / (60 * std::max(dayMinutes, 0.01)));
    }
    // By a part of a day, either way.
    void shift(double days) { timeDay = timeDay + days - std::floor(timeDay + days); }
};

// A time of day as a save has it; none for anything but a number from 0 to 1.
inline std::optional<double> timeDayFrom(std::string_view text) {
    double time = 0;
    const char* end = text.data() + text.size();
    const auto [next, error] = std::from_chars(text.data(), end, time);
    const bool isGood = error == std::errc() && next == end && time >= 0 && time <= 1;
    return isGood ? std::optional(time) : std::nullopt;
}

}  // namespace terrane::game

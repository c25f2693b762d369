// The time of day of the world that is played.
#pragma once

#include <algorithm>
#include <cmath>

namespace terrane::app {

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

}  // namespace terrane::app

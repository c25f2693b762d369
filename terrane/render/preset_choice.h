// Selects the best preset for a machine from a measurement of the cheapest one. Any thread.
#pragma once

#include "terrane/render/render_options.h"

namespace terrane::render {

constexpr double kTargetFramesPerSecond = 60;
// A fifth of the frame is left for the interface, the system and views that cost more.
constexpr double kTargetMilliseconds = 0.8 * 1000 / kTargetFramesPerSecond;

struct PresetChoice {
    const Preset* preset = nullptr;
    double framesPerSecond = 0;  // expected
};

// Returns the most expensive preset whose frame is expected to take at most kTargetMilliseconds; low if none
// does. `lowMilliseconds`: GPU time of a frame with low, above 0.
PresetChoice choosePreset(double lowMilliseconds);

}  // namespace terrane::render

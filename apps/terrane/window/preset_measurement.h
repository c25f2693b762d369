// Chooses a preset at the first start by measuring frames: first with the low preset while the world loads,
// then with the preset that this result suggests. The window's loop draws and adds each frame; nothing
// blocks.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/render/preset_choice.h"

namespace terrane::app {

class PresetMeasurement {
  public:
    static constexpr double kSeconds = 1;           // of a round; its median frame counts
    static constexpr std::size_t kLeastFrames = 5;  // of a round, if a second has fewer
    static constexpr double kMostSeconds = 10;      // until an incomplete view counts too

    struct Frame {
        double seconds = 0;          // since the last frame
        double gpuMilliseconds = 0;  // 0: unknown, use `seconds`
        bool isViewComplete = false;
    };

    const render::Preset& preset() const { return *preset_; }  // to draw with
    // Adds a frame drawn with preset(). None until the choice is known; add no frames afterwards.
    std::optional<render::PresetChoice> add(const Frame& frame);

  private:
    void beginRound();
    std::optional<render::PresetChoice> judgeLow(double milliseconds);
    std::optional<render::PresetChoice> judgeExpected(double milliseconds);

    const render::Preset* preset_ = &render::presets().front();
    std::vector<double> milliseconds_;  // of the round's frames
    double roundSeconds_ = 0, seconds_ = 0, lowMilliseconds_ = 0;
    bool isViewComplete_ = false;  // was complete once
};

// "graphics: medium, for 74 frames/s on llvmpipe (…)". `renderer` is the driver's name of the device.
std::string messageOf(const render::PresetChoice& choice, std::string_view renderer);

}  // namespace terrane::app

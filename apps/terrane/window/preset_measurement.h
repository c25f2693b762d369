// Picks a preset at the first start by measuring frames: first with low while the world comes in, then with
// the preset that this lets expect. The window's loop draws and hands over each frame; nothing waits.
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
    static constexpr double kSeconds = 1;           // of frames whose median counts
    static constexpr std::size_t kLeastFrames = 5;  // where a second has fewer
    static constexpr double kMostSeconds = 10;      // until a view counts that is not complete

    struct Frame {
        double seconds = 0;          // since the frame before
        double gpuMilliseconds = 0;  // 0: not known, its seconds count
        bool isViewComplete = false;
    };

    const render::Preset& preset() const { return *preset_; }  // to draw with
    // A frame drawn with preset(). Null until the choice is known; then there is nothing more to add.
    std::optional<render::PresetChoice> add(const Frame& frame);

  private:
    void beginRound();
    std::optional<render::PresetChoice> judgeLow(double milliseconds);
    std::optional<render::PresetChoice> judgeExpected(double milliseconds);

    const render::Preset* preset_ = &render::presets().front();
    std::vector<double> milliseconds_;  // of the round's frames
    double roundSeconds_ = 0, seconds_ = 0, lowMilliseconds_ = 0;
    bool isViewComplete_ = false;  // it was once
};

// "graphics: medium, for 74 frames/s on llvmpipe (…)". `renderer` is the driver's name of the device.
std::string messageOf(const render::PresetChoice& choice, std::string_view renderer);

}  // namespace terrane::app

// Measures at the first start what frames of the preset low take, and picks a preset by it. The window's loop
// hands it each frame while the world comes in; it takes no frames of its own.
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
    static constexpr double kMostSeconds = 10;      // then a view that is not complete counts, too
    static constexpr std::size_t kLeastFrames = 5;  // where a second has fewer

    struct Frame {
        double seconds = 0;          // since the frame before
        double gpuMilliseconds = 0;  // 0: not known, its seconds count
        bool isViewComplete = false;
    };
    // A frame with low. Null until the preset is known; then there is nothing more to add.
    std::optional<render::PresetChoice> add(const Frame& frame);

  private:
    void beginRound();

    std::vector<double> milliseconds_;  // of the round's frames
    double roundSeconds_ = 0, seconds_ = 0;
    bool isViewComplete_ = false;
};

// "graphics: medium, for 74 frames/s on llvmpipe (…)". `renderer` is the driver's name of the device.
std::string messageOf(const render::PresetChoice& choice, std::string_view renderer);

}  // namespace terrane::app

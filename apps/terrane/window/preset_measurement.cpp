#include "apps/terrane/window/preset_measurement.h"

#include <fmt/format.h>

#include <algorithm>

#include "terrane/base/median.h"

namespace terrane::app {

std::optional<render::PresetChoice> PresetMeasurement::add(const Frame& frame) {
    if (frame.isViewComplete != isViewComplete_) beginRound();
    isViewComplete_ = frame.isViewComplete;
    seconds_ += frame.seconds;
    roundSeconds_ += frame.seconds;
    const double milliseconds = frame.gpuMilliseconds > 0 ? frame.gpuMilliseconds : frame.seconds * 1000;
    if (milliseconds > 0) milliseconds_.push_back(milliseconds);
    if (roundSeconds_ < kSeconds || milliseconds_.size() < kLeastFrames) return std::nullopt;

    const render::PresetChoice choice = render::choosePreset(base::medianOf(milliseconds_));
    beginRound();
    // Frames get dearer until the view is complete: low is certain before, others are not.
    const bool isLow = choice.preset == &render::presets().front();
    if (isLow || isViewComplete_ || seconds_ >= kMostSeconds) return choice;
    return std::nullopt;
}

void PresetMeasurement::beginRound() {
    milliseconds_.clear();
    roundSeconds_ = 0;
}

std::string messageOf(const render::PresetChoice& choice, std::string_view renderer) {
    // Drivers append versions and chips: "llvmpipe (LLVM 15.0.6, 256 bits)", "NVIDIA H100/PCIe/SSE2".
    const std::size_t end = std::min(renderer.find(" ("), renderer.find('/'));
    return fmt::format("graphics: {}, for {:.0f} frames/s on {} (measured; change it in the settings, F2)",
                       choice.preset->name, choice.framesPerSecond, renderer.substr(0, end));
}

}  // namespace terrane::app

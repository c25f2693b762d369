#include "apps/terrane/window/settings/preset_measurement.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "terrane/base/log.h"
#include "terrane/base/statistics.h"

namespace terrane::app {

std::optional<render::PresetChoice> PresetMeasurement::add(const Frame& frame) {
    if (frame.isViewComplete && !isViewComplete_) beginRound();
    isViewComplete_ |= frame.isViewComplete;
    seconds_ += frame.seconds;
    roundSeconds_ += frame.seconds;
    const double milliseconds = frame.gpuMilliseconds > 0 ? frame.gpuMilliseconds : frame.seconds * 1000;
    if (milliseconds > 0) milliseconds_.push_back(milliseconds);
    if (roundSeconds_ < kSeconds || milliseconds_.size() < kLeastFrames) return std::nullopt;
    const double median = base::medianOf(milliseconds_);
    beginRound();
    return preset_ == low_ ? judgeLow(median) : judgeExpected(median);
}

// Frames get more expensive until the view is complete: an earlier round can only show that low is already
// too expensive.
std::optional<render::PresetChoice> PresetMeasurement::judgeLow(double milliseconds) {
    if (milliseconds <= render::targetMilliseconds(framesPerSecond_) && !isKnown()) return std::nullopt;
    lowMilliseconds_ = milliseconds;
    const render::PresetChoice choice = render::choosePreset(milliseconds, framesPerSecond_);
    preset_ = choice.preset;
    return preset_ == low_ ? std::optional(choice) : std::nullopt;
}

// Relative costs differ between devices: a preset that is too expensive is replaced by the next cheaper one.
std::optional<render::PresetChoice> PresetMeasurement::judgeExpected(double milliseconds) {
    const double framesPerSecond = 1000 / milliseconds;
    if (framesPerSecond >= framesPerSecond_ && !isKnown()) return std::nullopt;
    const bool isCheapest = preset_ == &render::presets().front();
    if (framesPerSecond >= framesPerSecond_ || isCheapest) return {{preset_, framesPerSecond}};
    --preset_;  // ordered by cost
    if (preset_ != low_) return std::nullopt;
    return {{preset_, 1000 / lowMilliseconds_}};
}

bool PresetMeasurement::isKnown() const {
    return isViewComplete_ || seconds_ >= kMostSeconds;
}

void PresetMeasurement::beginRound() {
    milliseconds_.clear();
    roundSeconds_ = 0;
}

std::string messageOf(const render::PresetChoice& choice, std::string_view renderer) {
    // Drivers append versions and chips: "llvmpipe (LLVM 15.0.6, 256 bits)", "NVIDIA H100/PCIe/SSE2".
    const std::size_t end = std::min(renderer.find(" ("), renderer.find('/'));
    return fmt::format("graphics: {}, for {:.0f} frames/s on {} (measured; to change it: Esc, Settings)",
                       choice.preset->name, choice.framesPerSecond, renderer.substr(0, end));
}

void PresetPicker::add(const PresetMeasurement::Frame& frame, PlaySettings& settings) {
    if (!measurement_) return;
    const auto choice = measurement_->add(frame);
    if (!choice) return;
    end();
    settings.preset = choice->preset->name;
    settings.graphics = render::withPreset(settings.graphics, settings.preset, isSoftwareRenderer_);
    // Where even the cheapest preset takes too long, a near view saves most.
    if (choice->framesPerSecond < render::targetFramesPerSecond(isSoftwareRenderer_)) {
        settings.graphics.viewDistance = kNearViewDistance;
        settings.graphics.horizon = kNearHorizon;
    }
    message_ = messageOf(*choice, deviceName_);
    base::logInfo("{}", *message_);
}

std::optional<std::string> PresetPicker::takeMessage() {
    return std::exchange(message_, std::nullopt);
}

}  // namespace terrane::app

#include "apps/terrane/window/preset_picker.h"

#include <utility>

#include "terrane/base/log.h"

namespace terrane::app {

// Turns vsync off during the measurement: a graphics card that waits lowers its clock.
void PresetPicker::begin() {
    measurement_.emplace();
    window_.setVsync(false);
}

void PresetPicker::end() {
    if (!measurement_) return;
    measurement_.reset();
    window_.setVsync(true);
}

void PresetPicker::add(const PresetMeasurement::Frame& frame, PlaySettings& settings) {
    if (!measurement_) return;
    const auto choice = measurement_->add(frame);
    if (!choice) return;
    end();
    settings.preset = choice->preset->name;
    settings.graphics = render::withPreset(settings.graphics, settings.preset, isSoftwareRenderer_);
    message_ = messageOf(*choice, deviceName_);
    base::logInfo("{}", *message_);
}

std::optional<std::string> PresetPicker::takeMessage() {
    return std::exchange(message_, std::nullopt);
}

}  // namespace terrane::app

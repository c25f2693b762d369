// Picks a graphics preset at the first start: the window's loop draws with the preset that is measured and
// hands over each frame (preset_measurement.h); then the settings change, and the player is told.
#pragma once

#include <optional>
#include <string>
#include <utility>

#include "apps/terrane/window/play_settings.h"
#include "apps/terrane/window/preset_measurement.h"
#include "apps/terrane/window/window.h"

namespace terrane::app {

class PresetPicker {
  public:
    // `deviceName`: of the graphics driver. The window outlives this.
    PresetPicker(Window& window, std::string deviceName, bool isSoftwareRenderer)
        : window_(window), deviceName_(std::move(deviceName)), isSoftwareRenderer_(isSoftwareRenderer) {}

    bool isBusy() const { return measurement_ || message_; }
    void begin();
    void end();  // nothing where nothing is measured
    // To draw with: those of the measured preset, else those of the settings.
    const render::RenderOptions& options(const PlaySettings& settings) const {
        return measurement_ ? measurement_->preset().options : settings.graphics.render;
    }
    // A frame that was drawn with options(). The last one that counts ends the measurement and changes the
    // settings.
    void add(const PresetMeasurement::Frame& frame, PlaySettings& settings);
    // What was picked, once. Take it when a frame was drawn with options(): another message tells before that
    // shaders are compiled.
    std::optional<std::string> takeMessage();

  private:
    Window& window_;
    std::string deviceName_;
    bool isSoftwareRenderer_;
    std::optional<PresetMeasurement> measurement_;  // while it goes on
    std::optional<std::string> message_;
};

}  // namespace terrane::app

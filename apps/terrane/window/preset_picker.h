// Chooses a graphics preset at the first start: the window's loop draws with options() and adds each frame
// (preset_measurement.h); then the settings change, and a message tells the player.
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
    void end();  // does nothing if no measurement runs
    // The options to draw with: those of the measured preset, else of the settings.
    const render::RenderOptions& options(const PlaySettings& settings) const {
        return measurement_ ? measurement_->preset().options : settings.graphics.render;
    }
    // Adds a frame drawn with options(). The last one ends the measurement and changes the settings.
    void add(const PresetMeasurement::Frame& frame, PlaySettings& settings);
    // The message about the choice, once. Take it after a frame drawn with options(): until then another
    // message is shown, that shaders are being compiled.
    std::optional<std::string> takeMessage();

  private:
    Window& window_;
    std::string deviceName_;
    bool isSoftwareRenderer_;
    std::optional<PresetMeasurement> measurement_;  // set while measuring
    std::optional<std::string> message_;
};

}  // namespace terrane::app

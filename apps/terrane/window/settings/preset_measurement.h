// Chooses a preset at the first start by measuring frames: first with the low preset while the world loads,
// then with the preset that this result suggests. The window's loop draws and adds each frame; nothing
// blocks.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "apps/terrane/window/settings/play_settings.h"
#include "terrane/render/frame/render_options.h"

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

    // `framesPerSecond`: to aim at.
    explicit PresetMeasurement(double framesPerSecond) : framesPerSecond_(framesPerSecond) {}

    const render::Preset& preset() const { return *preset_; }  // to draw with
    // Adds a frame drawn with preset(). None until the choice is known; add no frames afterwards.
    std::optional<render::PresetChoice> add(const Frame& frame);

  private:
    void beginRound();
    bool isKnown() const;  // whether frames will hardly get more expensive
    std::optional<render::PresetChoice> judgeLow(double milliseconds);
    std::optional<render::PresetChoice> judgeExpected(double milliseconds);

    double framesPerSecond_;
    const render::Preset* low_ = render::findPreset("low", true);
    const render::Preset* preset_ = low_;
    std::vector<double> milliseconds_;  // of the round's frames
    double roundSeconds_ = 0, seconds_ = 0, lowMilliseconds_ = 0;
    bool isViewComplete_ = false;  // was complete once
};

// "graphics: medium, for 74 frames/s on llvmpipe (…)". `renderer` is the driver's name of the device.
std::string messageOf(const render::PresetChoice& choice, std::string_view renderer);

// Chooses a graphics preset, and a nearer view where that is not enough, at the first start: the window's
// loop draws with options() and adds each frame; then the settings change, and a message tells the player.
class PresetPicker {
  public:
    // `deviceName`: of the graphics driver.
    PresetPicker(std::string deviceName, bool isSoftwareRenderer)
        : deviceName_(std::move(deviceName)), isSoftwareRenderer_(isSoftwareRenderer) {}

    bool isBusy() const { return measurement_ || message_; }
    // While it measures, no frame waits for the screen: a graphics card that waits lowers its clock.
    bool isMeasuring() const { return measurement_.has_value(); }
    void begin() { measurement_.emplace(render::targetFramesPerSecond(isSoftwareRenderer_)); }
    void end() { measurement_.reset(); }
    // The options to draw with: those of the measured preset, else of the settings.
    const render::RenderOptions& options(const PlaySettings& settings) const {
        return measurement_ ? measurement_->preset().options : settings.graphics.render;
    }
    // Of a machine that holds no rate of frames otherwise, chunks.
    static constexpr int kNearViewDistance = 8, kNearHorizon = 512;

    // Adds a frame drawn with options(). The last one ends the measurement and changes the settings.
    void add(const PresetMeasurement::Frame& frame, PlaySettings& settings);
    // The message about the choice, once. Take it after a frame drawn with options(): until then another
    // message is shown, that shaders are being compiled.
    std::optional<std::string> takeMessage();

  private:
    std::string deviceName_;
    bool isSoftwareRenderer_;
    std::optional<PresetMeasurement> measurement_;  // set while measuring
    std::optional<std::string> message_;
};

}  // namespace terrane::app

// Graphics options of the window's loop: their shaders, and the measurement that picks a preset at the first
// start.
#include <utility>

#include "apps/terrane/window/game.h"
#include "terrane/base/log.h"

namespace terrane::app {
namespace {

constexpr double kPresetMessageSeconds = 8;

double sumOf(const std::vector<gpu::GpuTiming>& passes) {
    double milliseconds = 0;
    for (const gpu::GpuTiming& pass : passes) milliseconds += pass.milliseconds;
    return milliseconds;
}

}  // namespace

// The options to draw with: during the measurement those of the measured preset.
const render::RenderOptions& Game::renderOptions() const {
    return measurement_ ? measurement_->preset().options : settings_.graphics.render;
}

// Frames do not wait for the screen meanwhile: a graphics card that waits lowers its clock.
void Game::beginMeasurement() {
    measurement_.emplace();
    parts_.window.setVsync(false);
}

void Game::endMeasurement() {
    if (!measurement_) return;
    measurement_.reset();
    parts_.window.setVsync(true);
}

void Game::measurePreset(double seconds) {
    if (!measurement_ || renderOptions() != parts_.renderer.options()) return;
    const bool isComplete = parts_.session.pipeline().progress().complete() && parts_.view.waiting() == 0;
    const auto choice = measurement_->add({seconds, sumOf(parts_.renderer.passTimes()), isComplete});
    if (!choice) return;
    endMeasurement();
    settings_.preset = choice->preset->name;
    settings_.graphics = render::withPreset(settings_.graphics, settings_.preset, isSoftwareRenderer_);
    presetMessage_ = messageOf(*choice, deviceName_);
    base::logInfo("{}", presetMessage_);
}

// Waits until the preset's shaders are compiled: another message tells so before.
void Game::sayPreset() {
    if (presetMessage_.empty() || renderOptions() != parts_.renderer.options()) return;
    say(std::exchange(presetMessage_, {}));
    messageSeconds_ = kPresetMessageSeconds;
}

// While developing, a shader is seen as soon as it is written. One that is wrong changes nothing.
void Game::reloadWrittenShaders() {
    const WriteTime written = shadersWritten_.at(seconds_, [&] { return parts_.shaders.newestWrite(); });
    if (written == shadersRead_) return;
    shadersRead_ = written;
    auto done = parts_.renderer.reloadShaders();
    if (done) done = parts_.preview.reloadShaders();
    if (!done) base::logWarning("{}", done.error().message);
    say(done ? "shaders are read again" : done.error().message);
}

bool Game::shadersAreReady(glm::ivec2 size) {
    constexpr glm::ivec2 kPreview(view::BlockPreview::kSize);
    if (hasWorldImage() && renderOptions() == parts_.renderer.options()) return true;
    if (!hasWorldImage() && !parts_.compiler.isReady(kPreview, view::BlockPreview::options())) return false;
    return parts_.compiler.isReady(size, renderOptions());
}

// Other options come once their shaders are compiled; until then frames are drawn as before, and at first
// none. Options that cannot be drawn are taken back.
base::Result<void> Game::configureRenderer(glm::ivec2 size) {
    render::Renderer& renderer = parts_.renderer;
    render::RenderOptions options = renderOptions();
    if (!shadersAreReady(size)) {
        say(tr_("shaders are being compiled"));
        if (!hasWorldImage()) return {};
        options = renderer.options();
    }
    if (size == renderer.size() && options == renderer.options()) return {};
    const auto configured = renderer.configure(size, options);
    if (configured || !hasWorldImage() || options == renderer.options()) return configured;
    base::logWarning("{}", configured.error().message);
    say(configured.error().message);
    settings_.graphics.render = renderer.options();
    endMeasurement();
    return {};
}

// Only content that can be used is: until then the world stays as it is, and the player reads why.
void Game::reloadContent() {
    if (!contentChanged_ || isLeaving_ || !contentChanged_()) return;
    if (const auto checked = checkContent_(); !checked) {
        base::logWarning("{}", checked.error().message);
        return say(checked.error().message);
    }
    wantsReload_ = true;
    leave(false);
}

}  // namespace terrane::app

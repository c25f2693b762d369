#include "apps/terrane/window/game/game_image.h"

#include <chrono>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <thread>
#include <utility>

#include "terrane/base/log.h"
#include "terrane/content/resource_pack.h"
#include "terrane/gpu/framebuffer.h"
#include "terrane/view/camera_path.h"

namespace terrane::app {
namespace {

// Pause between frames without a world, which leaves the CPU to the compiler.
constexpr std::chrono::milliseconds kCompilePause{15};
constexpr double kPresetMessageSeconds = 8;

world::Environment environmentOf(const game::DayClock& clock) {
    return world::environmentAt(static_cast<float>(clock.timeDay));
}

// The time that a frame should take, milliseconds; 0: as long as it likes. A graphics card waits for the
// screen, so a part of its time is left over.
double targetMilliseconds(GameState& game) {
    int rate = game.settings.targetFps;
    if (rate == 0 || game.preset.isBusy()) return 0;
    constexpr double kShareOfCard = 0.9;
    const bool isSoftware = game.options.isSoftwareRenderer;
    const auto refreshRate = [&] { return game.parts.window.refreshRate(); };
    if (rate == PlaySettings::kAutomaticRate)
        rate = static_cast<int>(isSoftware ? render::targetFramesPerSecond(true)
                                           : game.refreshRate.at(game.seconds, refreshRate));
    return rate > 0 ? 1000.0 / rate * (isSoftware ? 1 : kShareOfCard) : 0;
}

// As the settings say, and as small as the rate of frames needs.
render::RenderOptions optionsOf(GameState& game) {
    render::RenderOptions options = game.preset.options(game.settings);
    if (targetMilliseconds(game) > 0) options.renderScale = game.scale.scaleFor(options.renderScale);
    return options;
}

bool shadersAreReady(render::BackgroundCompiler& compiler, const render::Renderer& renderer, glm::ivec2 size,
                     const render::RenderOptions& options) {
    constexpr glm::ivec2 kPreview(view::BlockPreview::kSize);
    const bool hasImage = hasWorldImage(renderer);
    if (hasImage && options == renderer.options()) return true;
    if (!hasImage && !compiler.isReady(kPreview, view::BlockPreview::options(), {})) return false;
    return compiler.isReady(size, options, {.hasTint = renderer.hasTint(), .hasLand = renderer.hasLand()});
}

// Applies other options once their shaders are compiled; until then frames are drawn with the former ones, or
// not at all at first. Options that cannot be drawn are reverted.
base::Result<void> configureRenderer(GameState& game, glm::ivec2 size) {
    render::Renderer& renderer = game.parts.renderer;
    render::RenderOptions options = optionsOf(game);
    if (!shadersAreReady(game.parts.compiler, renderer, size, options)) {
        game.notices.say(game.tr("compiling shaders"));
        if (!hasWorldImage(renderer)) return {};
        options = renderer.options();
    }
    if (size == renderer.size() && options == renderer.options()) return {};
    const auto configured = renderer.configure(size, options);
    if (configured || !hasWorldImage(renderer) || options == renderer.options()) return configured;
    base::logWarning("{}", configured.error().message);
    game.notices.say(configured.error().message);
    const int ownScale = game.settings.graphics.render.renderScale;
    game.settings.graphics.render = renderer.options();
    game.settings.graphics.render.renderScale = std::min(ownScale, 100);
    game.scale.reset();
    game.preset.end();
    return {};
}

render::FrameInput frameInputOf(const GameState& game) {
    const GameParts& parts = game.parts;
    render::FrameInput input;
    input.camera = cameraOf(game.player, game.settings);
    input.environment = environmentOf(parts.session.clock);
    input.fogDistance = view::fogDistance(parts.view.visibleDistance());
    input.timeSeconds = static_cast<float>(game.seconds);
    input.view = game.settings.view;
    input.waterAbove = game::waterAbove(parts.session, game.player.pose().position);
    input.figures = game.remote.others.figures;
    input.maxShadowTiles = render::ShadowClipmap::kTilesPerFrame;
    input.maxLitChunks = render::CornerLitChunks::kPerFrame;
    if (game.debug.isAbove) {
        const int viewDistance = parts.view.viewDistance();
        input.cullingCamera = input.camera;
        input.camera = debugTopCamera(input.camera, viewDistance);
        input.fogDistance = 16 * view::fogDistance(viewDistance);
        input.waterAbove = 0;
    }
    return input;
}

double sumOf(const std::vector<gpu::GpuTiming>& passes) {
    double milliseconds = 0;
    for (const gpu::GpuTiming& pass : passes) milliseconds += pass.milliseconds;
    return milliseconds;
}

bool isComplete(const GameParts& parts) {
    return parts.session.pipeline().progress().complete() && parts.view.waiting() == 0;
}

// The time that the graphics card took for the newest frame that it has finished, milliseconds; 0 without
// one: software renderers draw when they are waited for, not in the passes that asked for it.
double cardMilliseconds(const GameState& game) {
    return game.options.isSoftwareRenderer ? 0 : sumOf(game.parts.renderer.passTimes());
}

// Call after a frame: feeds the preset measurement, and reports its choice once its shaders are in use.
void pickPreset(GameState& game, double seconds) {
    PresetPicker& preset = game.preset;
    if (!preset.isBusy()) return;
    const auto isDrawn = [&] { return preset.options(game.settings) == game.parts.renderer.options(); };
    if (isDrawn()) preset.add({seconds, cardMilliseconds(game), isComplete(game.parts)}, game.settings);
    if (!isDrawn()) return;
    if (auto message = preset.takeMessage()) game.notices.say(std::move(*message), kPresetMessageSeconds);
}

// Call after a frame.
void holdRate(GameState& game, double seconds) {
    const double target = targetMilliseconds(game);
    if (target <= 0) return game.scale.reset();
    const double onCard = cardMilliseconds(game);
    const double milliseconds = onCard > 0 ? onCard : 1000 * seconds;
    game.scale.add({seconds, milliseconds, isComplete(game.parts)}, target,
                   game.settings.graphics.render.renderScale);
}

void drawWorld(GameState& game, glm::ivec2 size, double seconds) {
    const GameParts& parts = game.parts;
    parts.view.upload(view::uploadBudget(seconds, parts.view.missing()));
    if (auto notice = parts.view.takeNotice()) game.notices.say(std::move(*notice));
    render::FrameInput input = frameInputOf(game);
    input.exposure = game.eye.look(parts.session, input, render::aspectOf(size), seconds);
    parts.renderer.draw(input);
    parts.renderer.presentToWindow(size);
    holdRate(game, seconds);
    pickPreset(game, seconds);
}

}  // namespace

base::Result<void> drawImage(GameState& game, glm::ivec2 size, double seconds) {
    TERRANE_TRY(configureRenderer(game, size));
    if (hasWorldImage(game.parts.renderer)) {
        drawWorld(game, size, seconds);
    } else {
        const glm::vec3 horizon = environmentOf(game.parts.session.clock).horizonColor;
        gpu::clearWindow(glm::pow(glm::min(horizon, 1.0f), glm::vec3(1 / 2.2f)));
        std::this_thread::sleep_for(kCompilePause);
    }
    return {};
}

base::Result<void> useResourcePack(const GameParts& parts, const std::string& folder) {
    auto textures =
        TERRANE_TRY(content::loadTextures(folder, parts.session.blocks(), parts.content.textures));
    TERRANE_TRY(parts.preview.setTextures(textures));
    TERRANE_TRY(parts.renderer.setTextures(parts.session.blocks(), textures));
    parts.compiler.setTextures(textures);
    return {};
}

}  // namespace terrane::app

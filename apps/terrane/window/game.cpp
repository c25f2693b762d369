#include "apps/terrane/window/game.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <thread>

#include "terrane/base/log.h"
#include "terrane/content/resource_pack.h"
#include "terrane/game/spawn.h"
#include "terrane/gpu/framebuffer.h"
#include "terrane/view/camera_pose.h"

namespace terrane::app {
namespace {

// Between frames that show no world, so that the compiler has the CPU.
constexpr std::chrono::milliseconds kCompilePause{15};

}  // namespace

Game::Game(const GameParts& parts, const GameOptions& options)
    : parts_(parts),
      settings_(options.settings),
      applied_(options.settings),
      tr_(textsOf(options.settings.language, parts.content)),
      sounds_(parts.session),
      isSoftwareRenderer_(options.isSoftwareRenderer),
      imgui_(parts.window),
      player_(options.start, options.settings.movement),
      interaction_(parts.session.blocks()),
      shadersRead_(parts.shaders.newestWrite()),
      screenshots_(options.dataFolder / "screenshots"),
      bookmarks_(game::bookmarkFiles(options.dataFolder)),
      building_(options.dataFolder),
      perfData_(options.perfData),
      contentChanged_(options.contentChanged),
      checkContent_(options.checkContent),
      deviceName_(options.deviceName),
      thumbnail_(options.thumbnail) {
    if (options.measuresPreset) beginMeasurement();
    interaction_.hotbar = game::hotbarFrom(options.hotbar, parts_.session.blocks());
    hud_.places = game::savedPlaces(parts_.session.store());
    parts_.session.pipeline().setMeshOptions(settings_.graphics.mesh);
    parts_.renderer.setViewDistance(settings_.graphics.viewDistance);
    sounds_.setVolume(settings_.soundVolume);
}

base::Result<void> Game::run() {
    if (!perfData_.empty()) {
        auto log = PerfLog::create(perfData_);
        if (!log) return tl::unexpected(log.error());
        perfLog_ = std::move(*log);
    }
    base::Result<void> drawn, saved;
    do {
        drawn = drawFrames();
        writeThumbnail();
        saved = save();
    } while (drawn && staysAfter(saved));
    const glm::dvec3& p = player_.pose().position;
    base::logInfo("closed after {} frames at {:.2f},{:.2f},{:.2f}", frames_, p.x, p.y, p.z);
    if (perfLog_) base::logInfo("most seconds had {} frames", meter_.mode());
    if (!drawn && !saved) base::logError("{}", saved.error().message);
    if (!drawn || !saved) return drawn ? saved : drawn;
    return perfLog_ ? perfLog_->finish() : base::Result<void>();
}

base::Result<void> Game::drawFrames() {
    double last = parts_.window.timeSeconds();
    while (!isLeaving_ && !parts_.window.shouldClose() && !parts_.signals.stopAsked()) {
        parts_.window.pollEvents();
        handleEvents();
        const double now = parts_.window.timeSeconds(), seconds = now - last;
        last = now;
        meter_.add(seconds);
        advance(seconds);
        applySettings();
        reloadWrittenShaders();
        reloadContent();
        if (auto drawn = drawFrame(seconds); !drawn) return drawn;
        if (perfLog_) perfLog_->add(seconds_, seconds, statistics());
    }
    return {};
}

void Game::advance(double seconds) {
    game::Session& session = parts_.session;
    seconds_ += seconds;
    hintSeconds_ -= seconds;
    messageSeconds_ -= seconds;
    untilThumbnail_ -= seconds;
    if (untilThumbnail_ <= 0) writeThumbnail();
    if (!parts_.remote) session.clock.dayMinutes = settings_.dayMinutes;
    onPad(seconds);
    const double gameSeconds = isInMenu() ? 0 : seconds;
    player_.move(session.world(), session.blocks(), moveKeys(), gameSeconds);
    liftFromBelow();
    session.setPlayer(game::kLocalPlayer, player_.pose());
    advanceRemote();
    breakAndBuild(seconds);
    advanceHud(seconds);
    session.advance(gameSeconds, world::chunkOf(player_.pose().position));
    sounds_.update(player_, isInMenu(), seconds);
    game::savePlayer(session.store(), playerState(), saved_);
    parts_.view.setHorizon({settings_.graphics.horizon, settings_.graphics.detail});
    parts_.view.follow(camera(), settings_.graphics.viewDistance);
}

// A player on foot who is below the world would fall for ever.
void Game::liftFromBelow() {
    if (settings_.movement == game::Movement::Fast || settings_.movement == game::Movement::Medium) return;
    const auto lifted = game::backOnSurface(parts_.session.world(), parts_.session.blocks(), player_.pose());
    if (!lifted) return;
    player_.placeAt(*lifted, settings_.movement);
    say(tr_("you were below the world, and are back on the ground"));
}

// What changed since the last frame; the renderer sees to its own options with the frame's size.
void Game::applySettings() {
    if (settings_ == applied_) return;
    if (settings_.preset != applied_.preset || settings_.graphics != applied_.graphics) endMeasurement();
    if (settings_.graphics.mesh != applied_.graphics.mesh)
        parts_.session.pipeline().setMeshOptions(settings_.graphics.mesh);
    if (settings_.graphics.viewDistance != applied_.graphics.viewDistance) {
        parts_.renderer.setViewDistance(settings_.graphics.viewDistance);
        parts_.session.pipeline().resendLight();
    }
    if (settings_.movement != applied_.movement) player_.setMovement(settings_.movement);
    if (settings_.fullScreen != applied_.fullScreen) parts_.window.setFullScreen(settings_.fullScreen);
    if (settings_.resourcePack != applied_.resourcePack) {
        const auto changed = useResourcePack(settings_.resourcePack);
        if (!changed) settings_.resourcePack = applied_.resourcePack;
        say(changed ? tr_("textures are loaded") : changed.error().message);
    }
    if (settings_.soundVolume != applied_.soundVolume) sounds_.setVolume(settings_.soundVolume);
    if (settings_.language != applied_.language) tr_ = textsOf(settings_.language, parts_.content);
    applied_ = settings_;
}

base::Result<void> Game::useResourcePack(const std::string& folder) {
    auto textures = content::loadTextures(folder, parts_.session.blocks(), parts_.content.textures);
    if (!textures) return tl::unexpected(textures.error());
    if (auto set = parts_.renderer.setTextures(parts_.session.blocks(), *textures); !set) return set;
    return parts_.preview.setTextures(*textures);
}

base::Result<void> Game::drawFrame(double seconds) {
    const glm::ivec2 size = parts_.window.framebufferSize();
    if (size.x == 0 || size.y == 0) return {};  // minimised
    if (auto configured = configureRenderer(size); !configured) return configured;
    if (hasWorldImage()) {
        parts_.view.upload(view::uploadBudget(seconds, parts_.view.missing()));
        if (auto notice = parts_.view.takeNotice()) say(std::move(*notice));
        parts_.renderer.draw(frameInput());
        parts_.renderer.presentToWindow(size);
        measurePreset(seconds);
        sayPreset();
    } else {
        const glm::vec3 sky =
            world::environmentAt(static_cast<float>(parts_.session.clock.timeDay)).horizonColor;
        gpu::clearWindow(glm::pow(glm::min(sky, 1.0f), glm::vec3(1 / 2.2f)));
        std::this_thread::sleep_for(kCompilePause);
    }
    drawInterface(seconds);
    parts_.window.swapBuffers();
    ++frames_;
    return {};
}

render::Camera Game::camera() const {
    return view::cameraOf(player_.pose(), settings_.fieldOfView);
}

render::FrameInput Game::frameInput() const {
    render::FrameInput input;
    input.camera = camera();
    input.environment = world::environmentAt(static_cast<float>(parts_.session.clock.timeDay));
    input.fogDistance = view::fogDistance(parts_.view.sightDistance());
    input.timeSeconds = static_cast<float>(seconds_);
    input.view = settings_.view;
    input.waterAbove = game::waterAbove(parts_.session, player_.pose().position);
    input.figures = hud_.others.figures;
    input.maxShadowTiles = render::ShadowClipmap::kTilesAFrame;
    if (isAbove_) {
        input.culledFor = input.camera;
        input.camera = debugTopCamera(camera(), parts_.view.viewDistance());
        input.fogDistance = 16 * view::fogDistance(parts_.view.viewDistance());
        input.waterAbove = 0;
    }
    return input;
}

game::PlayerState Game::playerState() const {
    return {.pose = player_.pose(),
            .timeDay = parts_.session.clock.timeDay,
            .hotbar = game::textOf(interaction_.hotbar, parts_.session.blocks()),
            .movement = nameOf(settings_.movement),
            // So that it is found from another working directory, too.
            .resourcePack = settings_.resourcePack.empty()
                                ? ""
                                : std::filesystem::absolute(settings_.resourcePack).string()};
}

base::Result<void> Game::save() {
    game::savePlayer(parts_.session.store(), playerState(), saved_);
    const auto saved = parts_.session.save();
    if (saved) return saved;
    return base::fail(saved.error().code, "{}; not saved: {} chunks", saved.error().message,
                      parts_.session.store().status().waiting);
}

// Who closes the window is asked before anything is lost; who sends a signal is not there to answer.
bool Game::staysAfter(const base::Result<void>& saved) {
    if (saved || quitsUnsaved_ || parts_.signals.stopAsked()) return false;
    parts_.window.cancelClose();
    isLeaving_ = false;
    asksToQuit_ = true;
    capture(false);
    return true;
}

void Game::answerQuitDialog(QuitChoice choice) {
    asksToQuit_ = false;
    quitsUnsaved_ = choice == QuitChoice::QuitUnsaved;
    leave(goesToTitle_);
    if (choice == QuitChoice::Stay) isLeaving_ = goesToTitle_ = false;
}

}  // namespace terrane::app

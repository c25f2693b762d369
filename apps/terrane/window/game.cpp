#include "apps/terrane/window/game.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <numbers>

#include "apps/terrane/window/loading_map.h"
#include "apps/terrane/window/overlay.h"
#include "apps/terrane/window/panel.h"
#include "apps/terrane/window/positions.h"
#include "terrane/base/log.h"

namespace terrane::app {
namespace {

// Chunks handed to the GPU a frame: about 64 × 10 KiB.
constexpr std::size_t kUploadsPerFrame = 64;

// Where the camera looks over the ground, in sixteenths of a circle: chunks are put in order again only when
// it turns.
glm::vec2 lookSector(const render::Camera& camera) {
    const glm::vec3 look = render::lookDirection(camera);
    const double sector = std::numbers::pi / 8;
    const double angle = std::round(std::atan2(double{look.y}, double{look.x}) / sector) * sector;
    return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
}

}  // namespace

Game::Game(const GameParts& parts, const GameOptions& options)
    : parts_(parts),
      settings_(options.settings),
      applied_(options.settings),
      positionsFile_(options.positions),
      isSoftwareRenderer_(options.isSoftwareRenderer),
      imgui_(parts.window),
      player_(options.start, options.settings.movement),
      hand_(parts.session.blocks),
      day_(options.day),
      perfData_(options.perfData) {
    parts_.session.pipeline->setMeshOptions(settings_.mesh);
    parts_.renderer.setViewDistance(settings_.viewDistance);
}

base::Result<void> Game::run() {
    if (!perfData_.empty()) {
        auto log = PerfLog::create(perfData_);
        if (!log) return tl::unexpected(log.error());
        perfLog_ = std::move(*log);
    }
    double last = parts_.window.timeSeconds();
    while (!parts_.window.shouldClose()) {
        parts_.window.pollEvents();
        handleEvents();
        const double now = parts_.window.timeSeconds(), seconds = now - last;
        last = now;
        meter_.add(seconds);
        advance(seconds);
        applySettings();
        if (auto drawn = drawFrame(); !drawn) return drawn;
        if (perfLog_) perfLog_->add(seconds_, seconds, figures());
    }
    const glm::dvec3& p = player_.camera().position;
    base::logInfo("closed after {} frames at {:.2f},{:.2f},{:.2f}", frames_, p.x, p.y, p.z);
    return leave();
}

void Game::advance(double seconds) {
    WorldSession& session = parts_.session;
    seconds_ += seconds;
    hintSeconds_ -= seconds;
    messageSeconds_ -= seconds;
    day_.dayMinutes = settings_.dayMinutes;
    day_.advance(seconds);
    player_.move(session.world, session.blocks, moveKeys(seconds), seconds);
    hand_.act(session.world, session.blocks, *session.pipeline, player_, seconds);
    const world::ChunkPos chunk = render::cameraChunk(player_.camera());
    session.advance(seconds, chunk);
    session.pipeline->setView(chunk, settings_.viewDistance, lookSector(player_.camera()));
    session.pipeline->update();
}

// What changed since the last frame; the renderer sees to its own options with the frame's size.
void Game::applySettings() {
    if (settings_ == applied_) return;
    if (settings_.mesh != applied_.mesh) parts_.session.pipeline->setMeshOptions(settings_.mesh);
    if (settings_.viewDistance != applied_.viewDistance) {
        parts_.renderer.setViewDistance(settings_.viewDistance);
        parts_.session.pipeline->showAgain();
    }
    if (settings_.movement != applied_.movement) player_.setMovement(settings_.movement);
    if (settings_.fieldOfView != applied_.fieldOfView) player_.setFieldOfView(settings_.fieldOfView);
    if (settings_.fullScreen != applied_.fullScreen) parts_.window.setFullScreen(settings_.fullScreen);
    applied_ = settings_;
}

base::Result<void> Game::drawFrame() {
    const glm::ivec2 size = parts_.window.framebufferSize();
    if (size.x == 0 || size.y == 0) return {};  // minimised
    render::Renderer& renderer = parts_.renderer;
    if (size != renderer.size() || settings_.graphics != renderer.options()) {
        if (auto configured = renderer.configure(size, settings_.graphics); !configured) return configured;
    }
    parts_.uploads.update(kUploadsPerFrame);
    renderer.draw(frameInput());
    renderer.presentToWindow(size);
    drawInterface(size);
    parts_.window.swapBuffers();
    ++frames_;
    return {};
}

render::FrameInput Game::frameInput() const {
    render::FrameInput input;
    input.camera = player_.camera();
    input.environment = world::environmentAt(static_cast<float>(day_.timeDay));
    input.fogDistance = fogDistance(settings_.viewDistance);
    input.timeSeconds = static_cast<float>(seconds_);
    input.view = settings_.view;
    input.isUnderWater = isUnderWater(parts_.session, player_.camera());
    if (isAbove_) {
        input.culledFor = input.camera;
        input.camera = cameraAbove(player_.camera(), settings_.viewDistance);
        input.fogDistance = 16 * fogDistance(settings_.viewDistance);
        input.isUnderWater = false;
    }
    return input;
}

void Game::drawInterface(glm::ivec2 size) {
    const Screen screen{static_cast<float>(size.x), static_cast<float>(size.y)};
    const WorldSession& session = parts_.session;
    const stream::Progress progress = session.pipeline->progress();
    imgui_.beginFrame(isCaptured_);
    const render::Camera& camera = player_.camera();
    if (isAbove_) {
        drawViewFromAbove(screen, cameraAbove(camera, settings_.viewDistance), camera,
                          fogDistance(settings_.viewDistance));
    } else if (const auto& target = hand_.target()) {
        drawTarget(screen, player_.camera(), *target, session.world, session.blocks);
    }
    if (isCaptured_ && !isAbove_) drawCrosshair(screen);
    drawHand(screen, session.blocks.type(hand_.block()).name, parts_.preview.picture(hand_.block()));
    if (hintSeconds_ > 0) drawHint(screen, static_cast<float>(std::min(hintSeconds_, 1.0)));
    if (messageSeconds_ > 0)
        drawMessage(screen, message_, static_cast<float>(std::min(messageSeconds_, 1.0)));
    if (!progress.complete()) drawProgress(screen, progress);
    if (showsLoading_)
        drawLoadingMap(screen, *session.pipeline, render::cameraChunk(player_.camera()),
                       settings_.viewDistance);
    if (showsPanel_) {
        drawFigures(figures());
    }
    if (showsPanel_) drawPanel(settings_, day_, {isSoftwareRenderer_, screen.width, screen.height});
    imgui_.endFrame();
}

Figures Game::figures() const {
    const WorldSession& session = parts_.session;
    return {.frames = &meter_,
            .camera = player_.camera(),
            .timeDay = day_.timeDay,
            .progress = session.pipeline->progress(),
            .activeChunks = session.world.chunks().size(),
            .queuedChunks = session.pipeline->queuedCount() + parts_.uploads.waiting(),
            .frame = parts_.renderer.statistics(),
            .blockBytes = session.world.memoryBytes(),
            .lightBytes = session.pipeline->lightBytes(),
            .quadBytes = parts_.renderer.quadBytes(),
            .lightGpuBytes = parts_.renderer.lightBytes(),
            .tasks = session.pipeline->taskTimes(),
            .passes = &parts_.renderer.passTimes()};
}

base::Result<void> Game::leave() {
    if (store::ChunkStore* store = parts_.session.store.get()) {
        store->setSetting(kCameraSetting, textOf(player_.camera()));
        store->setSetting(kTimeSetting, fmt::format("{:.5f}", day_.timeDay));
    }
    if (auto saved = parts_.session.save(); !saved) return saved;
    return perfLog_ ? perfLog_->finish() : base::Result<void>();
}

}  // namespace terrane::app

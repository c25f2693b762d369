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
#include "terrane/base/image.h"
#include "terrane/base/log.h"

namespace terrane::app {
namespace {

// Chunks handed to the GPU a frame: about 64 × 10 KiB.
constexpr std::size_t kUploadsPerFrame = 64;
constexpr double kStickDegrees = 160;  // a second, of a gamepad's stick at its end
constexpr double kDayStep = 0.01;      // of a day, for each press
constexpr double kMessageSeconds = 3;

// Where the camera looks over the ground, in sixteenths of a circle: chunks are put in order again only when
// it turns.
glm::vec2 lookSector(const render::Camera& camera) {
    const glm::vec3 look = render::lookDirection(camera);
    const double sector = std::numbers::pi / 8;
    const double angle = std::round(std::atan2(double{look.y}, double{look.x}) / sector) * sector;
    return {static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle))};
}

// The first name of its kind that is free in the working directory.
std::filesystem::path freeScreenshot() {
    for (int number = 1;; ++number) {
        const std::filesystem::path path = fmt::format("terrane-{:04}.png", number);
        std::error_code ignored;
        if (!std::filesystem::exists(path, ignored)) return path;
    }
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
      day_(options.day) {
    parts_.session.pipeline->setMeshOptions(settings_.mesh);
    parts_.renderer.setViewDistance(settings_.viewDistance);
}

base::Result<void> Game::run() {
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
    }
    const glm::dvec3& p = player_.camera().position;
    base::logInfo("closed after {} frames at {:.2f},{:.2f},{:.2f}", frames_, p.x, p.y, p.z);
    return leave();
}

void Game::handleEvents() {
    using Type = gpu::InputEvent::Type;
    for (const gpu::InputEvent& event : parts_.window.events()) {
        switch (event.type) {
            case Type::KeyPress:
                onKey(event.key);
                break;
            case Type::KeyRelease:
                break;
            case Type::ButtonPress:
            case Type::ButtonRelease:
                onButton(event.button, event.type == Type::ButtonPress);
                break;
            case Type::Wheel:
                if (isCaptured_) hand_.choose(event.y > 0 ? -1 : 1);
                break;
            case Type::CursorMove:
                if (!isCaptured_) break;
                player_.turn(event.x * double{settings_.mouseSensitivity},
                             event.y * double{settings_.mouseSensitivity});
        }
    }
}

void Game::onKey(gpu::Key key) {
    using gpu::Key;
    switch (key) {
        case Key::Escape:
            return parts_.window.requestClose();
        case Key::F1:
            hintSeconds_ = hintSeconds_ > 0 ? 0 : 20;
            break;
        case Key::F2:
            showsPanel_ = !showsPanel_;
            if (showsPanel_) capture(false);
            break;
        case Key::F3:
            showsFigures_ = !showsFigures_;
            break;
        case Key::F4:
            showsLoading_ = !showsLoading_;
            break;
        case Key::F5:
            return savePosition();
        case Key::F6:
            return nextPosition();
        case Key::F11:
            settings_.fullScreen = !settings_.fullScreen;
            break;
        case Key::F12:
            return takeScreenshot();
        case Key::O:
            day_.shift(-kDayStep);
            break;
        case Key::P:
            day_.shift(kDayStep);
            break;
        case Key::I:
            day_.isRunning = !day_.isRunning;
            say(day_.isRunning ? "time passes" : "time stands still");
            break;
        case Key::L: {
            using render::LightSampling;
            render::LightSampling& light = settings_.graphics.light;
            light = light == LightSampling::Smooth ? LightSampling::Classic : LightSampling::Smooth;
            say(light == LightSampling::Smooth ? "smooth light" : "classic light");
            break;
        }
        case Key::M: {
            const int next =
                (static_cast<int>(settings_.movement) + 1) % static_cast<int>(movementWords().size());
            settings_.movement = static_cast<Movement>(next);
            say("movement: " + movementWords()[static_cast<std::size_t>(next)].first);
            break;
        }
        default:
            break;
    }
}

void Game::onButton(gpu::MouseButton button, bool isPress) {
    HeldButton* held = button == gpu::MouseButton::Left    ? &hand_.breaking
                       : button == gpu::MouseButton::Right ? &hand_.building
                                                           : nullptr;
    if (!isPress) {
        if (held) held->release();
        return;
    }
    if (button == gpu::MouseButton::Middle) {
        // The middle button turns mouse look on and off, wherever the cursor is.
        return capture(!isCaptured_);
    }
    if (isCaptured_) return held->press();
    if (!imgui_.takesMouse()) capture(true);
}

void Game::capture(bool isCaptured) {
    isCaptured_ = isCaptured;
    parts_.window.setCursorCaptured(isCaptured);
    hand_.breaking.release();
    hand_.building.release();
}

void Game::say(std::string message) {
    message_ = std::move(message);
    messageSeconds_ = kMessageSeconds;
}

void Game::savePosition() {
    const auto done = appendPosition(positionsFile_, player_.camera());
    say(done ? "position saved in " + positionsFile_.string() : done.error().message);
}

void Game::nextPosition() {
    const auto positions = readPositions(positionsFile_);
    if (!positions) return say(positions.error().message);
    if (positions->empty()) return say("no position is saved yet (F5)");
    render::Camera camera = (*positions)[nextPosition_++ % positions->size()];
    camera.fieldOfView = settings_.fieldOfView;
    player_.placeAt(camera, settings_.movement);
}

void Game::takeScreenshot() {
    const std::filesystem::path file = freeScreenshot();
    const auto done = base::writePng(file, parts_.renderer.readImage());
    say(done ? "screenshot " + file.string() : done.error().message);
}

MoveKeys Game::moveKeys(double seconds) {
    using gpu::Key;
    const gpu::Window& window = parts_.window;
    if (imgui_.takesKeys()) return {};
    const bool walks = settings_.movement == Movement::Gravity;
    MoveKeys keys{.forward = window.keyDown(Key::W) || window.keyDown(Key::Up),
                  .back = window.keyDown(Key::S) || window.keyDown(Key::Down),
                  .left = window.keyDown(Key::A) || window.keyDown(Key::Left),
                  .right = window.keyDown(Key::D) || window.keyDown(Key::Right),
                  .up = window.keyDown(Key::E) || (!walks && window.keyDown(Key::Shift)),
                  .down = window.keyDown(Key::Q) || window.keyDown(Key::Control),
                  .jump = window.keyDown(Key::Space),
                  .run = walks && window.keyDown(Key::Shift),
                  .stick = {}};
    if (const auto pad = window.gamepad()) {
        keys.stick = {pad->leftX, pad->leftY};
        keys.jump |= pad->south;
        keys.down |= pad->east;
        keys.run |= pad->west;
        player_.turn(double{pad->rightX} * kStickDegrees * seconds,
                     -double{pad->rightY} * kStickDegrees * seconds);
        if (pad->rightTrigger != hand_.breaking.isDown() && !isCaptured_)
            pad->rightTrigger ? hand_.breaking.press() : hand_.breaking.release();
        if (pad->leftTrigger != hand_.building.isDown() && !isCaptured_)
            pad->leftTrigger ? hand_.building.press() : hand_.building.release();
    }
    return keys;
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
    uploadChanges(*parts_.session.pipeline, renderer, kUploadsPerFrame);
    render::FrameInput input;
    input.camera = player_.camera();
    input.environment = world::environmentAt(static_cast<float>(day_.timeDay));
    input.fogDistance = fogDistance(settings_.viewDistance);
    input.timeSeconds = static_cast<float>(seconds_);
    input.view = settings_.view;
    input.isUnderWater = isUnderWater(parts_.session, player_.camera());
    renderer.draw(input);
    renderer.presentToWindow(size);
    drawInterface(size);
    parts_.window.swapBuffers();
    ++frames_;
    return {};
}

void Game::drawInterface(glm::ivec2 size) {
    const Screen screen{static_cast<float>(size.x), static_cast<float>(size.y)};
    const WorldSession& session = parts_.session;
    const stream::Progress progress = session.pipeline->progress();
    imgui_.beginFrame(isCaptured_);
    if (const auto& target = hand_.target()) {
        drawTarget(screen, player_.camera(), *target, session.world, session.blocks);
    }
    if (isCaptured_) drawCrosshair(screen);
    drawHand(screen, session.blocks.type(hand_.block()).name, parts_.preview.picture(hand_.block()));
    if (hintSeconds_ > 0) drawHint(screen, static_cast<float>(std::min(hintSeconds_, 1.0)));
    if (messageSeconds_ > 0)
        drawMessage(screen, message_, static_cast<float>(std::min(messageSeconds_, 1.0)));
    if (!progress.complete()) drawProgress(screen, progress);
    if (showsLoading_)
        drawLoadingMap(screen, *session.pipeline, render::cameraChunk(player_.camera()),
                       settings_.viewDistance);
    if (showsFigures_) {
        drawFigures({.frames = &meter_,
                     .camera = player_.camera(),
                     .timeDay = day_.timeDay,
                     .progress = progress,
                     .activeChunks = session.world.chunks().size(),
                     .queuedChunks = session.pipeline->queuedCount(),
                     .frame = parts_.renderer.statistics(),
                     .blockBytes = session.world.memoryBytes(),
                     .lightBytes = session.pipeline->lightBytes(),
                     .quadBytes = parts_.renderer.quadBytes(),
                     .lightGpuBytes = parts_.renderer.lightBytes(),
                     .tasks = session.pipeline->taskTimes(),
                     .passes = &parts_.renderer.passTimes()});
    }
    if (showsPanel_) drawPanel(settings_, day_, {isSoftwareRenderer_, screen.width, screen.height});
    imgui_.endFrame();
}

base::Result<void> Game::leave() {
    if (store::ChunkStore* store = parts_.session.store.get()) {
        store->setSetting(kCameraSetting, textOf(player_.camera()));
        store->setSetting(kTimeSetting, fmt::format("{:.5f}", day_.timeDay));
    }
    return parts_.session.save();
}

}  // namespace terrane::app

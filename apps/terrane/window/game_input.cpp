// What keys, mouse and gamepad do.
#include <fmt/format.h>

#include <filesystem>

#include "apps/terrane/window/game.h"
#include "apps/terrane/window/positions.h"
#include "terrane/base/image.h"

namespace terrane::app {
namespace {

constexpr double kStickDegrees = 160;  // a second, of a gamepad's stick at its end
constexpr double kDayStep = 0.01;      // of a day, for each press
constexpr double kMessageSeconds = 3;

// The first name of its kind that is free in the working directory.
std::filesystem::path freeScreenshot() {
    for (int number = 1;; ++number) {
        const std::filesystem::path path = fmt::format("terrane-{:04}.png", number);
        std::error_code ignored;
        if (!std::filesystem::exists(path, ignored)) return path;
    }
}

}  // namespace

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
            isAbove_ = !isAbove_;
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
    hand_.breaking.cancel();
    hand_.building.cancel();
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

}  // namespace terrane::app

// What keys, mouse and gamepad do.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "apps/terrane/window/game.h"
#include "apps/terrane/window/thumbnail.h"
#include "terrane/base/image.h"
#include "terrane/base/log.h"
#include "terrane/game/container.h"
#include "terrane/view/camera_pose.h"

namespace terrane::app {
namespace {

constexpr double kStickDegrees = 160;  // a second, of a gamepad's stick at its end
constexpr double kDayStep = 0.01;      // of a day, for each press
constexpr double kMessageSeconds = 3;

// The first name of its kind that is free in the folder.
std::filesystem::path freeScreenshot(const std::filesystem::path& folder) {
    for (int number = 1;; ++number) {
        const std::filesystem::path path = folder / fmt::format("terrane-{:04}.png", number);
        std::error_code ignored;
        if (!std::filesystem::exists(path, ignored)) return path;
    }
}

}  // namespace

void Game::handleEvents() {
    using Type = InputEvent::Type;
    const bool wasCaptured = isCaptured_;  // what moved before the cursor was taken turns nobody
    for (const InputEvent& event : parts_.window.events()) {
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
                if (isCaptured_ || container_) interaction_.choose(event.y > 0 ? -1 : 1);
                break;
            case Type::CursorMove:
                if (!wasCaptured || !isCaptured_) break;
                player_.turn(event.x * double{settings_.mouseSensitivity},
                             (settings_.invertY ? -event.y : event.y) * double{settings_.mouseSensitivity});
        }
    }
}

void Game::onKey(Key key) {
    if (settingsDialog_.takeKey(key, settings_)) return;
    if (imgui_.takesKeys()) return;  // Escape ends the typing
    if (key == Key::Escape) return closeOne();
    if (isPaused_ && !showsSettings_ && (key == Key::Q || key == Key::T)) return leave(key == Key::T);
    const auto action = settings_.keys.actionOf(key);
    // What opens nothing is for the game, which stands still in a menu.
    if (!action || ((isInMenu() || container_) && !rowOf(*action).opensSomething)) return;
    act(*action);
}

void Game::act(Action action) {
    switch (action) {
        case Action::Help:
            hintSeconds_ = hintSeconds_ > 0 ? 0 : 20;
            break;
        case Action::Panel:
            showsPanel_ = !showsPanel_;
            if (showsPanel_) capture(false);
            break;
        case Action::TopView:
            isAbove_ = !isAbove_;
            break;
        case Action::LoadingMap:
            showsLoading_ = !showsLoading_;
            break;
        case Action::SaveBookmark:
            return saveBookmark();
        case Action::NextBookmark:
            return nextBookmark();
        case Action::FullScreen:
            settings_.fullScreen = !settings_.fullScreen;
            break;
        case Action::Screenshot:
            return takeScreenshot();
        case Action::Earlier:
            parts_.session.clock.shift(-kDayStep);
            break;
        case Action::Later:
            parts_.session.clock.shift(kDayStep);
            break;
        case Action::HoldTime:
            parts_.session.clock.isRunning = !parts_.session.clock.isRunning;
            return say(parts_.session.clock.isRunning ? "time passes" : "time stands still");
        case Action::Light:
            return nextLight();
        case Action::Movement:
            return nextMovement();
        default:  // held keys: moveKeys()
            break;
    }
}

void Game::nextLight() {
    using render::LightSampling;
    render::LightSampling& light = settings_.graphics.render.light;
    light = light == LightSampling::Smooth ? LightSampling::Classic : LightSampling::Smooth;
    say(light == LightSampling::Smooth ? "smooth light" : "classic light");
}

void Game::leave(bool toTitle) {
    goesToTitle_ = toTitle;
    isLeaving_ = true;
}

// One press of Escape closes one thing, the last that opened; where nothing is open the game pauses.
void Game::closeOne() {
    if (imgui_.hasPopup()) return imgui_.endTyping();
    if (asksToQuit_) return answerQuitDialog(QuitChoice::Stay);
    if (container_) return closeContainer();
    if (showsSettings_) {
        showsSettings_ = false;
        return;
    }
    if (showsPanel_) {
        showsPanel_ = false;
        if (!isPaused_) capture(true);
        return;
    }
    isPaused_ ? resume() : pause();
}

void Game::pause() {
    isPaused_ = true;
    hintSeconds_ = 0;
    capture(false);
}

void Game::resume() {
    isPaused_ = false;
    capture(true);
}

void Game::answerPauseMenu(PauseChoice choice) {
    switch (choice) {
        case PauseChoice::Resume:
            return resume();
        case PauseChoice::Settings:
            settingsDialog_.open();
            showsSettings_ = true;
            return;
        case PauseChoice::Help:
            resume();
            hintSeconds_ = 20;
            return;
        case PauseChoice::ToTitle:
            return leave(true);
        case PauseChoice::Quit:
            return leave(false);
    }
}

void Game::nextMovement() {
    const auto words = movementNames();
    const std::size_t next = (static_cast<std::size_t>(settings_.movement) + 1) % words.size();
    settings_.movement = static_cast<game::Movement>(next);
    say("movement: " + words[next].first);
}

// The sticks move and turn, as moveKeys() and this see them; buttons do what keys and the mouse do.
void Game::onPad(double seconds) {
    pad_.read(parts_.window.gamepad());
    const bool isBack = isInMenu() && pad_.isPressed(&Gamepad::east);
    if (pad_.isPressed(&Gamepad::start) || isBack) closeOne();
    if (showsSettings_ && pad_.isPressed(&Gamepad::leftBumper)) settingsDialog_.turnPage(-1);
    if (showsSettings_ && pad_.isPressed(&Gamepad::rightBumper)) settingsDialog_.turnPage(1);
    if (isInMenu() || container_) return;
    player_.turn(double{pad_.now().rightX} * kStickDegrees * seconds,
                 (settings_.invertY ? 1.0 : -1.0) * double{pad_.now().rightY} * kStickDegrees * seconds);
    pad_.drive(interaction_.breaking, &Gamepad::rightTrigger);
    pad_.drive(interaction_.building, &Gamepad::leftTrigger);
    if (pad_.isPressed(&Gamepad::leftBumper)) interaction_.choose(-1);
    if (pad_.isPressed(&Gamepad::rightBumper)) interaction_.choose(1);
    if (pad_.isPressed(&Gamepad::north)) nextMovement();
    if (pad_.isPressed(&Gamepad::up)) parts_.session.clock.shift(kDayStep);
    if (pad_.isPressed(&Gamepad::down)) parts_.session.clock.shift(-kDayStep);
}

void Game::onButton(MouseButton button, bool isPress) {
    game::HeldButton* held = button == MouseButton::Left    ? &interaction_.breaking
                             : button == MouseButton::Right ? &interaction_.building
                                                            : nullptr;
    if (!isPress) {
        if (held) held->release();
        return;
    }
    if (button == MouseButton::Middle) {
        // The middle button turns mouse look on and off, wherever the cursor is.
        if (!isInMenu() && !container_) capture(!isCaptured_);
        return;
    }
    if (isCaptured_ && button == MouseButton::Right && useTarget()) return;
    if (isCaptured_) return held->press();
    if (!imgui_.takesMouse() && !isInMenu() && !container_) capture(true);
}

// What is looked at, unless the player runs: then it builds against that.
bool Game::useTarget() {
    if (parts_.window.keyDown(Key::Shift)) return false;
    return openContainer() || interaction_.use(parts_.session, game::kLocalPlayer);
}

bool Game::openContainer() {
    const auto& target = interaction_.target();
    if (!target || !game::isContainer(parts_.session.world(), parts_.session.blocks(), target->block)) {
        return false;
    }
    container_ = target->block;
    capture(false);
    return true;
}

void Game::closeContainer() {
    capture(true);
}

void Game::capture(bool isCaptured) {
    isCaptured_ = isCaptured;
    parts_.window.setCursorCaptured(isCaptured);
    if (isCaptured) {
        imgui_.endTyping();
        container_.reset();
    }
    interaction_.breaking.cancel();
    interaction_.building.cancel();
}

void Game::say(std::string message) {
    message_ = std::move(message);
    messageSeconds_ = kMessageSeconds;
}

void Game::saveBookmark() {
    const auto done = game::appendBookmark(bookmarks_.file, player_.pose());
    say(done ? fmt::format("bookmark saved in {}", bookmarks_.file.string()) : done.error().message);
}

void Game::nextBookmark() {
    const auto bookmarks = game::readBookmarks(bookmarks_);
    if (!bookmarks) return say(bookmarks.error().message);
    if (bookmarks->empty()) return say("no bookmark is saved yet (F5)");
    player_.placeAt((*bookmarks)[nextBookmark_++ % bookmarks->size()], settings_.movement);
}

void Game::takeScreenshot() {
    if (!hasWorldImage()) return;
    std::error_code ignored;  // writing tells
    std::filesystem::create_directories(screenshots_, ignored);
    const std::filesystem::path file = freeScreenshot(screenshots_);
    const auto done = base::writePng(file, parts_.renderer.readImage());
    say(done ? "screenshot " + file.string() : done.error().message);
}

void Game::writeThumbnail() {
    untilThumbnail_ = kThumbnailPause;
    if (thumbnail_.empty() || !hasWorldImage()) return;
    const auto done = base::writePng(thumbnail_, thumbnailFrom(parts_.renderer.readImage()));
    if (!done) base::logInfo("{}", done.error().message);  // a list without a picture is no loss
}

game::MoveKeys Game::moveKeys() const {
    if (isInMenu() || container_) return {};
    const Gamepad& pad = pad_.now();
    const bool isTyping = imgui_.takesKeys(), walks = settings_.movement == game::Movement::Gravity;
    const auto isDown = [&](Action action) {
        const auto isKeyDown = [&](Key key) { return parts_.window.keyDown(key); };
        return !isTyping && std::ranges::any_of(settings_.keys.keysOf(action), isKeyDown);
    };
    return {.forward = isDown(Action::Forward),
            .back = isDown(Action::Back),
            .left = isDown(Action::Left),
            .right = isDown(Action::Right),
            .up = isDown(Action::Up) || (!walks && isDown(Action::Run)),
            .down = isDown(Action::Down) || pad.east,
            .jump = isDown(Action::Jump) || pad.south,
            .run = (walks && isDown(Action::Run)) || pad.west,
            .stick = {pad.leftX, pad.leftY}};
}

}  // namespace terrane::app

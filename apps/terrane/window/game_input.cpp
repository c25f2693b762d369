// What keys, mouse and gamepad do.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "apps/terrane/window/game.h"
#include "terrane/game/container.h"
#include "terrane/view/camera_pose.h"

namespace terrane::app {
namespace {

constexpr double kStickDegrees = 160;  // a second, of a gamepad's stick at its end
constexpr double kDayStep = 0.01;      // of a day, for each press
constexpr double kMessageSeconds = 3;

// By game::Movement.
constexpr std::array<const char*, 4> kMovementTexts = {trLater("movement: fast"), trLater("movement: slow"),
                                                       trLater("movement: not through walls"),
                                                       trLater("movement: on foot")};

// Of the hotbar, by its digit.
std::optional<std::size_t> slotOf(Key key) {
    if (key < Key::Digit1 || key > Key::Digit9) return std::nullopt;
    return static_cast<std::size_t>(key) - static_cast<std::size_t>(Key::Digit1);
}

}  // namespace

void Game::handleEvents() {
    using Type = InputEvent::Type;
    const bool wasCaptured = isCaptured_;  // what moved before the cursor was taken turns nobody
    for (const InputEvent& event : parts_.window.events()) {
        withShift_ = event.withShift;
        withControl_ = event.withControl;
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
                if (isCaptured_ || container_) game::stepSlot(interaction_.hotbar, event.y > 0 ? -1 : 1);
                break;
            case Type::CursorMove:
                if (!wasCaptured || !isCaptured_) break;
                player_.turn(event.x * double{settings_.mouseSensitivity},
                             (settings_.invertY ? -event.y : event.y) * double{settings_.mouseSensitivity});
        }
    }
    withShift_ = parts_.window.keyDown(Key::Shift);
    withControl_ = parts_.window.keyDown(Key::Control);
}

void Game::onKey(Key key) {
    const auto slot = slotOf(key);
    if (slot && hud_.palette.isOpen && hud_.palette.pointedAt != world::kAir) {
        interaction_.hotbar.blocks[*slot] = hud_.palette.pointedAt;
        return;
    }
    const bool closesPalette = hud_.palette.isOpen && key == Key::Tab;
    if (closesPalette || (key == Key::Escape && hud_.hasDialog())) return capture(true);
    if (settingsDialog_.takeKey(key, settings_, tr_)) return;
    if (building_.isAsking() && !isInMenu()) return void(building_.onKey(key, buildView()));
    if (imgui_.takesKeys()) return;  // Escape ends the typing
    if (key == Key::Escape) return closeOne();
    if (isPaused_ && !showsSettings_ && (key == Key::Q || key == Key::T)) return leave(key == Key::T);
    const auto action = settings_.keys.actionOf(key);
    // What opens nothing is for the game, which stands still in a menu.
    if (isInDialog() && !(action && rowOf(*action).opensSomething)) return;
    if (!isInDialog() && building_.onKey(key, buildView())) return;
    if (withControl_ && onControlKey(key)) return;
    if (slot)
        interaction_.hotbar.chosen = *slot;
    else if (action)
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
        case Action::Facts:
            hud_.showsFacts = !hud_.showsFacts;
            break;
        case Action::HideHud:
            hud_.isHidden = !hud_.isHidden;
            break;
        case Action::FullScreen:
            settings_.fullScreen = !settings_.fullScreen;
            break;
        case Action::Screenshot:
            return takeScreenshot();
        case Action::Chat:
            return beginChat();
        case Action::PlayerList:
            hud_.showsPlayers = parts_.remote && !hud_.showsPlayers;
            break;
        case Action::Earlier:
        case Action::Later:
            if (parts_.remote) return say(tr_("the server keeps the time"));
            parts_.session.clock.shift(action == Action::Later ? kDayStep : -kDayStep);
            break;
        case Action::HoldTime:
            if (parts_.remote) return say(tr_("the server keeps the time"));
            parts_.session.clock.isRunning = !parts_.session.clock.isRunning;
            return say(parts_.session.clock.isRunning ? tr_("time passes") : tr_("time stands still"));
        case Action::Light:
            return nextLight();
        case Action::Movement:
            return nextMovement();
        case Action::Palette:
            return openPalette();
        case Action::Places:
            return openPlaces();
        case Action::Spawn:
            return goToSpawn();
        default:  // held keys: moveKeys()
            break;
    }
}

// False for keys that do with Control what they do without: it is held to sink, too.
bool Game::onControlKey(Key key) {
    if (key != Key::Z && key != Key::Y) return false;
    takeBack(key == Key::Y || withShift_ ? game::HistoryWay::Redo : game::HistoryWay::Undo);
    return true;
}

void Game::openPalette() {
    if (hud_.palette.isOpen) return capture(true);
    capture(false);
    hud_.palette.open();
}

void Game::openPlaces() {
    capture(false);
    hud_.placesDialog.open();
}

void Game::nextLight() {
    using render::LightSampling;
    render::LightSampling& light = settings_.graphics.render.light;
    light = light == LightSampling::Smooth ? LightSampling::Classic : LightSampling::Smooth;
    say(light == LightSampling::Smooth ? tr_("smooth light") : tr_("classic light"));
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
    if (hud_.hasDialog()) return capture(true);
    if (showsSettings_) {
        showsSettings_ = false;
        return;
    }
    if (building_.close()) return;
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
    sounds_.click();
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
    const std::size_t next = (static_cast<std::size_t>(settings_.movement) + 1) % kMovementTexts.size();
    settings_.movement = static_cast<game::Movement>(next);
    say(tr_(kMovementTexts[next]));
}

// The sticks move and turn, as moveKeys() and this see them; buttons do what keys and the mouse do.
void Game::onPad(double seconds) {
    pad_.read(parts_.window.gamepad());
    const bool isBack = isInDialog() && pad_.isPressed(&Gamepad::east);
    if (pad_.isPressed(&Gamepad::start) || isBack) closeOne();
    if (showsSettings_ && pad_.isPressed(&Gamepad::leftBumper)) settingsDialog_.turnPage(-1);
    if (showsSettings_ && pad_.isPressed(&Gamepad::rightBumper)) settingsDialog_.turnPage(1);
    if (isInDialog()) return;
    player_.turn(double{pad_.now().rightX} * kStickDegrees * seconds,
                 (settings_.invertY ? 1.0 : -1.0) * double{pad_.now().rightY} * kStickDegrees * seconds);
    pad_.drive(interaction_.breaking, &Gamepad::rightTrigger);
    pad_.drive(interaction_.building, &Gamepad::leftTrigger);
    if (pad_.isPressed(&Gamepad::leftBumper)) game::stepSlot(interaction_.hotbar, -1);
    if (pad_.isPressed(&Gamepad::rightBumper)) game::stepSlot(interaction_.hotbar, 1);
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
        if (isCaptured_ && building_.isSelecting())
            capture(false);  // the panel of the tool has buttons
        else if (isCaptured_)
            interaction_.pick(parts_.session);
        else if (!isInDialog())
            capture(true);
        return;
    }
    if (isCaptured_ && building_.onButton(button, buildView())) return;
    if (isCaptured_ && button == MouseButton::Right && useTarget()) return;
    if (isCaptured_) return held->press();
    if (!imgui_.takesMouse() && !isInDialog()) capture(true);
}

// What is looked at, unless the player runs: then it builds against that.
bool Game::useTarget() {
    if (withShift_) return false;
    return openContainer() || openSign() || interaction_.use(parts_.session, game::kLocalPlayer);
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
        hud_.closeDialog();
    }
    interaction_.breaking.cancel();
    interaction_.building.cancel();
}

void Game::say(std::string message) {
    message_ = std::move(message);
    messageSeconds_ = kMessageSeconds;
}

game::MoveKeys Game::moveKeys() const {
    if (isInDialog() || (building_.isSelecting() && parts_.window.keyDown(Key::Control))) return {};
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
            .up = isDown(Action::Up) || (!walks && !building_.isSelecting() && isDown(Action::Run)),
            .down = isDown(Action::Down) || pad.east,
            .jump = isDown(Action::Jump) || pad.south,
            .run = (walks && isDown(Action::Run)) || pad.west,
            .jumpsByItself = settings_.autoJump,
            .stick = {pad.leftX, pad.leftY}};
}

}  // namespace terrane::app

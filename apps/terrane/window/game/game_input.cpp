#include "apps/terrane/window/game/game_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "apps/terrane/window/game/game_menu.h"
#include "apps/terrane/window/game/pictures.h"
#include "apps/terrane/window/text.h"
#include "terrane/game/items.h"
#include "terrane/game/spawn.h"

namespace terrane::app {

namespace {

constexpr double kDayStep = 0.01;  // of a day, per press

// Indexed by game::Movement.
constexpr std::array<const char*, 4> kMovementTexts = {
    trLater("movement: flying fast, through blocks"), trLater("movement: flying slowly, through blocks"),
    trLater("movement: flying, with collisions"), trLater("movement: walking")};

void flip(bool& value) {
    value = !value;
}

void openPalette(GameState& game) {
    if (game.hud.palette.isOpen) return captureMouse(game, true);
    captureMouse(game, false);
    game.hud.palette.open();
}

void openPlaces(GameState& game) {
    captureMouse(game, false);
    game.hud.placesDialog.open();
}

void beginChat(GameState& game) {
    if (!game.remote.play) return;
    captureMouse(game, false);
    game.remote.chat.beginTyping();
}

void showPanel(GameState& game) {
    game.debug.showsPanel = !game.debug.showsPanel;
    if (game.debug.showsPanel) captureMouse(game, false);
}

void nextLight(GameState& game) {
    using render::LightSampling;
    LightSampling& light = game.settings.graphics.render.light;
    light = light == LightSampling::Smooth ? LightSampling::Classic : LightSampling::Smooth;
    game.notices.say(light == LightSampling::Smooth ? game.tr("smooth light") : game.tr("classic light"));
}

void nextMovement(GameState& game) {
    const std::size_t next = (static_cast<std::size_t>(game.settings.movement) + 1) % kMovementTexts.size();
    game.settings.movement = static_cast<game::Movement>(next);
    game.notices.say(game.tr(kMovementTexts[next]));
}

void changeTime(GameState& game, Action action) {
    game::DayClock& clock = game.parts.session.clock;
    if (game.remote.play) return game.notices.say(game.tr("the server sets the time"));
    if (action != Action::HoldTime) return clock.shift(action == Action::Later ? kDayStep : -kDayStep);
    clock.isRunning = !clock.isRunning;
    game.notices.say(clock.isRunning ? game.tr("time runs") : game.tr("time is stopped"));
}

void saveBookmark(GameState& game) {
    const auto done = game::appendBookmark(game.bookmarks.file, game.player.pose());
    game.notices.say(
        done ? fmt::format(fmt::runtime(game.tr("bookmark saved in {}")), game.bookmarks.file.string())
             : done.error().message);
}

void nextBookmark(GameState& game) {
    const auto bookmarks = game::readBookmarks(game.bookmarks);
    if (!bookmarks) return game.notices.say(bookmarks.error().message);
    if (bookmarks->empty()) return game.notices.say(game.tr("no bookmark is saved yet"));
    game.player.placeAt((*bookmarks)[game.nextBookmark++ % bookmarks->size()], game.settings.movement);
}

void goToSpawn(GameState& game) {
    const game::Session& session = game.parts.session;
    if (!game.hud.spawn) game.hud.spawn = game::findSpawn(session.generator(), session.blocks());
    game.player.placeAt(*game.hud.spawn, game.settings.movement);
    game.notices.say(game.tr("back at the spawn"));
}

void takeScreenshot(GameState& game) {
    if (!hasWorldImage(game)) return;
    const base::Image image = game.parts.renderer.readImage();
    const auto file = writeScreenshot(game.options.dataFolder / "screenshots", image);
    if (file) game.hud.screenshot.show(image);
    game.notices.say(file ? fmt::format(fmt::runtime(game.tr("screenshot {}")), file->string())
                          : file.error().message);
}

}  // namespace

void act(GameState& game, Action action) {
    switch (action) {
        case Action::Help:
            game.notices.helpSeconds = game.notices.helpSeconds > 0 ? 0 : Notices::kHelpSeconds;
            break;
        case Action::Panel:
            return showPanel(game);
        case Action::TopView:
            return flip(game.debug.isAbove);
        case Action::LoadingMap:
            return flip(game.debug.showsLoading);
        case Action::SaveBookmark:
            return saveBookmark(game);
        case Action::NextBookmark:
            return nextBookmark(game);
        case Action::Facts:
            return flip(game.hud.showsFacts);
        case Action::HideHud:
            return flip(game.hud.isHidden);
        case Action::FullScreen:
            return flip(game.settings.fullScreen);
        case Action::Screenshot:
            return takeScreenshot(game);
        case Action::Chat:
            return beginChat(game);
        case Action::PlayerList:
            game.remote.showsPlayers = game.remote.play && !game.remote.showsPlayers;
            break;
        case Action::Earlier:
        case Action::Later:
        case Action::HoldTime:
            return changeTime(game, action);
        case Action::Light:
            return nextLight(game);
        case Action::Movement:
            return nextMovement(game);
        case Action::Palette:
            return openPalette(game);
        case Action::Places:
            return openPlaces(game);
        case Action::Spawn:
            return goToSpawn(game);
        default:  // held keys
            break;
    }
}

void breakAndBuild(GameState& game, double seconds) {
    game::Session& session = game.parts.session;
    const auto& target = game.interaction.target();
    const std::optional<world::BlockPos> pos = target ? std::optional(target->block) : std::nullopt;
    const world::BlockId before = pos ? session.world().block(*pos) : world::kAir;
    const auto result = game.interaction.act(session, game::kLocalPlayer, game.player, seconds);
    if (!result) return;
    game.hud.hand.swing();
    if (std::string text = refusalText(*result, game.tr); !text.empty()) game.notices.say(std::move(text));
    if (pos && before != world::kAir && session.world().block(*pos) == world::kAir)
        game.hud.particles.burst(*pos, before);
}

void takeBack(GameState& game, game::HistoryWay way) {
    const auto done = game.parts.session.takeBack(game::kLocalPlayer, way);
    std::string text = takenBackText(done, way, game.tr);
    if (!text.empty()) game.notices.say(std::move(text));
}

void writeThumbnailOf(GameState& game) {
    game.untilThumbnail = kThumbnailPause;
    if (game.options.thumbnail.empty() || !hasWorldImage(game)) return;
    writeThumbnail(game.options.thumbnail, game.parts.renderer.readImage());
}

namespace {

constexpr double kStickDegrees = 160;  // per second, with the stick fully tilted
constexpr double kTimePause = 0.4;     // seconds that a key of time is held until it repeats
constexpr double kHeldDays = 0.1;      // per second

// The slot of the hotbar for a digit.
std::optional<std::size_t> slotOf(Key key) {
    if (key < Key::Digit1 || key > Key::Digit9) return std::nullopt;
    return static_cast<std::size_t>(key) - static_cast<std::size_t>(Key::Digit1);
}

// False for keys that do the same with and without Control, since Control is also held to sink.
bool onControlKey(GameState& game, Key key) {
    if (key != Key::Z && key != Key::Y) return false;
    takeBack(game, key == Key::Y || game.input.withShift ? game::HistoryWay::Redo : game::HistoryWay::Undo);
    return true;
}

// Passes a key to the open dialog; true if it handled the key.
bool onDialogKey(GameState& game, Key key) {
    PaletteState& palette = game.hud.palette;
    const auto slot = slotOf(key);
    if (slot && palette.isOpen && palette.pointedAt != world::kAir) {
        game.interaction.hotbar.blocks[*slot] = palette.pointedAt;
        return true;
    }
    const bool closesPalette = palette.isOpen && key == Key::Tab;
    if (closesPalette || (key == Key::Escape && hasOpenDialog(game))) {
        captureMouse(game, true);
        return true;
    }
    if (game.menu.showsSettings && game.menu.settings.takeKey(key, game.settings, game.tr)) return true;
    if (game.building.isAsking() && !isInMenu(game)) {
        game.building.onKey(key, buildViewOf(game));
        return true;
    }
    return game.imgui.takesKeys();  // Escape ends text input
}

void onKey(GameState& game, Key key) {
    if (onDialogKey(game, key)) return;
    if (key == Key::Escape) return closeOne(game);
    const bool isMenuAlone = game.menu.isPaused && !game.menu.showsSettings;
    if (isMenuAlone && (key == Key::Q || key == Key::T)) return leave(game, key == Key::T);
    const auto action = game.settings.keys.actionOf(key);
    // In a menu the game is paused: only actions that open something work.
    if (isInDialog(game) && !(action && rowOf(*action).opensSomething)) return;
    if (!isInDialog(game) && game.building.onKey(key, buildViewOf(game))) return;
    if (game.input.withControl && onControlKey(game, key)) return;
    if (const auto slot = slotOf(key))
        game.interaction.hotbar.chosen = *slot;
    else if (action)
        act(game, *action);
}

bool openContainer(GameState& game) {
    const auto& target = game.interaction.target();
    const game::Session& session = game.parts.session;
    if (!target || !game::isContainer(session.world(), session.blocks(), target->block)) return false;
    game.container = target->block;
    captureMouse(game, false);
    return true;
}

bool openSign(GameState& game) {
    const auto& target = game.interaction.target();
    return target && game.building.openSign(target->block, buildViewOf(game));
}

// Uses the targeted block, unless Shift is held: then a block is built against it.
bool useTarget(GameState& game) {
    if (game.input.withShift) return false;
    return openContainer(game) || openSign(game) ||
           game.interaction.use(game.parts.session, game::kLocalPlayer);
}

void onMiddleButton(GameState& game) {
    if (game.input.isCaptured && game.building.isSelecting())
        captureMouse(game, false);  // the panel of the tool has buttons
    else if (game.input.isCaptured)
        game.interaction.pick(game.parts.session);
    else if (!isInDialog(game))
        captureMouse(game, true);
}

void onButton(GameState& game, MouseButton button, bool isPress) {
    const bool isCaptured = game.input.isCaptured;
    if (button == MouseButton::Middle) {
        if (isPress) onMiddleButton(game);
        return;
    }
    game::HeldButton& held =
        button == MouseButton::Left ? game.interaction.breaking : game.interaction.building;
    if (!isPress) return held.release();
    if (isCaptured && game.building.onButton(button, buildViewOf(game))) return;
    if (isCaptured && button == MouseButton::Right && useTarget(game)) return;
    if (isCaptured) return held.press();
    if (!game.imgui.takesMouse() && !isInDialog(game)) captureMouse(game, true);
}

bool isKeyDown(const GameState& game, Action action) {
    const auto isDown = [&](Key key) { return game.parts.window.keyDown(key); };
    return !game.imgui.takesKeys() && std::ranges::any_of(game.settings.keys.keysOf(action), isDown);
}

void turn(GameState& game, const InputEvent& event) {
    const double degrees = game.settings.mouseSensitivity;
    game.player.turn(event.x * degrees, (game.settings.invertY ? -event.y : event.y) * degrees);
}

}  // namespace

void handleEvents(GameState& game) {
    using Type = InputEvent::Type;
    GameInput& input = game.input;
    const Window& window = game.parts.window;
    const bool wasCaptured = input.isCaptured;  // ignore motion before the capture
    for (const InputEvent& event : window.events()) {
        input.withShift = event.withShift;
        input.withControl = event.withControl;
        switch (event.type) {
            case Type::KeyPress:
                onKey(game, event.key);
                break;
            case Type::ButtonPress:
            case Type::ButtonRelease:
                onButton(game, event.button, event.type == Type::ButtonPress);
                break;
            case Type::Wheel:
                if (input.isCaptured || game.container)
                    game::stepSlot(game.interaction.hotbar, -input.wheel.turn(event.y));
                break;
            case Type::CursorMove:
                if (wasCaptured && input.isCaptured) turn(game, event);
        }
    }
    input.withShift = window.keyDown(Key::Shift);
    input.withControl = window.keyDown(Key::Control);
}

void handlePad(GameState& game, double seconds) {
    PadReader& pad = game.input.pad;
    pad.read(game.parts.window.gamepad());
    const bool isBack = isInDialog(game) && pad.isPressed(&Gamepad::east);
    if (pad.isPressed(&Gamepad::start) || isBack) closeOne(game);
    if (game.menu.showsSettings && pad.isPressed(&Gamepad::leftBumper)) game.menu.settings.turnPage(-1);
    if (game.menu.showsSettings && pad.isPressed(&Gamepad::rightBumper)) game.menu.settings.turnPage(1);
    if (isInDialog(game)) return;
    const double degrees = kStickDegrees * seconds;
    game.player.turn(double{pad.now().rightX} * degrees,
                     (game.settings.invertY ? 1.0 : -1.0) * double{pad.now().rightY} * degrees);
    pad.drive(game.interaction.breaking, &Gamepad::rightTrigger);
    pad.drive(game.interaction.building, &Gamepad::leftTrigger);
    if (pad.isPressed(&Gamepad::leftBumper)) game::stepSlot(game.interaction.hotbar, -1);
    if (pad.isPressed(&Gamepad::rightBumper)) game::stepSlot(game.interaction.hotbar, 1);
    if (pad.isPressed(&Gamepad::north)) act(game, Action::Movement);
    if (pad.isPressed(&Gamepad::up)) act(game, Action::Later);
    if (pad.isPressed(&Gamepad::down)) act(game, Action::Earlier);
}

// A press alone is a step (act()).
void passHeldTime(GameState& game, double seconds) {
    const Gamepad& pad = game.input.pad.now();
    const bool isLater = isKeyDown(game, Action::Later) || pad.up;
    const bool isEarlier = isKeyDown(game, Action::Earlier) || pad.down;
    const bool isHeld = isLater != isEarlier && !isInDialog(game) && !game.input.withControl;
    game.input.timeHeldSeconds = isHeld ? game.input.timeHeldSeconds + seconds : 0;
    if (game.input.timeHeldSeconds > kTimePause && !game.remote.play)
        game.parts.session.clock.shift((isLater ? kHeldDays : -kHeldDays) * seconds);
}

game::MoveKeys moveKeysOf(const GameState& game) {
    const Window& window = game.parts.window;
    const bool isSelecting = game.building.isSelecting();
    if (isInDialog(game) || (isSelecting && window.keyDown(Key::Control))) return {};
    const Gamepad& pad = game.input.pad.now();
    const bool walks = game.settings.movement == game::Movement::Gravity;
    const auto isDown = [&](Action action) { return isKeyDown(game, action); };
    return {.forward = isDown(Action::Forward),
            .back = isDown(Action::Back),
            .left = isDown(Action::Left),
            .right = isDown(Action::Right),
            .up = isDown(Action::Up) || (!walks && !isSelecting && isDown(Action::Run)),
            .down = isDown(Action::Down) || pad.east,
            .jump = isDown(Action::Jump) || pad.south,
            .run = (walks && isDown(Action::Run)) || pad.west,
            .jumpsByItself = game.settings.autoJump,
            .stick = {pad.leftX, pad.leftY}};
}

}  // namespace terrane::app

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

// The following return what the player is told; empty: nothing.

std::string nextLight(render::LightSampling& light, const Texts& tr) {
    using render::LightSampling;
    light = light == LightSampling::Smooth ? LightSampling::Classic : LightSampling::Smooth;
    return light == LightSampling::Smooth ? tr("smooth light") : tr("classic light");
}

std::string nextMovement(game::Movement& movement, const Texts& tr) {
    const std::size_t next = (static_cast<std::size_t>(movement) + 1) % kMovementTexts.size();
    movement = static_cast<game::Movement>(next);
    return tr(kMovementTexts[next]);
}

std::string changeTime(game::DayClock& clock, Action action, const Texts& tr) {
    if (action != Action::HoldTime) {
        clock.shift(action == Action::Later ? kDayStep : -kDayStep);
        return {};
    }
    clock.isRunning = !clock.isRunning;
    return clock.isRunning ? tr("time runs") : tr("time is stopped");
}

std::string saveBookmark(const std::filesystem::path& file, const world::Pose& pose, const Texts& tr) {
    const auto done = game::appendBookmark(file, pose);
    return done ? fmt::format(fmt::runtime(tr("bookmark saved in {}")), file.string()) : done.error().message;
}

std::string nextBookmark(const game::BookmarkFiles& files, std::size_t& next, game::Player& player,
                         game::Movement movement, const Texts& tr) {
    const auto bookmarks = game::readBookmarks(files);
    if (!bookmarks) return bookmarks.error().message;
    if (bookmarks->empty()) return tr("no bookmark is saved yet");
    player.placeAt((*bookmarks)[next++ % bookmarks->size()], movement);
    return {};
}

std::string goToSpawn(std::optional<world::Pose>& spawn, const game::Session& session, game::Player& player,
                      game::Movement movement, const Texts& tr) {
    if (!spawn) spawn = game::findSpawn(session.generator(), session.blocks());
    player.placeAt(*spawn, movement);
    return tr("back at the spawn");
}

std::string takeScreenshot(const render::Renderer& renderer, const std::filesystem::path& folder,
                           ScreenshotView& shown, const Texts& tr) {
    if (!hasWorldImage(renderer)) return {};
    const base::Image image = renderer.readImage();
    const auto file = writeScreenshot(folder, image);
    if (file) shown.show(image);
    return file ? fmt::format(fmt::runtime(tr("screenshot {}")), file->string()) : file.error().message;
}

}  // namespace

void act(GameState& game, Action action) {
    const Texts& tr = game.tr;
    game::Session& session = game.parts.session;
    const game::Movement movement = game.settings.movement;
    const auto say = [&](std::string text) { game.notices.say(std::move(text)); };
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
            return say(saveBookmark(game.bookmarks.file, game.player.pose(), tr));
        case Action::NextBookmark:
            return say(nextBookmark(game.bookmarks, game.nextBookmark, game.player, movement, tr));
        case Action::Facts:
            return flip(game.hud.showsFacts);
        case Action::HideHud:
            return flip(game.hud.isHidden);
        case Action::FullScreen:
            return flip(game.settings.fullScreen);
        case Action::Screenshot:
            return say(takeScreenshot(game.parts.renderer, game.options.dataFolder / "screenshots",
                                      game.hud.screenshot, tr));
        case Action::Chat:
            return beginChat(game);
        case Action::PlayerList:
            game.remote.showsPlayers = game.remote.play && !game.remote.showsPlayers;
            break;
        case Action::Earlier:
        case Action::Later:
        case Action::HoldTime:
            return say(game.remote.play ? tr("the server sets the time")
                                        : changeTime(session.clock, action, tr));
        case Action::Light:
            return say(nextLight(game.settings.graphics.render.light, tr));
        case Action::Movement:
            return say(nextMovement(game.settings.movement, tr));
        case Action::Palette:
            return openPalette(game);
        case Action::Places:
            return openPlaces(game);
        case Action::Spawn:
            return say(goToSpawn(game.hud.spawn, session, game.player, movement, tr));
        default:  // held keys
            break;
    }
}

std::optional<game::EditResult> breakAndBuild(game::BlockInteraction& interaction, game::Session& session,
                                              const game::Player& player, Hud& hud, double seconds) {
    const auto& target = interaction.target();
    const std::optional<world::BlockPos> pos = target ? std::optional(target->block) : std::nullopt;
    const world::BlockId before = pos ? session.world().block(*pos) : world::kAir;
    const auto result = interaction.act(session, game::kLocalPlayer, player, seconds);
    if (!result) return result;
    hud.hand.swing();
    if (pos && before != world::kAir && session.world().block(*pos) == world::kAir)
        hud.particles.burst(*pos, before);
    return result;
}

void writeThumbnailOf(const render::Renderer& renderer, const std::filesystem::path& file) {
    if (!file.empty() && hasWorldImage(renderer)) writeThumbnail(file, renderer.readImage());
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

// Passes a key to the open dialog; true if it handled the key.
bool onDialogKey(GameState& game, Key key) {
    PaletteState& palette = game.hud.palette;
    const auto slot = slotOf(key);
    if (slot && palette.isOpen && palette.pointedAt != world::kAir) {
        game.interaction.hotbar.blocks[*slot] = palette.pointedAt;
        return true;
    }
    const bool closesPalette = palette.isOpen && key == Key::Tab;
    if (closesPalette || (key == Key::Escape && hasOpenDialog(game.hud, game.remote.chat))) {
        captureMouse(game, true);
        return true;
    }
    if (game.menu.showsSettings && game.menu.settings.takeKey(key, game.settings, game.tr)) return true;
    if (game.building.isAsking() && !isInMenu(game.menu)) {
        game.building.onKey(key, buildViewOf(game));
        return true;
    }
    return game.imgui.takesKeys();  // Escape ends text input
}

void onKey(GameState& game, Key key) {
    if (onDialogKey(game, key)) return;
    if (key == Key::Escape) return closeOne(game);
    const bool isMenuAlone = game.menu.isPaused && !game.menu.showsSettings;
    if (isMenuAlone && (key == Key::Q || key == Key::T)) return leave(game.leaving, key == Key::T);
    const auto action = game.settings.keys.actionOf(key);
    // In a menu the game is paused: only actions that open something work.
    if (isInDialog(game) && !(action && rowOf(*action).opensSomething)) return;
    if (!isInDialog(game) && game.building.onKey(key, buildViewOf(game))) return;
    // Other keys do the same with Control, which is also held to sink.
    if (game.input.withControl && (key == Key::Z || key == Key::Y)) {
        const bool isRedo = key == Key::Y || game.input.withShift;
        const auto way = isRedo ? game::HistoryWay::Redo : game::HistoryWay::Undo;
        const game::UndoResult done = game.parts.session.undoOrRedo(game::kLocalPlayer, way);
        return game.notices.say(takenBackText(done, way, game.tr));
    }
    if (const auto slot = slotOf(key))
        game.interaction.hotbar.selected = *slot;
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

// Uses the targeted block, unless Shift is held: then a block is built against it.
bool useTarget(GameState& game) {
    if (game.input.withShift) return false;
    if (openContainer(game)) return true;
    const auto& target = game.interaction.target();
    return (target && game.building.openSign(target->block, buildViewOf(game))) ||
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

// Whether a key of the action is held, unless the user interface takes keys.
bool isKeyDown(const Window& window, const ImguiLayer& imgui, const KeyBindings& keys, Action action) {
    const auto isDown = [&](Key key) { return window.keyDown(key); };
    return !imgui.takesKeys() && std::ranges::any_of(keys.keysOf(action), isDown);
}

void turn(game::Player& player, const PlaySettings& settings, const InputEvent& event) {
    const double degrees = settings.mouseSensitivity;
    player.turn(event.x * degrees, (settings.invertY ? -event.y : event.y) * degrees);
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
                    game::cycleSlot(game.interaction.hotbar, -input.wheel.turn(event.y));
                break;
            case Type::CursorMove:
                if (wasCaptured && input.isCaptured) turn(game.player, game.settings, event);
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
    if (pad.isPressed(&Gamepad::leftBumper)) game::cycleSlot(game.interaction.hotbar, -1);
    if (pad.isPressed(&Gamepad::rightBumper)) game::cycleSlot(game.interaction.hotbar, 1);
    if (pad.isPressed(&Gamepad::north)) act(game, Action::Movement);
    if (pad.isPressed(&Gamepad::up)) act(game, Action::Later);
    if (pad.isPressed(&Gamepad::down)) act(game, Action::Earlier);
}

// A press alone is a step (act()).
void passHeldTime(GameState& game, double seconds) {
    const Gamepad& pad = game.input.pad.now();
    const auto isDown = [&](Action action) {
        return isKeyDown(game.parts.window, game.imgui, game.settings.keys, action);
    };
    const bool isLater = isDown(Action::Later) || pad.up;
    const bool isEarlier = isDown(Action::Earlier) || pad.down;
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
    const auto isDown = [&](Action action) {
        return isKeyDown(window, game.imgui, game.settings.keys, action);
    };
    return {.forward = isDown(Action::Forward),
            .back = isDown(Action::Back),
            .left = isDown(Action::Left),
            .right = isDown(Action::Right),
            .up = isDown(Action::Up) || (!walks && !isSelecting && isDown(Action::Run)),
            .down = isDown(Action::Down) || pad.east,
            .jump = isDown(Action::Jump) || pad.south,
            .run = (walks && isDown(Action::Run)) || pad.west,
            .autoJump = game.settings.autoJump,
            .stick = {pad.leftX, pad.leftY}};
}

}  // namespace terrane::app

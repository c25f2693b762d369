#include "apps/terrane/window/game/game_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "apps/terrane/window/game/game_menu.h"
#include "apps/terrane/window/game/pictures.h"
#include "apps/terrane/window/hud/container_dialog.h"
#include "apps/terrane/window/text.h"
#include "terrane/game/items.h"
#include "terrane/game/spawn.h"

namespace terrane::app {

namespace {

constexpr double kDayStep = 0.01;  // of a day, per press

// Indexed by game::Movement.
constexpr std::array<const char*, 3> kMovementTexts = {
    trLater("movement: walking"), trLater("movement: flying"), trLater("movement: flying through blocks")};

void flip(bool& value) {
    value = !value;
}

// In survival the player's items; `workbench`: with its grid.
void openItems(GameState& game, std::optional<world::BlockPos> workbench) {
    captureMouse(game, false);
    game.hud.inventory = {.isOpen = true, .workbench = workbench, .carried = {}};
}

// All blocks, or in survival the player's items.
void openPalette(GameState& game) {
    if (game.hud.palette.isOpen || game.hud.inventory.isOpen) return captureMouse(game, true);
    if (isInSurvival(game)) return openItems(game, {});
    captureMouse(game, false);
    game.hud.palette.open();
}

void openPlaces(GameState& game) {
    captureMouse(game, false);
    game.hud.placesDialog.open();
}

void beginChat(GameState& game) {
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

std::string setMovement(game::Movement& movement, game::Movement next, const Texts& tr) {
    movement = next;
    return tr(kMovementTexts[static_cast<std::size_t>(next)]);
}

game::Movement nextMovement(game::Movement movement) {
    return static_cast<game::Movement>((static_cast<std::size_t>(movement) + 1) % kMovementTexts.size());
}

// Two quick presses begin and end flight, but not flight through blocks: the player may be inside of one.
std::string jump(GameInput& input, game::Movement& movement, double seconds, const Texts& tr) {
    if (!input.jump.press(seconds) || movement == game::Movement::Noclip) return {};
    const bool flies = movement == game::Movement::Fly;
    return setMovement(movement, flies ? game::Movement::Walk : game::Movement::Fly, tr);
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

// Where no other player stands, and not in blocks that were built there.
std::string goToSpawn(GameState& game) {
    game::Session& session = game.parts.session;
    std::optional<world::Pose>& spawn = game.hud.spawn;
    if (!spawn) spawn = game::findSpawn(session.generator(), session.blocks());
    std::vector<world::Aabb> others;
    for (const world::Figure& figure : game.remote.others.figures)
        others.push_back(world::characterBox(figure.eyes - glm::dvec3(0, 0, world::kEyeHeight)));
    game.player.placeAt(game::freePlaceNear(*spawn, session, others), game.settings.movement);
    return game.tr("back at the spawn");
}

std::string takeScreenshot(const render::Renderer& renderer, const std::filesystem::path& folder,
                           ScreenshotView& shown, const Texts& tr) {
    if (!hasWorldImage(renderer)) return {};
    const base::Image image = renderer.readImage();
    const auto file = writeScreenshot(folder, image);
    if (file) shown.show(image);
    return file ? fmt::format(fmt::runtime(tr("screenshot {}")), file->string()) : file.error().message;
}

bool openContainer(GameState& game) {
    const auto& target = game.interaction.target();
    const game::Session& session = game.parts.session;
    if (!target || !game::isContainer(session.world(), session.blocks(), target->block)) return false;
    captureMouse(game, false);
    game.container = target->block;
    game.hud.inventory = {};
    return true;
}

bool openWorkbench(GameState& game) {
    const auto& target = game.interaction.target();
    const game::Session& session = game.parts.session;
    if (!target || !isInSurvival(game) ||
        !canUseWorkbench(session, target->block, game.player.pose().position))
        return false;
    openItems(game, target->block);
    return true;
}

// Uses the targeted block, unless Shift is held: then a block is built against it.
bool useTarget(GameState& game) {
    if (game.input.withShift) return false;
    if (openContainer(game) || openWorkbench(game)) return true;
    const auto& target = game.interaction.target();
    return (target && game.building.openSign(target->block, buildViewOf(game))) ||
           game.interaction.use(game.parts.session, game::kLocalPlayer);
}

// Breaks, or uses and places, by the mouse, a key or a gamepad.
void pressButton(GameState& game, MouseButton button) {
    if (game.building.onButton(button, buildViewOf(game))) return;
    if (button == MouseButton::Right && useTarget(game)) return;
    (button == MouseButton::Left ? game.interaction.breaking : game.interaction.building).press();
}

}  // namespace

void act(GameState& game, Action action, double seconds) {
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
            return say(setMovement(game.settings.movement, nextMovement(movement), tr));
        case Action::Jump:
            return say(jump(game.input, game.settings.movement, seconds, tr));
        case Action::Break:
            game.input.breaksByKey = true;
            return pressButton(game, MouseButton::Left);
        case Action::Place:
            game.input.placesByKey = true;
            return pressButton(game, MouseButton::Right);
        case Action::PreviousSlot:
            return game::cycleSlot(game.interaction.hotbar, -1);
        case Action::NextSlot:
            return game::cycleSlot(game.interaction.hotbar, 1);
        case Action::Palette:
            return openPalette(game);
        case Action::Places:
            return openPlaces(game);
        case Action::Spawn:
            return say(goToSpawn(game));
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
    const bool isItems = game.hud.inventory.isOpen || (game.container && isInSurvival(game));
    const bool closesPalette = (palette.isOpen || isItems) && key == Key::Tab;
    if (closesPalette || (key == Key::Escape && hasOpenDialog(game.hud, game.remote.chat))) {
        captureMouse(game, true);
        return true;
    }
    if (game.remote.chat.isTyping() && (key == Key::PageUp || key == Key::PageDown)) {
        game.remote.chat.scrollPages(key == Key::PageUp ? 1 : -1);
        return true;
    }
    if (game.menu.showsSettings && game.menu.settings.takeKey(key, game.settings, game.tr)) return true;
    if (game.building.isAsking() && !isInMenu(game.menu)) {
        game.building.onKey(key, buildViewOf(game));
        return true;
    }
    return game.imgui.takesKeys();  // Escape ends text input
}

void onKey(GameState& game, Key key, double seconds) {
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
        act(game, *action, seconds);
}

void onMiddleButton(GameState& game) {
    if (game.input.isCaptured && game.building.isSelecting())
        captureMouse(game, false);  // the panel of the tool has buttons
    else if (game.input.isCaptured)
        game.interaction.pick(game.parts.session, game::kLocalPlayer);
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
    if (isCaptured) return pressButton(game, button);
    if (!game.imgui.takesMouse() && !isInDialog(game)) captureMouse(game, true);
}

// `steps`: away from the player.
void onWheel(GameState& game, int steps) {
    if (game.remote.chat.isTyping() && !isInMenu(game.menu)) return game.remote.chat.scroll(steps);
    if (game.input.isCaptured && game.building.onWheel(steps, buildViewOf(game))) return;
    if (game.input.isCaptured || game.container) game::cycleSlot(game.interaction.hotbar, -steps);
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
                onKey(game, event.key, event.seconds);
                break;
            case Type::ButtonPress:
            case Type::ButtonRelease:
                onButton(game, event.button, event.type == Type::ButtonPress);
                break;
            case Type::Wheel:
                onWheel(game, input.wheel.turn(event.y));
                break;
            case Type::CursorMove:
                if (wasCaptured && input.isCaptured) turn(game.player, game.settings, event);
        }
    }
    input.withShift = window.keyDown(Key::Shift);
    input.withControl = window.keyDown(Key::Control);
}

namespace {

// Whether a key or gamepad button of the action is held.
bool isHeld(const GameState& game, Action action) {
    const auto button = game.settings.padButtons.keyOf(action);
    return isKeyDown(game.parts.window, game.imgui, game.settings.keys, action) ||
           (button && game.input.pad.isDown(*button));
}

// Also when the gamepad is unplugged.
void releaseKeys(GameState& game) {
    const auto release = [&](bool& isByKey, Action action, game::HeldButton& held) {
        if (!isByKey || isHeld(game, action)) return;
        isByKey = false;
        held.release();
    };
    release(game.input.breaksByKey, Action::Break, game.interaction.breaking);
    release(game.input.placesByKey, Action::Place, game.interaction.building);
}

}  // namespace

void handlePad(GameState& game, double seconds) {
    PadReader& pad = game.input.pad;
    pad.read(game.parts.window.gamepad());
    releaseKeys(game);
    SettingsDialog& dialog = game.menu.settings;
    const bool isTaken = game.menu.showsSettings && dialog.takePad(pad, game.settings, game.tr);
    game.imgui.setPadIgnored(isTaken);
    if (isTaken) return;
    const bool isBack = isInDialog(game) && pad.isPressed(PadButton::East);
    if (pad.isPressed(PadButton::Start) || isBack) closeOne(game);
    if (game.menu.showsSettings && pad.isPressed(PadButton::LeftBumper)) dialog.turnPage(-1);
    if (game.menu.showsSettings && pad.isPressed(PadButton::RightBumper)) dialog.turnPage(1);
    if (isInDialog(game)) return;
    const double degrees = kStickDegrees * seconds;
    game.player.turn(double{pad.now().rightX} * degrees,
                     (game.settings.invertY ? 1.0 : -1.0) * double{pad.now().rightY} * degrees);
    if (isBack) return;
    for (const PadButtonRow& row : padButtonTable()) {
        const auto action = game.settings.padButtons.actionOf(row.button);
        if (action && pad.isPressed(row.button) && !isInDialog(game))
            act(game, *action, game.parts.window.timeSeconds());
    }
}

// A press alone is a step (act()).
void passHeldTime(GameState& game, double seconds) {
    const bool isLater = isHeld(game, Action::Later), isEarlier = isHeld(game, Action::Earlier);
    const bool isShifted = isLater != isEarlier && !isInDialog(game) && !game.input.withControl;
    game.input.timeHeldSeconds = isShifted ? game.input.timeHeldSeconds + seconds : 0;
    if (game.input.timeHeldSeconds > kTimePause && !game.remote.play)
        game.parts.session.clock.shift((isLater ? kHeldDays : -kHeldDays) * seconds);
}

game::MoveKeys moveKeysOf(const GameState& game) {
    const Window& window = game.parts.window;
    const bool isSelecting = game.building.isSelecting();
    if (isInDialog(game) || (isSelecting && window.keyDown(Key::Control))) return {};
    const Gamepad& pad = game.input.pad.now();
    const auto isDown = [&](Action action) { return isHeld(game, action); };
    return {.forward = isDown(Action::Forward),
            .back = isDown(Action::Back),
            .left = isDown(Action::Left),
            .right = isDown(Action::Right),
            .up = isDown(Action::Up),
            .down = isDown(Action::Down),
            .jump = isDown(Action::Jump),
            .run = isDown(Action::Run),
            .autoJump = game.settings.autoJump,
            .stick = {pad.leftX, pad.leftY}};
}

}  // namespace terrane::app

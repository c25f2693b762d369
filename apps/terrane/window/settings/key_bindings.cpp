#include "apps/terrane/window/settings/key_bindings.h"

#include <algorithm>
#include <cassert>
#include <cctype>

#include "apps/terrane/window/text.h"
#include "terrane/base/text.h"

namespace terrane::app {
namespace {

using Pad = PadButton;

constexpr bool kOpens = true;

constexpr std::array kActions = {
    ActionRow{Action::Forward, "forward", trLater("Walk forward"), Key::W, Key::Up},
    ActionRow{Action::Back, "back", trLater("Walk back"), Key::S, Key::Down},
    ActionRow{Action::Left, "left", trLater("Walk left"), Key::A, Key::Left},
    ActionRow{Action::Right, "right", trLater("Walk right"), Key::D, Key::Right},
    ActionRow{Action::Jump, "jump", trLater("Jump; twice: fly or land"), Key::Space, {}, Pad::South},
    ActionRow{Action::Run, "run", trLater("Run; fly faster"), Key::Shift, {}, Pad::West},
    ActionRow{Action::Up, "up", trLater("Fly or swim up"), Key::E},
    ActionRow{Action::Down, "down", trLater("Fly or swim down"), Key::Q, Key::Control, Pad::East},
    ActionRow{Action::Movement, "movement", trLater("Next movement mode"), Key::M, {}, Pad::North},
    ActionRow{Action::Earlier, "earlier", trLater("Time of day back"), Key::O, {}, Pad::Down},
    ActionRow{Action::Later, "later", trLater("Time of day forward"), Key::P, {}, Pad::Up},
    ActionRow{Action::HoldTime, "hold-time", trLater("Stop or run time"), Key::I},
    ActionRow{Action::Light, "light", trLater("Classic or smooth light"), Key::L},
    ActionRow{Action::Help, "help", trLater("Show the keys"), Key::F1, {}, {}, kOpens},
    ActionRow{Action::Panel, "panel", trLater("Developer panel"), Key::F2, {}, {}, kOpens},
    ActionRow{Action::TopView, "top-view", trLater("Debug top view"), Key::F3, {}, {}, kOpens},
    ActionRow{Action::LoadingMap, "loading-map", trLater("Map of loaded chunks"), Key::F4, {}, {}, kOpens},
    ActionRow{Action::SaveBookmark, "save-bookmark", trLater("Save a bookmark"), Key::F5, {}, {}, kOpens},
    ActionRow{
        Action::NextBookmark, "next-bookmark", trLater("Go to the next bookmark"), Key::F6, {}, {}, kOpens},
    ActionRow{Action::Palette, "palette", trLater("Choose a block; in survival, your items"), Key::Tab},
    ActionRow{Action::Places, "places", trLater("Named places"), Key::N},
    ActionRow{Action::Spawn, "spawn", trLater("Go to the spawn"), Key::H},
    ActionRow{Action::Facts, "facts", trLater("Show the position"), Key::F7, {}, {}, kOpens},
    ActionRow{Action::HideHud, "hide-hud", trLater("Hide the interface"), Key::F8, {}, {}, kOpens},
    ActionRow{Action::FullScreen, "full-screen", trLater("Full screen"), Key::F11, {}, {}, kOpens},
    ActionRow{Action::Screenshot, "screenshot", trLater("Screenshot"), Key::F12, {}, {}, kOpens},
    ActionRow{Action::Chat, "chat", trLater("Chat and commands"), Key::T},
    ActionRow{Action::PlayerList, "players", trLater("List of players"), Key::Y},
    ActionRow{Action::Break, "break", trLater("Break a block"), {}, {}, Pad::RightTrigger},
    ActionRow{Action::Place, "place", trLater("Place or use a block"), {}, {}, Pad::LeftTrigger},
    ActionRow{
        Action::PreviousSlot, "previous-slot", trLater("Previous hotbar slot"), {}, {}, Pad::LeftBumper},
    ActionRow{Action::NextSlot, "next-slot", trLater("Next hotbar slot"), {}, {}, Pad::RightBumper},
};
static_assert(kActions.size() == kActionCount);

struct KeyName {
    Key key;
    std::string_view name;
};

constexpr std::string_view kLettersDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
constexpr KeyName kOtherNames[] = {
    {Key::F1, "F1"},
    {Key::F2, "F2"},
    {Key::F3, "F3"},
    {Key::F4, "F4"},
    {Key::F5, "F5"},
    {Key::F6, "F6"},
    {Key::F7, "F7"},
    {Key::F8, "F8"},
    {Key::F9, "F9"},
    {Key::F10, "F10"},
    {Key::F11, "F11"},
    {Key::F12, "F12"},
    {Key::Escape, "Escape"},
    {Key::Space, trLater("Space")},
    {Key::Tab, "Tab"},
    {Key::Shift, trLater("Shift")},
    {Key::Control, trLater("Control")},
    {Key::Left, trLater("Left")},
    {Key::Right, trLater("Right")},
    {Key::Up, trLater("Up")},
    {Key::Down, trLater("Down")},
    {Key::Enter, "Enter"},
    {Key::Delete, "Delete"},
    {Key::Insert, "Insert"},
    {Key::Backspace, "Backspace"},
    {Key::Home, "Home"},
    {Key::End, "End"},
    {Key::PageUp, "PageUp"},
    {Key::PageDown, "PageDown"},
    {Key::Mouse4, trLater("Mouse4")},
    {Key::Mouse5, trLater("Mouse5")},
    {Key::Mouse6, trLater("Mouse6")},
    {Key::Mouse7, trLater("Mouse7")},
    {Key::Mouse8, trLater("Mouse8")},
};

constexpr std::string_view kNone = "none";

bool isSame(std::string_view a, std::string_view b) {
    const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
    return a.size() == b.size() &&
           std::equal(a.begin(), a.end(), b.begin(), [&](char x, char y) { return lower(x) == lower(y); });
}

std::size_t indexOf(Action action) {
    assert(action < Action::kCount && "one of the actions");
    return static_cast<std::size_t>(action);
}

}  // namespace

std::span<const ActionRow> actionTable() {
    return kActions;
}

const ActionRow& rowOf(Action action) {
    const ActionRow& row = kActions[indexOf(action)];
    assert(row.action == action && "the table is in the order of the actions");
    return row;
}

std::string_view nameOf(Key key) {
    for (const KeyName& other : kOtherNames)
        if (other.key == key) return other.name;
    return kLettersDigits.substr(static_cast<std::size_t>(key), 1);
}

std::optional<Key> keyNamed(std::string_view name) {
    for (const KeyName& other : kOtherNames)
        if (isSame(other.name, name)) return other.key;
    for (std::size_t k = 0; k < kLettersDigits.size(); ++k)
        if (isSame(kLettersDigits.substr(k, 1), name)) return static_cast<Key>(k);
    return std::nullopt;
}

bool canBeBound(Key key) {
    return key != Key::Escape && key != Key::B && !(key >= Key::Digit1 && key <= Key::Digit9);
}

std::string_view nameOf(PadButton button) {
    return rowOf(button).name;
}

std::optional<PadButton> padButtonNamed(std::string_view name) {
    for (const PadButtonRow& row : padButtonTable())
        if (isSame(row.name, name)) return row.button;
    return std::nullopt;
}

bool canBeBound(PadButton button) {
    return button != PadButton::Start;
}

namespace {

// What differs between keys and gamepad buttons.
template <class Input>
struct InputKind;

template <>
struct InputKind<Key> {
    static constexpr const char* kWord = "key";
    static constexpr const char* kPlaceholder = "KEY";
    static std::optional<Key> usual(const ActionRow& row) { return row.key; }
    static std::optional<Key> second(const ActionRow& row) { return row.second; }
    static std::optional<Key> named(std::string_view name) { return keyNamed(name); }
};

template <>
struct InputKind<PadButton> {
    static constexpr const char* kWord = "button";
    static constexpr const char* kPlaceholder = "BUTTON";
    static std::optional<PadButton> usual(const ActionRow& row) { return row.pad; }
    static std::optional<PadButton> second(const ActionRow&) { return std::nullopt; }
    static std::optional<PadButton> named(std::string_view name) { return padButtonNamed(name); }
};

}  // namespace

template <class Input>
Bindings<Input>::Bindings() {
    for (const ActionRow& row : kActions) keys_[indexOf(row.action)] = InputKind<Input>::usual(row);
}

template <class Input>
std::optional<Input> Bindings<Input>::keyOf(Action action) const {
    return keys_[indexOf(action)];
}

template <class Input>
std::optional<Action> Bindings<Input>::actionOf(Input key) const {
    for (const ActionRow& row : kActions)
        if (keyOf(row.action) == key) return row.action;
    for (const ActionRow& row : kActions)
        if (InputKind<Input>::second(row) == key) return row.action;
    return std::nullopt;
}

template <class Input>
std::vector<Input> Bindings<Input>::keysOf(Action action) const {
    std::vector<Input> keys;
    if (const auto key = keyOf(action)) keys.push_back(*key);
    const auto second = InputKind<Input>::second(rowOf(action));
    if (second && second != keyOf(action) && actionOf(*second) == action) keys.push_back(*second);
    return keys;
}

template <class Input>
std::optional<Action> Bindings<Input>::bind(Action action, Input key) {
    if (!canBeBound(key)) return std::nullopt;
    std::optional<Action> loser;
    for (const ActionRow& row : kActions) {
        if (row.action == action || keyOf(row.action) != key) continue;
        loser = row.action;
        keys_[indexOf(row.action)].reset();
    }
    keys_[indexOf(action)] = key;
    return loser;
}

template class Bindings<Key>;
template class Bindings<PadButton>;

namespace {

template <class Input>
std::string differencesOf(const Bindings<Input>& bindings) {
    std::string text;
    for (const ActionRow& row : kActions) {
        const auto key = bindings.keyOf(row.action);
        if (key == InputKind<Input>::usual(row)) continue;
        if (!text.empty()) text += ',';
        text += std::string(row.name) + '=' + std::string(key ? nameOf(*key) : kNone);
    }
    return text;
}

template <class Input>
base::Result<Bindings<Input>> bindingsFrom(std::string_view text) {
    using Kind = InputKind<Input>;
    Bindings<Input> bindings;
    std::vector<Action> without;
    while (!text.empty()) {
        const std::string_view part = text.substr(0, text.find(','));
        text.remove_prefix(std::min(text.size(), part.size() + 1));
        const std::size_t equals = part.find('=');
        if (equals == part.npos)
            return base::fail(base::ErrorCode::BadInput, "expected ACTION={}, got \"{}\"", Kind::kPlaceholder,
                              part);
        const std::string_view name = part.substr(0, equals), keyText = part.substr(equals + 1);
        const auto row = std::ranges::find(kActions, name, &ActionRow::name);
        if (row == kActions.end()) {
            std::vector<std::string> names;
            for (const ActionRow& known : kActions) names.emplace_back(known.name);
            return base::fail(base::ErrorCode::BadInput, "{}", base::expectedOneOf(names, std::string(name)));
        }
        const auto key = Kind::named(keyText);
        const bool isNone = isSame(keyText, kNone);
        if (!isNone && (!key || !canBeBound(*key)))
            return base::fail(base::ErrorCode::BadInput, "{}: \"{}\" is no {} that can be chosen", name,
                              keyText, Kind::kWord);
        isNone ? without.push_back(row->action) : static_cast<void>(bindings.bind(row->action, *key));
    }
    for (const Action action : without) bindings.unbind(action);
    return bindings;
}

}  // namespace

std::string textOf(const KeyBindings& bindings) {
    return differencesOf(bindings);
}

std::string textOf(const PadBindings& bindings) {
    return differencesOf(bindings);
}

base::Result<KeyBindings> keyBindingsFrom(std::string_view text) {
    return bindingsFrom<Key>(text);
}

base::Result<PadBindings> padBindingsFrom(std::string_view text) {
    return bindingsFrom<PadButton>(text);
}

}  // namespace terrane::app

// Bindings: a table of actions with default keys and gamepad buttons, and those that the player chose
// instead. Plain values, for any thread. A new action needs a line in Action and one in actionTable().
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "apps/terrane/window/input.h"
#include "terrane/base/result.h"

namespace terrane::app {

enum class Action : std::uint8_t {
    Forward,
    Back,
    Left,
    Right,
    Jump,
    Run,
    Up,
    Down,
    Movement,
    Earlier,
    Later,
    HoldTime,
    Light,
    Help,
    Panel,
    TopView,
    LoadingMap,
    SaveBookmark,
    NextBookmark,
    Palette,
    Places,
    Spawn,
    Facts,
    HideHud,
    FullScreen,
    Screenshot,
    Chat,
    PlayerList,
    Break,
    Place,
    PreviousSlot,
    NextSlot,
    kCount
};
inline constexpr std::size_t kActionCount = static_cast<std::size_t>(Action::kCount);

struct ActionRow {
    Action action;
    std::string_view name;   // in settings
    const char* label;       // for the player, in English
    std::optional<Key> key;  // default
    // A second default key, active if no other action is bound to it.
    std::optional<Key> second = {};
    std::optional<PadButton> pad = {};  // default
    bool opensSomething = false;        // works in menus too
};
std::span<const ActionRow> actionTable();  // in the order of Action
const ActionRow& rowOf(Action action);

// "A", "F5", "Space"; unique for every key.
std::string_view nameOf(Key key);
std::optional<Key> keyNamed(std::string_view name);  // ignores case
// False for keys with a fixed use: Escape, B (selection tool) and 1 to 9.
bool canBeBound(Key key);

// The same for gamepad buttons. Start opens the menu.
std::string_view nameOf(PadButton button);
std::optional<PadButton> padButtonNamed(std::string_view name);
bool canBeBound(PadButton button);

// `Input`: Key or PadButton.
template <class Input>
class Bindings {
  public:
    Bindings();  // default keys

    std::optional<Input> keyOf(Action action) const;
    std::optional<Action> actionOf(Input key) const;
    // All keys of an action; the second key only if no action is bound to it.
    std::vector<Input> keysOf(Action action) const;

    // Binds the key. Returns the action that lost it, if any.
    std::optional<Action> bind(Action action, Input key);
    void unbind(Action action) { keys_[static_cast<std::size_t>(action)].reset(); }
    bool isUsual() const { return *this == Bindings(); }

    bool operator==(const Bindings&) const = default;

  private:
    std::array<std::optional<Input>, kActionCount> keys_;
};

using KeyBindings = Bindings<Key>;
using PadBindings = Bindings<PadButton>;

// "jump=F,run=none": differences from the defaults; empty if there are none.
std::string textOf(const KeyBindings& bindings);
std::string textOf(const PadBindings& bindings);
// Errors name the wrong word.
[[nodiscard]] base::Result<KeyBindings> keyBindingsFrom(std::string_view text);
[[nodiscard]] base::Result<PadBindings> padBindingsFrom(std::string_view text);

}  // namespace terrane::app

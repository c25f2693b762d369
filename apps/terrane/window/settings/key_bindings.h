// Key bindings: a table of actions with default keys, and the keys that the player chose instead. Plain
// values, for any thread. A new action needs a line in Action and one in actionTable().
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
    kCount
};
inline constexpr std::size_t kActionCount = static_cast<std::size_t>(Action::kCount);

struct ActionRow {
    Action action;
    std::string_view name;  // in settings
    const char* label;      // for the player, in English
    Key key;                // default
    // A second default key, active if no other action is bound to it.
    std::optional<Key> second = {};
    bool opensSomething = false;  // works in menus too
};
std::span<const ActionRow> actionTable();  // in the order of Action
const ActionRow& rowOf(Action action);

// "A", "F5", "Space"; unique for every key.
std::string_view nameOf(Key key);
std::optional<Key> keyNamed(std::string_view name);  // ignores case
// False for keys with a fixed use: Escape, B (selection tool) and 1 to 9.
bool canBeBound(Key key);

class KeyBindings {
  public:
    KeyBindings();  // default keys

    std::optional<Key> keyOf(Action action) const;
    std::optional<Action> actionOf(Key key) const;
    // All keys of an action; the second key only if no action is bound to it.
    std::vector<Key> keysOf(Action action) const;

    // Binds the key. Returns the action that lost it, if any.
    std::optional<Action> bind(Action action, Key key);
    void unbind(Action action) { keys_[static_cast<std::size_t>(action)].reset(); }
    bool isUsual() const;

    bool operator==(const KeyBindings&) const = default;

  private:
    std::array<std::optional<Key>, kActionCount> keys_;
};

// "jump=F,run=none": differences from the defaults; empty if there are none.
std::string textOf(const KeyBindings& bindings);
// Errors name the wrong word.
[[nodiscard]] base::Result<KeyBindings> keyBindingsFrom(std::string_view text);

}  // namespace terrane::app

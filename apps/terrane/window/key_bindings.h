// What each key does: a table of actions with their usual keys, and the keys that a player chose instead.
// Pure values, for any thread. A new action is a line in Action and one in actionTable().
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
    const char* label;      // as a player reads it, in English
    Key key;                // unless the player chose another
    // Does the same where no other action has it.
    std::optional<Key> second = {};
    bool opensSomething = false;  // works in menus, too
};
std::span<const ActionRow> actionTable();  // in the order of Action
const ActionRow& rowOf(Action action);

// "A", "F5", "Space"; every key has one name.
std::string_view nameOf(Key key);
std::optional<Key> keyNamed(std::string_view name);  // in any case
// Escape closes what is open, and 1 to 9 choose a slot: they are not for actions.
bool canBeBound(Key key);

class KeyBindings {
  public:
    KeyBindings();  // the usual keys

    std::optional<Key> keyOf(Action action) const;
    std::optional<Action> actionOf(Key key) const;
    // All keys that do it; the second one only where it is free.
    std::vector<Key> keysOf(Action action) const;

    // Takes the key from another action that has it, which is told.
    std::optional<Action> bind(Action action, Key key);
    void unbind(Action action) { keys_[static_cast<std::size_t>(action)].reset(); }
    void reset(Action action);  // as bind() with the usual key
    bool isUsual() const;

    bool operator==(const KeyBindings&) const = default;

  private:
    std::array<std::optional<Key>, kActionCount> keys_;
};

// "jump=F,run=none": what is not as usual; empty where all is.
std::string textOf(const KeyBindings& bindings);
// An error that names the word that is wrong.
[[nodiscard]] base::Result<KeyBindings> keyBindingsFrom(std::string_view text);

}  // namespace terrane::app

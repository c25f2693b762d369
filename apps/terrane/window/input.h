// Keys, mouse buttons and events of the window, without types of the window library. Read by the program's
// frame loop.
#pragma once

#include <imgui.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "terrane/game/block_interaction.h"

namespace terrane::app {

// Steps of the mouse wheel. Touchpads and smooth wheels turn by parts of a step, or sideways.
class Wheel {
  public:
    // `y`: of an InputEvent of the wheel. Returns the whole steps since the last ones, away from the player;
    // a turn in the other direction begins anew.
    int turn(double y) {
        part_ = part_ * y < 0 ? y : part_ + y;
        const double steps = std::trunc(part_);
        part_ -= steps;
        return static_cast<int>(steps);
    }

  private:
    double part_ = 0;  // of a step
};

// clang-format off
// Letters are positions on a US keyboard, so that WASD stays a square on every layout.
enum class Key : std::uint8_t {
    A, B, C, D, E, F, G, H, I, J, K, L, M, N, O, P, Q, R, S, T, U, V, W, X, Y, Z,
    Digit0, Digit1, Digit2, Digit3, Digit4, Digit5, Digit6, Digit7, Digit8, Digit9,
    F1, F2, F3, F4, F5, F6, F7, F8, F9, F10, F11, F12,
    Escape, Space, Tab, Enter, Delete,
    Shift, Control,  // either side
    Left, Right, Up, Down,
    Insert, Backspace, Home, End, PageUp, PageDown,
    kCount
};
// clang-format on
inline constexpr std::size_t kKeyCount = static_cast<std::size_t>(Key::kCount);

enum class MouseButton : std::uint8_t { Left, Right, Middle };

struct InputEvent {
    enum class Type : std::uint8_t { KeyPress, ButtonPress, ButtonRelease, Wheel, CursorMove };

    Type type = Type::KeyPress;
    Key key = Key::A;                        // of KeyPress
    MouseButton button = MouseButton::Left;  // of the button events
    double x = 0.0;  // Wheel: steps; CursorMove: screen units since the last event, right
    double y = 0.0;  // the same, wheel away from the player, cursor down
    // Modifiers held with a key or button, however briefly; keyDown() may have missed them.
    bool withShift = false, withControl = false;
};

// Sticks are -1…1, right and up; 0 within the dead zone.
struct Gamepad {
    float leftX = 0, leftY = 0, rightX = 0, rightY = 0;
    bool south = false, east = false, west = false, north = false;
    bool leftBumper = false, rightBumper = false;
    bool leftTrigger = false, rightTrigger = false;
    bool up = false, down = false, left = false, right = false;  // of the d-pad
    bool start = false;
};

// Detects presses and releases of gamepad buttons since the last frame, from their current state.
class PadReader {
  public:
    using Button = bool Gamepad::*;

    // Call once per frame. Without a gamepad all buttons count as released.
    void read(const std::optional<Gamepad>& pad) {
        before_ = now_;
        now_ = pad.value_or(Gamepad());
    }
    const Gamepad& now() const { return now_; }
    bool isPressed(Button button) const { return now_.*button && !(before_.*button); }
    bool isReleased(Button button) const { return !(now_.*button) && before_.*button; }
    // Presses and releases `held` with the button; the mouse may hold it as well.
    void drive(game::HeldButton& held, Button button) const {
        if (isPressed(button)) held.press();
        if (isReleased(button)) held.release();
    }

  private:
    Gamepad before_, now_;
};

// Moves through menus with a gamepad.
// Sets Dear ImGui's inputs of a gamepad: d-pad or left stick, lower and right button. Its own back end
// numbers the buttons as the driver does, which differs between systems and pads; GLFW's mapping of known
// pads does not.
void setPadNavigation(const std::optional<Gamepad>& pad, float (&inputs)[ImGuiNavInput_COUNT]);

}  // namespace terrane::app

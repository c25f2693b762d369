// Keys, mouse buttons and events of the window, without types of the window library. Read by the program's
// frame loop.
#pragma once

#include <cstddef>
#include <cstdint>

namespace terrane::app {

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

}  // namespace terrane::app

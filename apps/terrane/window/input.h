// Keys, mouse buttons and events of the window, without types of the window library. Read by the program's
// frame loop.
#pragma once

#include <imgui.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

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
    Mouse4, Mouse5, Mouse6, Mouse7, Mouse8,  // buttons of the mouse beyond the first three
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
    // Modifiers held with a key, button or wheel, however briefly; keyDown() may have missed them.
    bool withShift = false, withControl = false;
    double seconds = 0;  // of the window's clock, of KeyPress
};

// Detects two presses of a key that follow each other quickly, by the time of the events.
class DoublePress {
  public:
    static constexpr double kWithin = 0.3;  // seconds

    // Returns whether this press is the second one. A third one begins anew.
    bool press(double seconds) {
        const bool isSecond = last_ && seconds - *last_ <= kWithin;
        last_ = isSecond ? std::nullopt : std::optional(seconds);
        return isSecond;
    }

  private:
    std::optional<double> last_;
};

// Sticks are -1…1, right and up; 0 within the dead zone.
struct Gamepad {
    float leftX = 0, leftY = 0, rightX = 0, rightY = 0;
    bool south = false, east = false, west = false, north = false;
    bool leftBumper = false, rightBumper = false;
    bool leftTrigger = false, rightTrigger = false;
    bool up = false, down = false, left = false, right = false;  // of the d-pad
    bool start = false, back = false;
    bool leftStick = false, rightStick = false;  // pressed
};

enum class PadButton : std::uint8_t {
    South,
    East,
    West,
    North,
    LeftBumper,
    RightBumper,
    LeftTrigger,
    RightTrigger,
    Up,
    Down,
    Left,
    Right,
    Back,
    LeftStick,
    RightStick,
    Start,
    kCount
};

struct PadButtonRow {
    PadButton button;
    std::string_view name;  // in settings
    const char* label;      // for the player, in English
    bool Gamepad::*member;
};
std::span<const PadButtonRow> padButtonTable();  // in the order of PadButton
const PadButtonRow& rowOf(PadButton button);

// Finds joysticks that are no known gamepad, so that the player is told why they do nothing.
class UnknownPads {
  public:
    struct Joystick {
        std::string guid, name;  // the guid is that of SDL's list of gamepads
        bool isGamepad = false;  // its buttons are known
    };
    // Returns a line for each unknown one that is here for the first time. `mappings`: the file that can
    // describe it.
    std::vector<std::string> take(std::span<const Joystick> joysticks, std::string_view mappings);

  private:
    std::set<std::string> told_;
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
    bool isPressed(PadButton button) const { return isPressed(rowOf(button).member); }
    bool isDown(PadButton button) const { return now_.*rowOf(button).member; }
    bool isAnyDown() const;
    std::optional<PadButton> pressed() const;  // one of those pressed since the last frame

  private:
    Gamepad before_, now_;
};

// Sets Dear ImGui's inputs of a gamepad: d-pad or left stick, lower and right button. Its own back end
// numbers the buttons as the driver does, which differs between systems and pads; GLFW's mapping of known
// pads does not.
void setPadNavigation(const std::optional<Gamepad>& pad, float (&inputs)[ImGuiNavInput_COUNT]);

}  // namespace terrane::app

// The program's window and its input. Used on the program's main thread. Two back ends: GLFW (glfw_window.h),
// and one without a screen for tests, whose events the tests make (tests/window/offscreen_window.h).
#pragma once

#include <array>
#include <cstddef>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "apps/terrane/window/input.h"
#include "terrane/base/result.h"
#include "terrane/gpu/debug.h"

namespace terrane::app {

class WidgetRecord;

struct WindowOptions {
    std::string title = "Terrane";
    int width = 1280;  // screen units, larger where contentScale() is
    int height = 720;
    bool fullScreen = false;       // on the first monitor in its current mode; ignores width and height
    std::string padMappings = {};  // file with lines of SDL's gamecontrollerdb.txt; may be missing
    bool debug = false;            // as ContextOptions
    bool drawsWorlds = true;       // false: only the user interface, which needs OpenGL 3.2
};

// Modifier keys held with a key or button.
struct Modifiers {
    bool shift = false, control = false;
};

// In screen units; the first monitor's corner is often 0,0, and others may be left of it or above.
struct ScreenArea {
    glm::ivec2 corner{0}, size{0};
};

// The index of the monitor with the largest part of the window; the first one of equals, and if the window is
// on none.
std::size_t monitorOf(const ScreenArea& window, std::span<const ScreenArea> monitors);

// Whether frames wait for the vertical sync of the screen. Adaptive: only those that are in time, where the
// driver can; On elsewhere.
enum class Vsync : std::uint8_t { Off, On, Adaptive };

class Window {
  public:
    Window() = default;
    virtual ~Window() = default;
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    // Polls input; the results of the next functions change only here.
    void pollEvents();
    [[nodiscard]] std::span<const InputEvent> events() const { return events_; }
    // Typed characters (Unicode), with those that a held key repeats.
    [[nodiscard]] std::span<const unsigned> characters() const { return characters_; }
    [[nodiscard]] bool anyKeyPressed() const { return isAnyKeyPressed_; }  // also keys that Key does not name
    [[nodiscard]] bool keyDown(Key key) const { return keysDown_[static_cast<std::size_t>(key)] > 0; }
    [[nodiscard]] bool buttonDown(MouseButton button) const {
        return buttonsDown_[static_cast<std::size_t>(button)];
    }
    // Of the cursor, in screen units; none while it is elsewhere.
    [[nodiscard]] virtual std::optional<glm::dvec2> cursor() const = 0;
    // The first gamepad, if there is one.
    [[nodiscard]] virtual std::optional<Gamepad> gamepad() const = 0;
    // The key that types this letter on the player's keyboard.
    [[nodiscard]] virtual Key keyTyping(Key letter) const { return letter; }

    virtual void swapBuffers() = 0;
    [[nodiscard]] virtual bool shouldClose() const = 0;
    virtual void cancelClose() = 0;

    [[nodiscard]] virtual glm::ivec2 size() const = 0;             // screen units
    [[nodiscard]] virtual glm::ivec2 framebufferSize() const = 0;  // pixels; 0 while minimised
    [[nodiscard]] virtual float contentScale() const = 0;          // scale of the user interface
    [[nodiscard]] float pixelsPerUnit() const;                     // framebuffer pixels per screen unit
    // Full screen on the monitor that the window is on, or the former window.
    virtual void setFullScreen(bool isFullScreen) = 0;
    // `pixels`: width × height × 4 bytes, RGBA, top row first. Does nothing on systems without window icons.
    virtual void setIcon(glm::ivec2 size, std::span<const std::byte> pixels) = 0;
    virtual void setVsync(Vsync vsync) = 0;
    virtual void pause(double seconds) = 0;
    [[nodiscard]] virtual double refreshRate() const = 0;  // of the monitor that the window is on, a second

    // A captured cursor is hidden and its motion is unlimited.
    void setCursorCaptured(bool captured);
    virtual void setTextCursor(bool isOverText) = 0;
    [[nodiscard]] virtual std::string clipboard() const = 0;
    virtual void setClipboard(const std::string& text) = 0;
    [[nodiscard]] virtual double timeSeconds() const = 0;  // since the window was made

    // Null without the debug option.
    [[nodiscard]] virtual gpu::DebugLog* debugLog() const = 0;
    // Receives the widgets of each frame; null: nobody reads them.
    [[nodiscard]] virtual WidgetRecord* widgets() { return nullptr; }

    // Input, reported by the back end during pollEvents().
    void onKey(std::optional<Key> key, bool isPress, Modifiers with);  // not for repetitions of a held key
    void onCharacter(unsigned character);
    // `number`: 0 left, 1 right, 2 middle; further ones are keys.
    void onMouseButton(int number, bool isPress, Modifiers with);
    void onButton(MouseButton button, bool isPress, Modifiers with);
    void onWheel(glm::dvec2 steps);
    void onCursor(glm::dvec2 position);

  protected:
    virtual void receiveEvents() = 0;
    virtual void captureCursor(bool isCaptured) = 0;

  private:
    std::vector<InputEvent> events_;
    std::vector<unsigned> characters_;
    bool isAnyKeyPressed_ = false;
    std::array<int, kKeyCount> keysDown_{};  // 2 if both keys of a pair are down
    std::array<bool, 3> buttonsDown_{};
    glm::dvec2 lastCursor_{0};
    bool cursorKnown_ = false;  // false: the next position is only a reference
};

}  // namespace terrane::app

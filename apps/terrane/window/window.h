// A window with an OpenGL 4.5 core context and its input, through GLFW. The program's main thread makes one,
// and uses it alone. One window at a time: destroying it ends GLFW.
#pragma once

#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "apps/terrane/window/input.h"
#include "terrane/base/result.h"
#include "terrane/gpu/debug.h"

struct GLFWwindow;

namespace terrane::app {

struct WindowOptions {
    std::string title = "Terrane";
    int width = 1280;  // screen units, larger where contentScale() is
    int height = 720;
    bool fullScreen = false;  // on the first monitor in its present mode; width and height are not used
    bool debug = false;       // as ContextOptions
};

class Window {
  public:
    [[nodiscard]] static base::Result<Window> create(const WindowOptions& options);

    Window();
    Window(Window&&) noexcept;
    Window& operator=(Window&&) noexcept;
    ~Window();

    // Reads what happened since the last call; what the next three tell changes here only.
    void pollEvents();
    [[nodiscard]] std::span<const InputEvent> events() const;
    [[nodiscard]] bool anyKeyPressed() const;  // one that Key does not name, too
    [[nodiscard]] bool keyDown(Key key) const;

    void swapBuffers();
    [[nodiscard]] bool shouldClose() const;
    void cancelClose();

    [[nodiscard]] glm::ivec2 framebufferSize() const;  // pixels; 0 while minimised
    [[nodiscard]] float contentScale() const;          // how much larger than usual things are to be drawn
    [[nodiscard]] float pixelsPerUnit() const;         // pixels of the framebuffer along a screen unit
    // The whole of the first monitor, or a window as it was before.
    void setFullScreen(bool isFullScreen);
    // `pixels`: width × height × 4 bytes, red first, rows from above. Ignored where windows have no icons.
    void setIcon(int width, int height, std::span<const std::byte> pixels);
    // The first gamepad, none where there is none.
    [[nodiscard]] std::optional<Gamepad> gamepad() const;

    void setVsync(bool isOn);  // frames wait for the screen

    // A captured cursor is hidden and moves without end.
    void setCursorCaptured(bool captured);
    [[nodiscard]] double timeSeconds() const;  // since the window was made

    // Null without the debug option.
    [[nodiscard]] gpu::DebugLog* debugLog() const;
    // For user interface libraries with a GLFW back end of their own.
    [[nodiscard]] GLFWwindow* handle() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace terrane::app

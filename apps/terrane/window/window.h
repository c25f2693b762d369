// A GLFW window with an OpenGL 4.5 core context and its input. Used on the program's main thread. One window
// at a time: destroying it terminates GLFW.
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
    bool fullScreen = false;  // on the first monitor in its current mode; ignores width and height
    bool debug = false;       // as ContextOptions
};

class Window {
  public:
    [[nodiscard]] static base::Result<Window> create(const WindowOptions& options);

    Window();
    Window(Window&&) noexcept;
    Window& operator=(Window&&) noexcept;
    ~Window();

    // Polls input; the results of the next three functions change only here.
    void pollEvents();
    [[nodiscard]] std::span<const InputEvent> events() const;
    [[nodiscard]] bool anyKeyPressed() const;  // also keys that Key does not name
    [[nodiscard]] bool keyDown(Key key) const;

    void swapBuffers();
    [[nodiscard]] bool shouldClose() const;
    void cancelClose();

    [[nodiscard]] glm::ivec2 framebufferSize() const;  // pixels; 0 while minimised
    [[nodiscard]] float contentScale() const;          // scale of the user interface
    [[nodiscard]] float pixelsPerUnit() const;         // framebuffer pixels per screen unit
    // Full screen on the first monitor, or the former window.
    void setFullScreen(bool isFullScreen);
    // `pixels`: width × height × 4 bytes, RGBA, top row first. Does nothing on systems without window icons.
    void setIcon(int width, int height, std::span<const std::byte> pixels);
    // The first gamepad, if there is one.
    [[nodiscard]] std::optional<Gamepad> gamepad() const;

    void setVsync(bool isOn);  // frames wait for vertical sync

    // A captured cursor is hidden and its motion is unlimited.
    void setCursorCaptured(bool captured);
    [[nodiscard]] double timeSeconds() const;  // since the window was made

    // Null without the debug option.
    [[nodiscard]] gpu::DebugLog* debugLog() const;
    // For Dear ImGui's GLFW back end.
    [[nodiscard]] GLFWwindow* handle() const;

  private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace terrane::app

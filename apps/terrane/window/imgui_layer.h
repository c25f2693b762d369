// Dear ImGui over a window: set up once, one frame at a time. Used on the window's thread.
#pragma once

#include "terrane/gpu/window.h"

namespace terrane::app {

class ImguiLayer {
  public:
    // `window` outlives this; made after the window's own callbacks.
    explicit ImguiLayer(const gpu::Window& window);
    ~ImguiLayer();
    ImguiLayer(const ImguiLayer&) = delete;
    ImguiLayer& operator=(const ImguiLayer&) = delete;

    // While the cursor is captured the mouse belongs to the game.
    void beginFrame(bool isCursorCaptured);
    // Draws into the window's framebuffer.
    void endFrame();

    bool takesMouse() const;  // the cursor is over something of the user interface
    bool takesKeys() const;   // a text is being typed
};

}  // namespace terrane::app

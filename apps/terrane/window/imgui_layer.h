// Dear ImGui over a window: set up once, one frame at a time. Used on the window's thread.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "apps/terrane/window/window.h"

namespace terrane::app {

class ImguiLayer {
  public:
    // `window` outlives this; made after the window's own callbacks.
    explicit ImguiLayer(const Window& window);
    ~ImguiLayer();
    ImguiLayer(const ImguiLayer&) = delete;
    ImguiLayer& operator=(const ImguiLayer&) = delete;

    // How much larger than usual texts and all around them are, from the next frame on.
    void setTextSize(float factor) { textSize_ = factor; }
    // While the cursor is captured the mouse belongs to the game; in a menu keys and gamepad choose.
    void beginFrame(bool isCursorCaptured, bool isInMenu);
    // Of the window in the units in which Dear ImGui and the cursor count: the pixels of its framebuffer on
    // some systems, fewer on others. Since beginFrame().
    glm::vec2 size() const;
    // Draws into the window's framebuffer.
    void endFrame();

    bool takesMouse() const;  // the cursor is over something of the user interface
    bool takesKeys() const;   // a text is being typed
    bool hasPopup() const;    // a list or menu is open
    void endTyping();         // closes what is open, too

  private:
    struct Scale {
        float content = 0, pixelsPerUnit = 0, textSize = 1;
        bool operator==(const Scale&) const = default;
    };
    void followScale();
    void holdShortPresses();
    void activateByEnter();
    void dropRepeatedText();

    const Window* window_;
    enum class Enter : std::uint8_t { Up, Types, Chooses };

    float textSize_ = 1;
    Enter enter_ = Enter::Up;
    bool acceptsText_ = false;  // a key was pressed since typing began
    Scale scale_;
    std::vector<Key> shortPresses_;  // down and up within the last frame
};

// How much larger than designed the user interface is drawn, in Dear ImGui's units. During a frame.
float uiScale();

}  // namespace terrane::app

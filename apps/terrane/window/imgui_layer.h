// Runs Dear ImGui on a window, one frame at a time. Used on the window's thread.
#pragma once

#include <glm/vec2.hpp>

#include <cstdint>
#include <string>

#include "apps/terrane/window/window.h"

namespace terrane::app {

// The file of the user interface's font, beside the program or of the system; empty if there is none of the
// known ones. It has the letters of all languages.
std::string fontFile();
// Replaces Dear ImGui's fonts by a font `pixels` high; its own font if `file` is empty. Recreate the font
// texture afterwards.
void addFont(float pixels, const std::string& file);
// Call after the texture is made: letters that the font lacks are drawn without their accents.
void replaceMissingLetters();

class ImguiLayer {
  public:
    explicit ImguiLayer(Window& window);  // `window` outlives this
    ~ImguiLayer();
    ImguiLayer(const ImguiLayer&) = delete;
    ImguiLayer& operator=(const ImguiLayer&) = delete;

    // Scale of text and user interface from the next frame on; 1 is the designed size.
    void setTextSize(float factor) { textSize_ = factor; }
    // Whether menus leave the gamepad alone, from the next frame on.
    void setPadIgnored(bool isIgnored) { isPadIgnored_ = isIgnored; }
    // While the cursor is captured Dear ImGui ignores the mouse; in a menu, keys and gamepad navigate.
    void beginFrame(bool isCursorCaptured, bool isInMenu);
    // The window's size in units of Dear ImGui and the cursor: framebuffer pixels on some systems, fewer on
    // others. Valid after beginFrame().
    glm::vec2 size() const;
    // Draws into the window's framebuffer.
    void endFrame();

    bool takesMouse() const;  // the cursor is over the user interface
    bool takesKeys() const;   // a text is being typed
    bool hasPopup() const;    // a list or menu is open
    void endTyping();         // also closes popups

  private:
    struct Scale {
        float content = 0, pixelsPerUnit = 0, textSize = 1;
        bool operator==(const Scale&) const = default;
    };
    void followScale();
    void feedScreen();
    void feedKeys();
    void feedMouse();
    void feedText();
    void activateByEnter();

    enum class Enter : std::uint8_t { Up, Types, Chooses };

    Window& window_;
    float textSize_ = 1;
    bool isPadIgnored_ = false;
    Enter enter_ = Enter::Up;
    bool acceptsText_ = false;  // a key was pressed in the text field
    Scale scale_;
    double seconds_ = 0;     // of the window's clock, at the last frame
    std::string clipboard_;  // as Dear ImGui last read it
};

// The scale of the user interface in Dear ImGui's units, 1 as designed. Call during a frame.
float uiScale();

}  // namespace terrane::app

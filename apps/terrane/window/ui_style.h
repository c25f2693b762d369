// How menus and dialogs look: dark rounded panels, one accent color. Used during a frame of Dear ImGui.
#pragma once

#include <imgui.h>

#include <string>
#include <string_view>

namespace terrane::app {

void setUiStyle(float scale);  // times the design's sizes

namespace colors {
inline const ImVec4 kAccent{0.94f, 0.71f, 0.31f, 1};
inline const ImVec4 kText{0.93f, 0.94f, 0.95f, 1};
inline const ImVec4 kDim{0.66f, 0.69f, 0.72f, 1};
inline const ImVec4 kWarning{0.98f, 0.55f, 0.42f, 1};
}  // namespace colors

// The program's name in blocks, its upper left corner at `at`, and their shadow.
constexpr float kLogoBlocksWide = 41, kLogoBlocksHigh = 5;
void drawLogo(ImDrawList& draw, ImVec2 at, float blockSize);

// A window of a menu in the middle of `center`, that takes the keys when it appears. `ImGui::End()` follows.
struct MenuWindow {
    const char* title = "";
    ImVec2 center{0, 0}, size{0, 0};  // a size of 0: as its content
    bool hasTitle = true;
};
void beginMenu(const MenuWindow& menu);

// As wide as `width`, higher than plain buttons; -1: all that is there.
bool menuButton(const char* label, float width = -1);
bool menuButton(const char* label, float width, bool isEnabled);
// One of several pages; the chosen one has the accent color.
bool tabButton(const char* label, bool isChosen, float width);
void heading(const char* text);
void dimText(std::string_view text);
void warningText(std::string_view text);
// A field for a text of up to 255 bytes; true as InputText says.
bool editText(const char* label, std::string& text, ImGuiInputTextFlags flags = 0);
// For the item before, by mouse and by keys.
void tooltipFor(std::string_view text);

}  // namespace terrane::app

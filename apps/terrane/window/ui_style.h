// The style of menus and dialogs: dark rounded panels, one accent color. Used during a frame of Dear ImGui.
#pragma once

#include <imgui.h>

#include <glm/vec2.hpp>

#include <string>
#include <string_view>

namespace terrane::app {

inline ImVec2 imVec(const glm::vec2& v) {
    return {v.x, v.y};
}

void setUiStyle(float scale);  // times the design's sizes

namespace colors {
inline const ImVec4 kAccent{0.94f, 0.71f, 0.31f, 1};
inline const ImVec4 kText{0.93f, 0.94f, 0.95f, 1};
inline const ImVec4 kDim{0.66f, 0.69f, 0.72f, 1};
inline const ImVec4 kWarning{0.98f, 0.55f, 0.42f, 1};
}  // namespace colors

// The program's name as blocks with a shadow, upper left corner at `at`.
constexpr float kLogoBlocksWide = 41, kLogoBlocksHigh = 5;
void drawLogo(ImDrawList& draw, ImVec2 at, float blockSize);

// A menu window centered at `center`; it takes the focus when it appears. Call ImGui::End() afterwards.
struct MenuWindow {
    const char* title = "";
    ImVec2 center{0, 0}, size{0, 0};  // size 0: fits the content
    bool hasTitle = true;
};
void beginMenu(const MenuWindow& menu);

// `width` wide, higher than plain buttons; -1: all available width.
bool menuButton(const char* label, float width = -1);
bool menuButton(const char* label, float width, bool isEnabled);
// A tab; the chosen one has the accent color.
bool tabButton(const char* label, bool isChosen, float width);
void heading(const char* text);
void dimText(std::string_view text);
void warningText(std::string_view text);
// A field for a text of up to 255 bytes; returns the result of InputText. `hint`: shown while it is empty.
bool editText(const char* label, std::string& text, ImGuiInputTextFlags flags = 0, const char* hint = "");
// A tooltip for the last item, by mouse and by keys.
void tooltipFor(std::string_view text);

}  // namespace terrane::app

// The widgets of Dear ImGui that the program uses. They are drawn as usual, and enter themselves into the
// WidgetRecord that ImGuiIO::UserData points to; without one this costs nothing. Tests click and read widgets
// by it. Used during a frame of Dear ImGui.
#pragma once

#include <imgui.h>

#include <string>
#include <string_view>
#include <vector>

namespace terrane::app {

struct Widget {
    std::string label;  // as passed to Dear ImGui: the shown text, then ## and more of the id
    std::string value;
    ImVec2 min, max;          // the part that reacts to clicks
    ImVec2 clipMin, clipMax;  // of its window, which may be scrolled
    bool isEnabled = true;
    bool isFocused = false;  // by keys or gamepad
};

// The widgets of one frame, in the order in which they were drawn.
class WidgetRecord {
  public:
    void clear() { widgets_.clear(); }
    void add(Widget widget) { widgets_.push_back(std::move(widget)); }
    const std::vector<Widget>& widgets() const { return widgets_; }

  private:
    std::vector<Widget> widgets_;
};

namespace ui {

// `value` tells widgets with the same label apart.
bool button(const char* label, ImVec2 size = {0, 0}, std::string_view value = {});
bool invisibleButton(const char* label, ImVec2 size, ImGuiButtonFlags flags, std::string_view value);
bool selectable(const char* label, bool isChosen, std::string_view value = {}, ImGuiSelectableFlags flags = 0,
                ImVec2 size = {0, 0});
bool checkbox(const char* label, bool* value);
bool slider(const char* label, float* value, float low, float high, const char* format,
            ImGuiSliderFlags flags = 0);
bool beginCombo(const char* label, const char* chosen);
// `hint`: shown while the field is empty.
bool textField(const char* label, const char* hint, char* text, std::size_t size,
               ImGuiInputTextFlags flags = 0, ImGuiInputTextCallback callback = nullptr);
// ImGui::Begin(); the title counts as a widget.
void beginWindow(const char* title, ImGuiWindowFlags flags);
void wrappedText(std::string_view text);
// Nothing is drawn: an area of the screen that counts as a widget.
void noteArea(const char* label, std::string_view value, ImVec2 min, ImVec2 max);

}  // namespace ui

}  // namespace terrane::app

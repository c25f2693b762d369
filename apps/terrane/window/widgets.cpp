#include "apps/terrane/window/widgets.h"

#include <fmt/format.h>
#include <imgui_internal.h>

namespace terrane::app::ui {
namespace {

WidgetRecord* record() {
    return static_cast<WidgetRecord*>(ImGui::GetIO().UserData);
}

void enter(const char* label, std::string value, ImVec2 min, ImVec2 max) {
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    const ImRect& clip = context.CurrentWindow->ClipRect;
    record()->add({.label = label,
                   .value = std::move(value),
                   .min = min,
                   .max = max,
                   .clipMin = clip.Min,
                   .clipMax = clip.Max,
                   .isEnabled = (context.CurrentItemFlags & ImGuiItemFlags_Disabled) == 0,
                   .isFocused = ImGui::IsItemFocused()});
}

// The last item.
void enterItem(const char* label, std::string_view value) {
    if (record()) enter(label, std::string(value), ImGui::GetItemRectMin(), ImGui::GetItemRectMax());
}

// The frame of a widget whose label stands to the right of it. Constructed before the widget is drawn.
struct LabeledFrame {
    const char* label;
    ImVec2 min = ImGui::GetCursorScreenPos();
    ImVec2 max = {min.x + ImGui::CalcItemWidth(), min.y + ImGui::GetFrameHeight()};

    void enterWith(std::string_view value) const {
        if (record()) enter(label, std::string(value), min, max);
    }
};

}  // namespace

bool button(const char* label, ImVec2 size, std::string_view value) {
    const bool isPressed = ImGui::Button(label, size);
    enterItem(label, value);
    return isPressed;
}

bool invisibleButton(const char* label, ImVec2 size, ImGuiButtonFlags flags, std::string_view value) {
    const bool isPressed = ImGui::InvisibleButton(label, size, flags);
    enterItem(label, value);
    return isPressed;
}

bool selectable(const char* label, bool isChosen, std::string_view value, ImGuiSelectableFlags flags,
                ImVec2 size) {
    const bool isPressed = ImGui::Selectable(label, isChosen, flags, size);
    enterItem(label, value);
    return isPressed;
}

bool checkbox(const char* label, bool* value) {
    const bool isChanged = ImGui::Checkbox(label, value);
    enterItem(label, *value ? "on" : "off");
    return isChanged;
}

bool slider(const char* label, float* value, float low, float high, const char* format,
            ImGuiSliderFlags flags) {
    const LabeledFrame frame{label};
    const bool isChanged =
        ImGui::SliderFloat(label, value, low, high, format, flags | ImGuiSliderFlags_AlwaysClamp);
    if (record()) frame.enterWith(fmt::format("{}", *value));
    return isChanged;
}

bool beginCombo(const char* label, const char* chosen) {
    const LabeledFrame frame{label};
    const bool isOpen = ImGui::BeginCombo(label, chosen);
    if (!isOpen) frame.enterWith(chosen);  // an open one is a window of its own
    return isOpen;
}

bool textField(const char* label, const char* hint, char* text, std::size_t size, ImGuiInputTextFlags flags,
               ImGuiInputTextCallback callback) {
    const LabeledFrame frame{label};
    const bool isDone = ImGui::InputTextWithHint(label, hint, text, size, flags, callback);
    frame.enterWith(text);
    return isDone;
}

void beginWindow(const char* title, ImGuiWindowFlags flags) {
    ImGui::Begin(title, nullptr, flags);
    if (!record()) return;
    const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    enter(title, "", at, {at.x + size.x, at.y + size.y});
}

void noteArea(const char* label, std::string_view value, ImVec2 min, ImVec2 max) {
    if (record()) enter(label, std::string(value), min, max);
}

void wrappedText(std::string_view text) {
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(text.data(), text.data() + text.size());
    ImGui::PopTextWrapPos();
    enterItem("", text);
}

}  // namespace terrane::app::ui

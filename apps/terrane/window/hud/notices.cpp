#include "apps/terrane/window/hud/notices.h"

#include <imgui.h>

#include <algorithm>

#include "apps/terrane/window/hud/overlay_layout.h"
#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/widgets.h"

namespace terrane::app {
namespace {

// Of the opacity: notices fade in their last second.
float shareOf(double secondsLeft) {
    return static_cast<float>(std::min(secondsLeft, 1.0));
}

// At the left edge, not as far as the crosshair.
void drawHint(OverlayLayout& layout, float share, const std::vector<std::string>& lines) {
    const float crosshair = 20 * uiScale(), most = layout.screen().width / 2 - layout.margin() - crosshair;
    float width = 0;
    for (const std::string& line : lines) width = std::max(width, ImGui::CalcTextSize(line.c_str()).x);
    width = std::min(width + 2 * ImGui::GetStyle().WindowPadding.x + 1, most);
    ImGui::SetNextWindowBgAlpha(0.55f * share);
    if (!layout.beginWindow({.id = "hint", .width = width, .flags = OverlayLayout::kBare},
                            {.top = 40 * uiScale(), .minHeight = 2 * ImGui::GetTextLineHeightWithSpacing()}))
        return;
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, share);
    for (const std::string& line : lines) ui::wrappedText(line);
    ImGui::PopStyleVar();
    ImGui::End();
}

}  // namespace

void drawNoticeMessage(OverlayLayout& layout, const Notices& notices) {
    if (notices.messageSeconds > 0) drawMessage(layout, notices.message, shareOf(notices.messageSeconds));
}

void drawNoticeKeys(OverlayLayout& layout, const Notices& notices, const KeyBindings& keys, const Texts& tr) {
    if (notices.helpSeconds > 0)
        drawKeyHelp(layout, shareOf(notices.helpSeconds), keyHelpLines(keys, tr));
    else if (notices.hintSeconds > 0)
        drawHint(layout, shareOf(notices.hintSeconds), hintLines(keys, tr));
}

}  // namespace terrane::app

#include "apps/terrane/window/hud/notices.h"

#include <imgui.h>

#include <algorithm>

#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/widgets.h"

namespace terrane::app {
namespace {

// At the upper left edge: neither on the crosshair nor under the compass.
void drawHint(const Screen& screen, float share, const std::vector<std::string>& lines) {
    const float scale = uiScale(), margin = 10 * scale, crosshair = 20 * scale;
    float width = 0;
    for (const std::string& line : lines) width = std::max(width, ImGui::CalcTextSize(line.c_str()).x);
    const float most = screen.width / 2 - margin - crosshair;
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, share);
    ImGui::SetNextWindowPos({margin, 40 * scale});
    ImGui::SetNextWindowSize({std::min(width + 2 * ImGui::GetStyle().WindowPadding.x + 1, most), 0});
    ImGui::SetNextWindowBgAlpha(0.55f);
    ui::beginWindow("first hint", ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                                      ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav);
    for (const std::string& line : lines) ui::wrappedText(line);
    ImGui::End();
    ImGui::PopStyleVar();
}

}  // namespace

void drawNotices(const Screen& screen, const Notices& notices, const KeyBindings& keys, const Texts& tr) {
    const auto shareOf = [](double seconds) { return static_cast<float>(std::min(seconds, 1.0)); };
    const bool showsHint = notices.hintSeconds > 0 && notices.helpSeconds <= 0;
    if (showsHint) drawHint(screen, shareOf(notices.hintSeconds), hintLines(keys, tr));
    if (notices.helpSeconds > 0) drawKeyHelp(screen, shareOf(notices.helpSeconds), keyHelpLines(keys, tr));
    if (notices.messageSeconds > 0) drawMessage(screen, notices.message, shareOf(notices.messageSeconds));
}

}  // namespace terrane::app

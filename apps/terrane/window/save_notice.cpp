#include "apps/terrane/window/save_notice.h"

#include <imgui.h>

#include <algorithm>

#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/widgets.h"

namespace terrane::app {
namespace {

const ImVec4 kWarning{0.45f, 0.05f, 0.02f, 0.9f};

void beginNotice(const char* title, const Screen& screen, float height, ImGuiWindowFlags flags) {
    const float width = std::min(520 * uiScale(), screen.width - 20 * uiScale());
    ImGui::SetNextWindowPos({screen.width / 2, height}, ImGuiCond_Always, {0.5f, 0});
    ImGui::SetNextWindowSize({width, 0});
    ImGui::PushStyleColor(ImGuiCol_WindowBg, kWarning);
    ui::beginWindow(
        title, flags | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse);
    ImGui::PopStyleColor();
}

void drawProblem(const store::SaveStatus& status, const Texts& tr) {
    ui::wrappedText(status.problem);
    ImGui::TextWrapped(
        tr("For %.0f s. %zu chunks are waiting; the program keeps trying. Nothing is lost while it runs."),
        status.failingSeconds, status.waiting);
}

}  // namespace

void drawSaveNotice(const Screen& screen, const store::SaveStatus& status, const Texts& tr) {
    if (status.problem.empty()) return;
    beginNotice("save notice", screen, 10 * uiScale(),
                ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                    ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav);
    ImGui::TextUnformatted(tr("The world is not being saved"));
    drawProblem(status, tr);
    ImGui::End();
}

std::optional<QuitChoice> drawQuitDialog(const Screen& screen, const store::SaveStatus& status,
                                         const Texts& tr) {
    std::optional<QuitChoice> choice;
    beginNotice(tr("The world could not be saved"), screen, screen.height * 0.35f, ImGuiWindowFlags_None);
    if (status.problem.empty()) {
        ui::wrappedText(tr("Saving works again."));
    } else {
        drawProblem(status, tr);
    }
    ImGui::Spacing();
    if (ui::button(tr("Try again and quit"))) choice = QuitChoice::TryAgain;
    ImGui::SameLine();
    if (ui::button(tr("Keep playing"))) choice = QuitChoice::Stay;
    ImGui::SameLine();
    if (ui::button(tr("Quit without saving"))) choice = QuitChoice::QuitUnsaved;
    ImGui::End();
    return choice;
}

}  // namespace terrane::app

// Draws the selection tool: its panel, and the outlines of boxes.
#include <fmt/format.h>
#include <imgui.h>

#include <glm/vec3.hpp>

#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/screen_projection.h"
#include "apps/terrane/window/selection_tool.h"
#include "apps/terrane/window/widgets.h"

namespace terrane::app {
namespace {

using world::BlockBox;

struct ToolButton {
    ToolAction action;
    const char* label;
};
// In rows of two.
constexpr ToolButton kToolButtons[] = {
    {ToolAction::Fill, trLater("Fill (G)")},        {ToolAction::Replace, trLater("Replace (X)")},
    {ToolAction::Clear, trLater("Clear (Del)")},    {ToolAction::Copy, trLater("Copy (Ctrl+C)")},
    {ToolAction::Paste, trLater("Paste (Ctrl+V)")}, {ToolAction::Turn, trLater("Rotate (R)")},
    {ToolAction::Mirror, trLater("Mirror (F)")},    {ToolAction::Save, trLater("Save (Ctrl+S)")},
    {ToolAction::Open, trLater("Open (Ctrl+O)")}};

// Orange and blue, which color-blind players can distinguish.
constexpr ImU32 kSelected = IM_COL32(255, 160, 40, 255);
constexpr ImU32 kPasted = IM_COL32(90, 180, 255, 255);

void drawBox(const ScreenProjection& projection, const BlockBox& box, double grow, ImU32 color) {
    const glm::dvec3 low = glm::dvec3(box.low.x, box.low.y, box.low.z) - grow;
    const glm::dvec3 high = glm::dvec3(box.high.x + 1.0, box.high.y + 1.0, box.high.z + 1.0) + grow;
    const auto corner = [&](unsigned k) {
        return glm::dvec3((k & 1) != 0 ? high.x : low.x, (k & 2) != 0 ? high.y : low.y,
                          (k & 4) != 0 ? high.z : low.z);
    };
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    for (unsigned k = 0; k < 8; ++k)
        for (const unsigned axis : {1u, 2u, 4u}) {
            if ((k & axis) != 0) continue;
            const auto line = projection.line(corner(k), corner(k | axis));
            if (!line) continue;
            const ImVec2 from(line->first.x, line->first.y), to(line->second.x, line->second.y);
            draw.AddLine(from, to, IM_COL32(0, 0, 0, 140), 4 * uiScale());
            draw.AddLine(from, to, color, 2 * uiScale());
        }
}

std::string sizeText(const Texts& tr, glm::ivec3 size) {
    return fmt::format(fmt::runtime(tr("{} x {} x {} = {} blocks")), size.x, size.y, size.z,
                       withCommas(std::int64_t{size.x} * size.y * size.z));
}

}  // namespace

void SelectionTool::draw(const Screen& screen, const render::Camera& camera, const BuildView& view) {
    if (!isActive_) return;
    drawOutlines(screen, camera, view);
    pressed_.reset();
    drawPanel(screen, view);
    if (pressed_) act(*pressed_, view);
    if (isAnswered_) answer(view);
}

void SelectionTool::drawPanel(const Screen& screen, const BuildView& view) {
    const Texts& tr = view.tr;
    const float margin = 10 * uiScale();
    ImGui::SetNextWindowPos({screen.width - margin, margin}, ImGuiCond_Always, {1, 0});
    ImGui::SetNextWindowBgAlpha(0.6f);
    ui::beginWindow(tr("Selection (B)"), ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize |
                                             ImGuiWindowFlags_NoCollapse |
                                             ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav);
    if (const auto box = selection_.box()) {
        const world::BlockPos low = box->low, high = box->high;
        ImGui::TextUnformatted(
            sizeText(tr, {high.x - low.x + 1, high.y - low.y + 1, high.z - low.z + 1}).c_str());
    } else {
        ImGui::TextUnformatted(tr("left, right button: corners"));
    }
    ImGui::Text(tr("with: %s"), tr.block(view.session.blocks().type(view.hand)).c_str());
    if (const auto& clipboard = selection_.clipboard())
        ImGui::Text(tr("copied: %s"), sizeText(tr, clipboard->size).c_str());
    const ImVec2 size(130 * uiScale(), 0);
    int column = 0;
    for (const ToolButton& button : kToolButtons) {
        if (column++ % 2 == 1) ImGui::SameLine();
        if (ui::button(tr(button.label), size)) pressed_ = button.action;
    }
    ImGui::TextUnformatted(tr("Shift: your own position"));
    if (asks_ == Asks::Name) drawName(tr);
    if (asks_ == Asks::File) drawFiles(tr);
    ImGui::End();
}

void SelectionTool::drawName(const Texts& tr) {
    ImGui::Separator();
    ImGui::TextUnformatted(tr("Name of the file, then Enter"));
    if (takesFocus_) ImGui::SetKeyboardFocusHere();
    takesFocus_ = false;
    ImGui::SetNextItemWidth(264 * uiScale());
    ui::textField("##name", "", name_.data(), name_.size());
}

void SelectionTool::drawFiles(const Texts& tr) {
    ImGui::Separator();
    ImGui::TextUnformatted(tr("Up, Down, Enter or a click"));
    ImGui::BeginChild("files", {264 * uiScale(), 120 * uiScale()});
    for (std::size_t k = 0; k < files_.size(); ++k) {
        ImGui::PushID(static_cast<int>(k));
        if (ui::selectable(files_[k].c_str(), k == file_)) {
            file_ = k;
            isAnswered_ = true;
        }
        if (k == file_) ImGui::SetScrollHereY();
        ImGui::PopID();
    }
    ImGui::EndChild();
}

void SelectionTool::drawOutlines(const Screen& screen, const render::Camera& camera,
                                 const BuildView& view) const {
    const ScreenProjection projection({screen.width, screen.height}, camera);
    if (const auto box = selection_.box()) drawBox(projection, *box, 1 / 64.0, kSelected);
    if (!selection_.isPasting()) return;
    const auto low = selection_.pasteCorner(pointedAt(view, true));
    drawBox(projection, game::boxOf(game::PlaceStructure{selection_.clipboard(), *low}), 1 / 32.0, kPasted);
}

}  // namespace terrane::app

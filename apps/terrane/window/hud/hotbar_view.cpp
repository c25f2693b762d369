#include "apps/terrane/window/hud/hotbar_view.h"

#include <imgui.h>

#include <algorithm>
#include <string_view>
#include <utility>

#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/ui_style.h"
#include "apps/terrane/window/widgets.h"

namespace terrane::app {

namespace {

constexpr float kSlot = 38, kGap = 3, kMargin = 8;  // before scaling
constexpr double kNameSeconds = 2;

// Above the slots, if there is room. `top`: of the slots.
void drawName(OverlayLayout& layout, float top, const std::string& name, float share) {
    const ImVec2 size = ImGui::CalcTextSize(name.c_str());
    const float pad = 5 * uiScale(), height = size.y + pad;
    const auto rect = layout.place(
        "block name", {.size = {size.x + 2 * pad, height}, .alignX = 0.5f, .top = top - height - pad});
    if (!rect) return;
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const OverlayClip clip(draw, *rect);
    const auto alpha = [&](int full) { return static_cast<int>(static_cast<float>(full) * share); };
    draw.AddRectFilled(rect->min, rect->max, IM_COL32(10, 12, 16, alpha(150)), pad);
    draw.AddText({rect->min.x + pad, rect->min.y + pad / 2}, IM_COL32(255, 255, 255, alpha(255)),
                 name.c_str());
}

}  // namespace

float hotbarHeight() {
    return (kSlot + 2 * kMargin) * uiScale();
}

void drawBlockImage(ImDrawList& draw, glm::vec2 min, float side, unsigned image) {
    if (image == 0) return;
    draw.AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(image)), {min.x, min.y},
                  {min.x + side, min.y + side}, {0, 0}, {1, 1});
}

void HotbarView::draw(OverlayLayout& layout, const HotbarLook& look, double seconds) {
    if (look.name != shown_ || look.selected != selected_) nameSeconds_ = kNameSeconds;
    shown_ = look.name;
    selected_ = look.selected;
    nameSeconds_ = std::max(0.0, nameSeconds_ - seconds);
    constexpr float kSlotsWidth = game::Hotbar::kSlots * (kSlot + kGap) - kGap;
    const float scale = std::min(uiScale(), layout.widest() / kSlotsWidth);
    const float side = kSlot * scale, step = side + kGap * scale, edge = 3 * scale;
    const auto rect = layout.place(
        "hotbar", {.size = {kSlotsWidth * scale, side}, .alignX = 0.5f, .top = layout.screen().height});
    if (!rect) return;
    const float left = rect->min.x, top = rect->min.y;
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const auto corner = [&](std::size_t slot) { return ImVec2(left + step * static_cast<float>(slot), top); };
    // Grouped by texture: each change of the texture is a draw call.
    for (std::size_t slot = 0; slot < game::Hotbar::kSlots; ++slot) {
        const ImVec2 min = corner(slot), max(min.x + side, min.y + side);
        const bool isChosen = slot == look.selected;
        draw.AddRectFilled(min, max, IM_COL32(12, 14, 18, isChosen ? 170 : 120), 4 * scale);
        if (isChosen) draw.AddRect(min, max, IM_COL32(255, 255, 255, 235), 4 * scale, 0, 2 * scale);
        const char digit[] = {static_cast<char>('1' + slot), 0};
        draw.AddText({min.x + edge, min.y + edge / 2}, IM_COL32(255, 255, 255, 110), digit);
    }
    for (std::size_t slot = 0; slot < game::Hotbar::kSlots; ++slot) {
        const glm::vec2 min(corner(slot).x + edge, top + edge);
        look.drawSlot(slot, draw, min, side - 2 * edge);
    }
    if (nameSeconds_ > 0 && !look.name.empty())
        drawName(layout, top, look.name, static_cast<float>(std::min(nameSeconds_, 1.0)));
}

namespace {

constexpr float kBlockSide = 44, kSquareGap = 4;  // of a block's square, before scaling

// Groups of built-in blocks have translated names; others are shown as they are.
std::string shownGroup(const std::string& group, const Texts& tr) {
    constexpr std::pair<std::string_view, const char*> kNames[] = {
        {"ground", trLater("Ground")}, {"plants", trLater("Plants")},       {"wood", trLater("Wood")},
        {"glass", trLater("Glass")},   {"masonry", trLater("Masonry")},     {"cloth", trLater("Cloth")},
        {"light", trLater("Light")},   {"furniture", trLater("Furniture")}, {"other", trLater("Other")}};
    for (const auto& [name, shown] : kNames)
        if (group == name) return tr(shown);
    return group;
}

// Filters out digits: they assign the block under the cursor to a slot, and no name has digits.
int withoutDigits(ImGuiInputTextCallbackData* data) {
    return data->EventChar >= '0' && data->EventChar <= '9' ? 1 : 0;
}

void drawGroups(PaletteState& state, const std::vector<std::string>& groups, const Texts& tr) {
    for (std::size_t k = 0; k <= groups.size(); ++k) {
        const std::string label = k == 0 ? tr("All") : shownGroup(groups[k - 1], tr);
        const float width = ImGui::CalcTextSize(label.c_str()).x + 2 * ImGui::GetStyle().FramePadding.x;
        if (k > 0 &&
            ImGui::GetItemRectMax().x + width + ImGui::GetStyle().ItemSpacing.x <
                ImGui::GetWindowPos().x + ImGui::GetWindowWidth() - ImGui::GetStyle().WindowPadding.x)
            ImGui::SameLine();
        const bool isChosen = state.group == k;
        if (isChosen) ImGui::PushStyleColor(ImGuiCol_Button, ImGui::GetStyleColorVec4(ImGuiCol_ButtonActive));
        if (ui::button(label.c_str())) state.group = k;
        if (isChosen) ImGui::PopStyleColor();
    }
}

// Draws the blocks in rows. `number`: of the first one on the page.
std::optional<world::BlockId> drawBlocks(PaletteState& state, const std::vector<world::BlockId>& shown,
                                         const BlockFace& face, std::size_t number) {
    std::optional<world::BlockId> choice;
    const float side = kBlockSide * uiScale(), gap = kSquareGap * uiScale();
    const auto columns =
        static_cast<std::size_t>(std::max(1.0f, (ImGui::GetContentRegionAvail().x + gap) / (side + gap)));
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    for (std::size_t k = 0; k < shown.size(); ++k) {
        if (k % columns != 0) ImGui::SameLine(0, gap);
        ImGui::PushID(static_cast<int>(number + k));
        if (ui::button("##block", {side, side}, face.name(shown[k]))) choice = shown[k];
        if (ImGui::IsItemVisible()) {
            const ImVec2 min = ImGui::GetItemRectMin();
            drawBlockImage(draw, {min.x, min.y}, side, face.image(shown[k]));
        }
        if (ImGui::IsItemHovered() || ImGui::IsItemFocused()) {
            ImGui::SetTooltip("%s", face.name(shown[k]).c_str());
            state.pointedAt = shown[k];
        }
        ImGui::PopID();
    }
    return choice;
}

// All blocks, each group under its heading.
std::optional<world::BlockId> drawAllGroups(PaletteState& state, const world::BlockRegistry& blocks,
                                            const std::vector<std::string>& groups, const BlockFace& face,
                                            const Texts& tr) {
    std::optional<world::BlockId> choice;
    std::size_t number = 0;
    for (const std::string& group : groups) {
        const auto shown = game::paletteBlocks(blocks, {group, {}, face.name});
        heading(shownGroup(group, tr).c_str());
        if (const auto chosen = drawBlocks(state, shown, face, number)) choice = chosen;
        number += shown.size();
    }
    return choice;
}

}  // namespace

std::optional<world::BlockId> drawPalette(const Screen& screen, PaletteState& state,
                                          const world::BlockRegistry& blocks, const BlockFace& face,
                                          const Texts& tr) {
    const float margin = 20 * uiScale(), width = std::min(620 * uiScale(), screen.width - 2 * margin);
    const float height = std::min(440 * uiScale(), screen.height - hotbarHeight() - margin);
    ImGui::SetNextWindowPos({(screen.width - width) / 2, (screen.height - hotbarHeight() - height) / 2});
    ImGui::SetNextWindowSize({width, height});
    ui::beginWindow(tr("Blocks"),
                    ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse);
    if (ImGui::IsWindowAppearing()) ImGui::SetKeyboardFocusHere();
    ImGui::SetNextItemWidth(-1);
    const bool takesFirst = ui::textField(
        "##search", tr("search"), state.search.data(), state.search.size(),
        ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_CallbackCharFilter, withoutDigits);
    const std::vector<std::string> groups = game::paletteGroups(blocks);
    state.group = std::min(state.group, groups.size());
    drawGroups(state, groups, tr);
    const std::string group = state.group == 0 ? "" : groups[state.group - 1];
    const auto shown = game::paletteBlocks(blocks, {group, state.search.data(), face.name});
    ImGui::BeginChild("list");
    state.pointedAt = world::kAir;
    // What a search finds is in the order in which it fits; all else is in groups.
    const bool isGrouped = state.group == 0 && state.search[0] == 0;
    std::optional<world::BlockId> choice =
        isGrouped ? drawAllGroups(state, blocks, groups, face, tr) : drawBlocks(state, shown, face, 0);
    if (shown.empty()) ImGui::TextUnformatted(tr("No block has this name"));
    ImGui::EndChild();
    ImGui::End();
    if (takesFirst && !shown.empty()) choice = shown.front();
    return choice;
}

}  // namespace terrane::app

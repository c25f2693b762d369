#include "apps/terrane/window/hotbar_view.h"

#include <imgui.h>

#include <algorithm>

#include "apps/terrane/window/imgui_layer.h"

namespace terrane::app {
namespace {

constexpr float kSlot = 38, kGap = 3, kMargin = 8;  // before scaling
constexpr double kNameSeconds = 2;

void drawName(const Screen& screen, const std::string& name, float share) {
    const ImVec2 size = ImGui::CalcTextSize(name.c_str());
    const float pad = 5 * uiScale(), y = screen.height - hotbarHeight() - size.y - 2 * pad;
    const ImVec2 at((screen.width - size.x) / 2, y);
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const auto alpha = [&](int full) { return static_cast<int>(static_cast<float>(full) * share); };
    draw.AddRectFilled({at.x - pad, at.y - pad / 2}, {at.x + size.x + pad, at.y + size.y + pad / 2},
                       IM_COL32(10, 12, 16, alpha(150)), pad);
    draw.AddText(at, IM_COL32(255, 255, 255, alpha(255)), name.c_str());
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

void HotbarView::draw(const Screen& screen, const game::Hotbar& hotbar, const BlockFace& face,
                      double seconds) {
    if (hotbar.block() != shown_.block() || hotbar.chosen != shown_.chosen) nameSeconds_ = kNameSeconds;
    shown_ = hotbar;
    nameSeconds_ = std::max(0.0, nameSeconds_ - seconds);
    constexpr float kWidth = game::Hotbar::kSlots * (kSlot + kGap) - kGap;
    const float scale = std::min(uiScale(), screen.width / (kWidth + 2 * kMargin));
    const float side = kSlot * scale, step = side + kGap * scale, edge = 3 * scale;
    const float left = (screen.width - kWidth * scale) / 2, top = screen.height - side - kMargin * scale;
    ImDrawList& draw = *ImGui::GetBackgroundDrawList();
    const auto corner = [&](std::size_t slot) { return ImVec2(left + step * static_cast<float>(slot), top); };
    // Grouped by texture: each change of the texture is a draw call.
    for (std::size_t slot = 0; slot < game::Hotbar::kSlots; ++slot) {
        const ImVec2 min = corner(slot), max(min.x + side, min.y + side);
        const bool isChosen = slot == hotbar.chosen;
        draw.AddRectFilled(min, max, IM_COL32(12, 14, 18, isChosen ? 170 : 120), 4 * scale);
        if (isChosen) draw.AddRect(min, max, IM_COL32(255, 255, 255, 235), 4 * scale, 0, 2 * scale);
        const char digit[] = {static_cast<char>('1' + slot), 0};
        draw.AddText({min.x + edge, min.y + edge / 2}, IM_COL32(255, 255, 255, 110), digit);
    }
    for (std::size_t slot = 0; slot < game::Hotbar::kSlots; ++slot) {
        const glm::vec2 min(corner(slot).x + edge, top + edge);
        if (hotbar.blocks[slot] != world::kAir)
            drawBlockImage(draw, min, side - 2 * edge, face.image(hotbar.blocks[slot]));
    }
    if (nameSeconds_ > 0 && hotbar.block() != world::kAir)
        drawName(screen, face.name(hotbar.block()), static_cast<float>(std::min(nameSeconds_, 1.0)));
}

}  // namespace terrane::app

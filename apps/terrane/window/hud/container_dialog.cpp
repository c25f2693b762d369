#include "apps/terrane/window/hud/container_dialog.h"

#include <imgui.h>
#include <glm/geometric.hpp>

#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/widgets.h"
#include "terrane/game/items.h"

namespace terrane::app {

namespace {

constexpr int kColumns = 9;
constexpr float kSlotSide = 40;  // of a slot, before scaling

void drawStack(ImVec2 min, ImVec2 max, const world::ItemStack& stack, unsigned image) {
    ImDrawList& draw = *ImGui::GetWindowDrawList();
    const ImU32 ground = ImGui::IsItemHovered() ? IM_COL32(90, 100, 120, 200) : IM_COL32(50, 54, 62, 200);
    draw.AddRectFilled(min, max, ground, 3 * uiScale());
    if (stack.count == 0) return;
    const float edge = 3 * uiScale();
    if (image != 0) {
        draw.AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(image)),
                      {min.x + edge, min.y + edge}, {max.x - edge, max.y - edge}, {0, 0}, {1, 1});
    }
    const std::string count = std::to_string(stack.count);
    const ImVec2 size = ImGui::CalcTextSize(count.c_str());
    const ImVec2 at(max.x - size.x - 2 * uiScale(), max.y - size.y);
    draw.AddText({at.x + uiScale(), at.y + uiScale()}, IM_COL32(0, 0, 0, 255), count.c_str());
    draw.AddText(at, IM_COL32(255, 255, 255, 255), count.c_str());
}

}  // namespace

std::optional<game::SlotClick> drawContainer(const Screen& screen, const world::Inventory& items,
                                             const ItemLooks& looks, const Texts& tr) {
    std::optional<game::SlotClick> click;
    ImGui::SetNextWindowPos({screen.width / 2, screen.height / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ui::beginWindow(tr("Chest"), ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize |
                                     ImGuiWindowFlags_NoCollapse);
    const float side = kSlotSide * uiScale();
    for (std::size_t slot = 0; slot < items.size(); ++slot) {
        if (slot % kColumns != 0) ImGui::SameLine(0, 3 * uiScale());
        ImGui::PushID(static_cast<int>(slot));
        const world::ItemStack& stack = items[slot];
        ui::invisibleButton("slot", {side, side},
                            ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight, stack.item);
        drawStack(ImGui::GetItemRectMin(), ImGui::GetItemRectMax(), stack,
                  stack.count > 0 ? looks.image(stack.item) : 0);
        if (stack.count > 0 && ImGui::IsItemHovered())
            ImGui::SetTooltip("%s", looks.name(stack.item).c_str());
        const bool takes = ImGui::IsItemClicked(ImGuiMouseButton_Right);
        if (takes || ImGui::IsItemClicked(ImGuiMouseButton_Left))
            click = {slot, takes, ImGui::GetIO().KeyShift};
        ImGui::PopID();
    }
    ImGui::TextUnformatted(tr("left: put in   right: take out   Shift: whole stack   Esc: close"));
    ImGui::End();
    return click;
}

bool canUseContainer(const game::Session& session, world::BlockPos block, const glm::dvec3& eyes) {
    const glm::dvec3 middle(block.x + 0.5, block.y + 0.5, block.z + 0.5);
    return glm::distance(middle, eyes) <= game::kReach + 1 &&
           game::isContainer(session.world(), session.blocks(), block);
}

base::Result<void> drawOpenContainer(const Screen& screen, game::Session& session, world::BlockPos block,
                                     game::Hotbar& hotbar, const ItemLooks& looks, const Texts& tr) {
    auto items = TERRANE_TRY(game::itemsOf(session.world(), session.blocks(), block));
    const auto click = drawContainer(screen, items, looks, tr);
    world::BlockId heldBlock = hotbar.block();
    if (!click || !game::clickSlot(items, session.blocks(), *click, heldBlock)) return {};
    game::selectBlock(hotbar, heldBlock);
    game::putItems(session, game::kLocalPlayer, block, items);
    return {};
}

}  // namespace terrane::app

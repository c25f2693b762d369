#include "apps/terrane/window/hud/container_dialog.h"

#include <imgui.h>
#include <glm/geometric.hpp>

#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/widgets.h"
#include "terrane/game/items.h"
#include "terrane/world/blocks/block_behavior.h"

namespace terrane::app {

namespace {

constexpr int kColumns = 9;
constexpr float kSlotSide = 40;  // of a slot, before scaling

}  // namespace

std::optional<game::SlotClick> drawContainer(const Screen& screen, const world::Inventory& items,
                                             const world::ItemTable& table, const ItemLooks& looks,
                                             const Texts& tr) {
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
        const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
        const ImU32 ground = ImGui::IsItemHovered() ? IM_COL32(90, 100, 120, 200) : IM_COL32(50, 54, 62, 200);
        ImGui::GetWindowDrawList()->AddRectFilled(min, max, ground, 3 * uiScale());
        drawStack(*ImGui::GetWindowDrawList(), min, max, stack, looks, table);
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

namespace {

bool isInReach(world::BlockPos block, const glm::dvec3& eyes) {
    const glm::dvec3 middle(block.x + 0.5, block.y + 0.5, block.z + 0.5);
    return glm::distance(middle, eyes) <= game::kReach + 1;
}

}  // namespace

bool canUseContainer(const game::Session& session, world::BlockPos block, const glm::dvec3& eyes) {
    return isInReach(block, eyes) && game::isContainer(session.world(), session.blocks(), block);
}

bool canUseWorkbench(const game::Session& session, world::BlockPos block, const glm::dvec3& eyes) {
    return isInReach(block, eyes) &&
           world::hasBehavior(session.blocks().type(session.world().block(block)), "workbench");
}

base::Result<void> drawOpenContainer(const Screen& screen, game::Session& session, world::BlockPos block,
                                     game::Hotbar& hotbar, const ItemLooks& looks, const Texts& tr) {
    auto items = TERRANE_TRY(game::itemsOf(session.world(), session.blocks(), block));
    const auto click = drawContainer(screen, items, session.blocks().items(), looks, tr);
    world::BlockId heldBlock = hotbar.block();
    if (!click || !game::clickSlot(items, session.blocks(), *click, heldBlock)) return {};
    game::selectBlock(hotbar, heldBlock);
    game::putItems(session, game::kLocalPlayer, block, items);
    return {};
}

}  // namespace terrane::app

#include "apps/terrane/window/hud/inventory_dialog.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string>
#include <utility>

#include "apps/terrane/window/imgui_layer.h"
#include "apps/terrane/window/widgets.h"
#include "terrane/game/items.h"

namespace terrane::app {
namespace {

constexpr std::size_t kItemColumns = game::kHotbarSlots;
constexpr float kItemSide = 40, kItemGap = 3;  // before scaling

using Actions = std::vector<game::ItemAction>;

// The slots that the dialog shows, and what happens to them.
struct Slots {
    const world::Inventory& own;
    const world::Inventory& chest;
    std::optional<world::BlockPos> block;  // of the chest
    const world::ItemTable& table;
    InventoryState& state;
    const ItemLooks& looks;
    Actions actions = {};

    const world::ItemStack& at(const game::SlotPlace& place) const {
        return (place.block ? chest : own).at(place.slot);
    }
    bool has(const game::SlotPlace& place) const {
        return place.block == (place.block ? block : std::nullopt) &&
               place.slot < (place.block ? chest : own).size();
    }
};

// Moves a stack into slots with room: first onto the same item, then into empty ones.
void moveInto(Slots& slots, const game::SlotPlace& from, std::span<const game::SlotPlace> to) {
    const world::ItemStack& stack = slots.at(from);
    const int limit = slots.table.maxStackOf(stack.item);
    int left = stack.count;
    for (const bool wantsEmpty : {false, true})
        for (const game::SlotPlace& place : to) {
            const world::ItemStack& there = slots.at(place);
            const bool isSame = there.item == stack.item && there.wear == stack.wear;
            if (left == 0 || (wantsEmpty ? there.count > 0 : there.count == 0 || !isSame)) continue;
            const int moved = std::min(left, limit - there.count);
            if (moved <= 0) continue;
            slots.actions.push_back(game::MoveStack{from, place, static_cast<std::uint16_t>(moved)});
            left -= moved;
        }
}

std::vector<game::SlotPlace> placesFrom(std::size_t first, std::size_t end,
                                        std::optional<world::BlockPos> block = {}) {
    std::vector<game::SlotPlace> places;
    for (std::size_t slot = first; slot < end; ++slot)
        places.push_back({block, static_cast<std::uint16_t>(slot)});
    return places;
}

// The whole stack goes to the other side: chest and player, or hotbar and other slots.
void moveAcross(Slots& slots, const game::SlotPlace& from) {
    using game::kCarriedSlots;
    using game::kHotbarSlots;
    if (from.block) return moveInto(slots, from, placesFrom(0, kCarriedSlots));
    if (slots.block) return moveInto(slots, from, placesFrom(0, slots.chest.size(), slots.block));
    if (from.slot >= kCarriedSlots) return moveInto(slots, from, placesFrom(0, kCarriedSlots));
    const bool isInHotbar = from.slot < kHotbarSlots;
    moveInto(slots, from, isInHotbar ? placesFrom(kHotbarSlots, kCarriedSlots) : placesFrom(0, kHotbarSlots));
}

// Puts down what the mouse carries, all or one.
void putDown(Slots& slots, const game::SlotPlace& place, bool all) {
    InventoryState::Carried& carried = *slots.state.carried;
    if (carried.from != place) {
        const std::uint16_t count = all ? carried.count : std::uint16_t{1};
        slots.actions.push_back(game::MoveStack{carried.from, place, count});
        carried.count = static_cast<std::uint16_t>(carried.count - count);
        if (!all && carried.count > 0) return;
    }
    slots.state.carried.reset();
}

void onSlot(Slots& slots, const game::SlotPlace& place) {
    InventoryState& state = slots.state;
    const bool isLeft = ImGui::IsItemClicked(ImGuiMouseButton_Left);
    const bool isRight = ImGui::IsItemClicked(ImGuiMouseButton_Right);
    const world::ItemStack& stack = slots.at(place);
    if ((isLeft || isRight) && state.carried) {
        state.carried->isDragged = false;
        return putDown(slots, place, isLeft);
    }
    if (isLeft && ImGui::GetIO().KeyShift && stack.count > 0) return moveAcross(slots, place);
    if ((isLeft || isRight) && stack.count > 0) {
        const int count = isLeft ? stack.count : (stack.count + 1) / 2;
        state.carried = {place, static_cast<std::uint16_t>(count), isLeft};
        return;
    }
    // Dragged from another slot and let go here.
    const bool isOver = ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem);
    if (state.carried && state.carried->isDragged && ImGui::IsMouseReleased(ImGuiMouseButton_Left) &&
        isOver) {
        if (state.carried->from == place)
            state.carried->isDragged = false;  // a click
        else
            putDown(slots, place, true);
    }
}

void drawSlotGround(ImDrawList& draw, ImVec2 min, ImVec2 max, bool isPicked) {
    const bool isOver = ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem);
    const ImU32 ground = isOver ? IM_COL32(90, 100, 120, 200) : IM_COL32(50, 54, 62, 200);
    draw.AddRectFilled(min, max, ground, 3 * uiScale());
    if (isPicked) draw.AddRect(min, max, IM_COL32(255, 255, 255, 200), 3 * uiScale(), 0, uiScale());
}

void drawItemSlot(Slots& slots, const game::SlotPlace& place) {
    const float side = kItemSide * uiScale();
    const auto& carried = slots.state.carried;
    const bool isPicked = carried && carried->from == place;
    world::ItemStack shown = slots.at(place);
    if (isPicked) world::takeFromStack(shown, carried->count);
    ImGui::PushID(place.block ? 1000 + place.slot : place.slot);
    const char* label = place.block ? "chest" : place.slot < game::kCarriedSlots ? "own" : "grid";
    ui::invisibleButton(label, {side, side},
                        ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight,
                        fmt::format("{} {} {}", place.slot, shown.count, shown.item));
    const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    drawSlotGround(*ImGui::GetWindowDrawList(), min, max, isPicked);
    drawStack(*ImGui::GetWindowDrawList(), min, max, shown, slots.looks, slots.table);
    if (shown.count > 0 && !carried && ImGui::IsItemHovered())
        ImGui::SetTooltip("%s", slots.looks.name(shown.item).c_str());
    onSlot(slots, place);
    ImGui::PopID();
}

void drawRows(Slots& slots, std::span<const game::SlotPlace> places, std::size_t columns) {
    for (std::size_t k = 0; k < places.size(); ++k) {
        if (k % columns != 0) ImGui::SameLine(0, kItemGap * uiScale());
        drawItemSlot(slots, places[k]);
    }
}

// The grid, and what it gives: a click crafts once, with Shift as often as the grid allows.
void drawGrid(Slots& slots, const game::PlayerItems& items, const Texts& tr) {
    const int side = slots.state.workbench ? world::kMaxGridSide : game::kHandGridSide;
    std::vector<game::SlotPlace> cells;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x)
            cells.push_back(
                {{},
                 static_cast<std::uint16_t>(game::kCarriedSlots +
                                            static_cast<std::size_t>(y * world::kMaxGridSide + x))});
    ImGui::BeginGroup();
    drawRows(slots, cells, static_cast<std::size_t>(side));
    ImGui::EndGroup();
    ImGui::SameLine(0, 24 * uiScale());
    const world::Inventory grid = game::gridOf(items, side);
    const world::Recipe* recipe = world::matchingRecipe(slots.table, grid, side);
    const world::ItemStack made =
        recipe ? world::ItemStack{recipe->makes, static_cast<std::uint16_t>(recipe->count)}
               : world::ItemStack{};
    ImGui::BeginGroup();
    ImGui::TextUnformatted(tr("makes"));
    const float width = kItemSide * uiScale();
    ui::invisibleButton("made", {width, width}, ImGuiButtonFlags_MouseButtonLeft,
                        fmt::format("{} {}", made.count, made.item));
    const ImVec2 min = ImGui::GetItemRectMin(), max = ImGui::GetItemRectMax();
    drawSlotGround(*ImGui::GetWindowDrawList(), min, max, false);
    drawStack(*ImGui::GetWindowDrawList(), min, max, made, slots.looks, slots.table);
    if (recipe && ImGui::IsItemHovered()) ImGui::SetTooltip("%s", slots.looks.name(made.item).c_str());
    if (recipe && ImGui::IsItemClicked(ImGuiMouseButton_Left)) {
        int times = 1;
        if (ImGui::GetIO().KeyShift) {
            times = world::kMaxStack;
            for (const world::ItemStack& stack : grid)
                if (stack.count > 0) times = std::min<int>(times, stack.count);
        }
        for (int k = 0; k < times; ++k) slots.actions.push_back(game::CraftItems{slots.state.workbench});
    }
    ImGui::EndGroup();
}

// At the cursor, over all else.
void drawCarried(const Slots& slots) {
    const auto& carried = slots.state.carried;
    if (!carried) return;
    world::ItemStack stack = slots.at(carried->from);
    stack.count = std::min(stack.count, carried->count);
    const ImVec2 at = ImGui::GetIO().MousePos;
    const float half = kItemSide / 2 * uiScale();
    drawStack(*ImGui::GetForegroundDrawList(), {at.x - half, at.y - half}, {at.x + half, at.y + half}, stack,
              slots.looks, slots.table);
}

}  // namespace

std::vector<game::ItemAction> drawInventory(const Screen& screen, const game::Session& session,
                                            std::optional<world::BlockPos> chest, InventoryState& state,
                                            const ItemLooks& looks, const Texts& tr) {
    const game::PlayerItems& items = session.itemsOf(game::kLocalPlayer);
    const world::Inventory held =
        chest ? game::itemsOf(session.world(), session.blocks(), *chest).value_or(world::Inventory())
              : world::Inventory();
    Slots slots{items.slots, held, chest, session.blocks().items(), state, looks};
    // Another player may have taken what the mouse carries.
    if (state.carried && (!slots.has(state.carried->from) || slots.at(state.carried->from).count == 0))
        state.carried.reset();
    ImGui::SetNextWindowPos({screen.width / 2, screen.height / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ui::beginWindow(
        chest             ? tr("Chest")
        : state.workbench ? tr("Workbench")
                          : tr("Items"),
        ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoCollapse);
    if (chest)
        drawRows(slots, placesFrom(0, held.size(), chest), kItemColumns);
    else
        drawGrid(slots, items, tr);
    ImGui::Dummy({0, 6 * uiScale()});
    drawRows(slots, placesFrom(game::kHotbarSlots, game::kCarriedSlots), kItemColumns);
    ImGui::Dummy({0, 3 * uiScale()});
    drawRows(slots, placesFrom(0, game::kHotbarSlots), kItemColumns);
    ImGui::TextUnformatted(tr("left: stack   right: half, one   Shift: to the other side   Esc: close"));
    ImGui::End();
    if (state.carried && ImGui::IsMouseReleased(ImGuiMouseButton_Left)) state.carried->isDragged = false;
    drawCarried(slots);
    return std::move(slots.actions);
}

std::vector<game::ItemAction> clearGrid(const game::PlayerItems& items, const world::ItemTable& table) {
    InventoryState state;
    const ItemLooks looks;
    const world::Inventory none;
    game::PlayerItems after = items;  // as the moves change it
    Actions all;
    for (std::size_t slot = game::kCarriedSlots; slot < game::kPlayerSlots; ++slot) {
        if (after.slots[slot].count == 0) continue;
        Slots slots{after.slots, none, {}, table, state, looks};
        moveAcross(slots, {{}, static_cast<std::uint16_t>(slot)});
        for (const game::ItemAction& action : slots.actions) {
            const auto& move = std::get<game::MoveStack>(action);
            world::ItemStack& from = after.slots[move.from.slot];
            world::moveItems(from, after.slots[move.to.slot], move.count, table.maxStackOf(from.item));
            all.push_back(action);
        }
    }
    return all;
}

}  // namespace terrane::app

#include "terrane/game/player_items.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <utility>

#include "terrane/base/log.h"
#include "terrane/base/text.h"

namespace terrane::game {
namespace {

constexpr std::string_view kModeMetadata = "mode", kWorldsMode = "world";

world::Inventory carried(const PlayerItems& items) {
    return {items.slots.begin(), items.slots.begin() + kCarriedSlots};
}

// The slot of a cell of a grid.
std::size_t gridSlot(int x, int y) {
    return kCarriedSlots + static_cast<std::size_t>(y * world::kMaxGridSide + x);
}

}  // namespace

std::optional<Mode> modeNamed(std::string_view name) {
    const auto found = std::ranges::find(kModeNames, name);
    if (found == kModeNames.end()) return std::nullopt;
    return static_cast<Mode>(found - kModeNames.begin());
}

std::string textOf(const PlayerItems& items) {
    std::string text(items.mode ? kModeNames[static_cast<std::size_t>(*items.mode)] : kWorldsMode);
    for (std::size_t slot = 0; slot < items.slots.size(); ++slot) {
        const world::ItemStack& stack = items.slots[slot];
        if (stack.count > 0) text += fmt::format("\n{} {} {} {}", slot, stack.count, stack.wear, stack.item);
    }
    return text;
}

base::Result<PlayerItems> parsePlayerItems(std::string_view text) {
    PlayerItems items;
    std::istringstream lines{std::string(text)};
    std::string line;
    std::getline(lines, line);
    items.mode = modeNamed(line);
    if (!items.mode && line != kWorldsMode)
        return base::fail("not the items of a player: {:?}", base::printable(line.substr(0, 40)));
    while (std::getline(lines, line)) {
        std::istringstream words(line);
        std::size_t slot = 0;
        world::ItemStack stack;
        words >> slot >> stack.count >> stack.wear >> stack.item;
        const bool isGood = !words.fail() && (words >> std::ws).eof() && slot < kPlayerSlots &&
                            items.slots[slot].count == 0 && stack.count > 0 &&
                            stack.count <= world::kMaxStack && stack.item.size() <= world::kMaxItemName;
        if (!isGood) return base::fail("not a stack of a player: {:?}", base::printable(line.substr(0, 40)));
        items.slots[slot] = std::move(stack);
    }
    return items;
}

int giveItems(PlayerItems& items, const world::ItemTable& table, const world::ItemStack& stack) {
    world::Inventory slots = carried(items);
    int left = stack.count;
    if (stack.wear > 0) {  // stacks with wear do not mix
        const auto free = std::ranges::find(slots, 0, &world::ItemStack::count);
        if (free == slots.end()) return left;
        *free = stack;
        left = 0;
    } else if (left > 0) {
        left = world::addItems(slots, stack.item, left, table.maxStackOf(stack.item));
    }
    std::ranges::move(slots, items.slots.begin());
    return left;
}

bool hasRoom(const PlayerItems& items, const world::ItemTable& table, const world::ItemStack& stack) {
    PlayerItems copy = items;
    return giveItems(copy, table, stack) == 0;
}

world::Inventory gridOf(const PlayerItems& items, int side) {
    world::Inventory grid;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) grid.push_back(items.slots[gridSlot(x, y)]);
    return grid;
}

const world::Recipe* craft(PlayerItems& items, const world::ItemTable& table, int side) {
    const world::Recipe* recipe = world::matchingRecipe(table, gridOf(items, side), side);
    if (!recipe) return nullptr;
    PlayerItems made = items;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) world::takeFromStack(made.slots[gridSlot(x, y)], 1);
    const world::ItemStack stack{recipe->makes, static_cast<std::uint16_t>(recipe->count)};
    if (giveItems(made, table, stack) > 0) return nullptr;
    items = std::move(made);
    return recipe;
}

void wearHand(PlayerItems& items, const world::ItemTable& table) {
    world::ItemStack& hand = items.slots[items.selected];
    const world::ItemType* type = hand.count > 0 ? table.find(hand.item) : nullptr;
    if (!type || type->tool.uses == 0) return;
    if (++hand.wear >= type->tool.uses) hand = {};
}

Mode loadMode(store::ReadableStore& store) {
    const auto text = store.metadata(kModeMetadata);
    if (!text) return Mode::Creative;
    const auto mode = modeNamed(*text);
    if (!mode) base::logWarning("the save's mode is neither creative nor survival: {:?}", *text);
    return mode.value_or(Mode::Creative);
}

void saveMode(store::ChunkStore& store, Mode mode) {
    store.setMetadata(kModeMetadata, std::string(kModeNames[static_cast<std::size_t>(mode)]));
}

}  // namespace terrane::game

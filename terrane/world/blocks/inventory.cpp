#include "terrane/world/blocks/inventory.h"

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

#include "terrane/base/result.h"
#include "terrane/base/text.h"

namespace terrane::world {
namespace {

constexpr std::byte kVersion{1}, kVersionWithWear{2};
constexpr std::size_t kHeaderBytes = 3, kSlotBytes = 3, kWearBytes = 2;

void append16(BlockEntityData& out, std::size_t value) {
    out.push_back(static_cast<std::byte>(value & 255));
    out.push_back(static_cast<std::byte>(value >> 8));
}

std::uint16_t read16(std::span<const std::byte> bytes) {
    return static_cast<std::uint16_t>(std::to_integer<int>(bytes[0]) | std::to_integer<int>(bytes[1]) << 8);
}

}  // namespace

int addToStack(ItemStack& stack, std::string_view item, int count, int limit) {
    base::require(count >= 0, "addToStack: a negative count");
    if (stack.count > 0 && (stack.item != item || stack.wear != 0)) return count;
    const int moved = std::min(count, limit - stack.count);
    if (moved > 0) stack = {std::string(item), static_cast<std::uint16_t>(stack.count + moved)};
    return count - std::max(moved, 0);
}

int takeFromStack(ItemStack& stack, int count) {
    base::require(count >= 0, "takeFromStack: a negative count");
    const int moved = std::min<int>(count, stack.count);
    stack.count = static_cast<std::uint16_t>(stack.count - moved);
    if (stack.count == 0) stack = {};
    return moved;
}

int countItems(const Inventory& inventory, std::string_view item) {
    int count = 0;
    for (const ItemStack& stack : inventory)
        if (stack.item == item) count += stack.count;
    return count;
}

bool moveItems(ItemStack& from, ItemStack& to, int count, int limit) {
    base::require(count >= 0, "moveItems: a negative count");
    if (&from == &to || from.count == 0 || count == 0) return false;
    const bool isSame = from.item == to.item && from.wear == to.wear;
    if (to.count > 0 && !isSame) {
        if (count < from.count) return false;
        std::swap(from, to);
        return true;
    }
    const int moved = std::min({count, int{from.count}, limit - to.count});
    if (moved <= 0) return false;
    to = {from.item, static_cast<std::uint16_t>(to.count + moved), from.wear};
    takeFromStack(from, moved);
    return true;
}

int addItems(Inventory& inventory, std::string_view item, int count, int limit) {
    base::require(!item.empty() && item.size() <= kMaxItemName, "addItems: a name has 1 to 255 bytes");
    base::require(count >= 0, "addItems: a negative count");
    for (ItemStack& stack : inventory)
        if (stack.item == item) count = addToStack(stack, item, count, limit);
    for (ItemStack& stack : inventory)
        if (stack.item.empty()) count = addToStack(stack, item, count, limit);
    return count;
}

int takeItems(Inventory& inventory, std::string_view item, int count) {
    base::require(count >= 0, "takeItems: a negative count");
    int taken = 0;
    for (auto stack = inventory.rbegin(); stack != inventory.rend() && taken < count; ++stack) {
        if (stack->item == item) taken += takeFromStack(*stack, count - taken);
    }
    return taken;
}

BlockEntityData encodeInventory(const Inventory& inventory) {
    base::require(inventory.size() <= 0xFFFF, "encodeInventory: more than 65,535 slots");
    const bool hasWear =
        std::ranges::any_of(inventory, [](const ItemStack& stack) { return stack.wear > 0; });
    BlockEntityData out{hasWear ? kVersionWithWear : kVersion};
    append16(out, inventory.size());
    for (const ItemStack& stack : inventory) {
        base::require(stack.item.size() <= kMaxItemName, "encodeInventory: a name of more than 255 bytes");
        append16(out, stack.count);
        if (hasWear) append16(out, stack.wear);
        out.push_back(static_cast<std::byte>(stack.item.size()));
        const auto name = std::as_bytes(std::span(stack.item));
        out.insert(out.end(), name.begin(), name.end());
    }
    return out;
}

base::Result<Inventory> decodeSlots(const BlockEntityData& data) {
    if (data.size() < kHeaderBytes || (data[0] != kVersion && data[0] != kVersionWithWear))
        return base::fail("not an inventory of version 1 or 2");
    const std::size_t wearBytes = data[0] == kVersionWithWear ? kWearBytes : 0;
    const std::size_t slotBytes = kSlotBytes + wearBytes;
    std::span<const std::byte> rest(data);
    const std::size_t slotCount = read16(rest.subspan(1));
    rest = rest.subspan(kHeaderBytes);
    // Checked before memory is allocated: a slot has at least three bytes.
    if (slotCount * slotBytes > rest.size()) return base::fail("an inventory that is cut off");
    Inventory inventory(slotCount);
    for (ItemStack& stack : inventory) {
        if (rest.size() < slotBytes) return base::fail("an inventory that is cut off");
        const auto length = std::to_integer<std::size_t>(rest[slotBytes - 1]);
        if (rest.size() < slotBytes + length) return base::fail("an inventory that is cut off");
        stack.count = read16(rest);
        if (wearBytes > 0) stack.wear = read16(rest.subspan(2));
        stack.item.assign(reinterpret_cast<const char*>(rest.data()) + slotBytes, length);
        if (stack.item.empty() != (stack.count == 0) || (stack.item.empty() && stack.wear > 0))
            return base::fail("an inventory with a stack of nothing");
        rest = rest.subspan(slotBytes + length);
    }
    if (!rest.empty()) return base::fail("an inventory with {} bytes too many", rest.size());
    return inventory;
}

namespace {

Inventory withSlots(Inventory inventory, std::size_t slots) {
    if (inventory.size() <= slots) {
        inventory.resize(slots);
        return inventory;
    }
    Inventory beyond(std::make_move_iterator(inventory.begin() + static_cast<std::ptrdiff_t>(slots)),
                     std::make_move_iterator(inventory.end()));
    inventory.resize(slots);
    std::erase_if(beyond, [](const ItemStack& stack) { return stack.count == 0; });
    auto next = beyond.begin();
    for (ItemStack& stack : inventory)
        if (stack.count == 0 && next != beyond.end()) stack = std::move(*next++);
    inventory.insert(inventory.end(), std::make_move_iterator(next), std::make_move_iterator(beyond.end()));
    return inventory;
}

}  // namespace

base::Result<Inventory> decodeInventory(const BlockEntityData& data, int slots) {
    auto inventory = TERRANE_TRY(decodeSlots(data));
    return withSlots(std::move(inventory), static_cast<std::size_t>(slots));
}

namespace {

bool isUsual(const ItemStack& stack) {
    return stack.count <= kMaxStack && base::printable(stack.item) == stack.item;
}

}  // namespace

bool mayReplace(const Inventory& former, const Inventory& next, int slots) {
    const auto wanted = static_cast<std::size_t>(slots);
    if (next.size() != wanted && (next.size() < wanted || next.size() > former.size())) return false;
    return std::ranges::all_of(next, [&](const ItemStack& stack) {
        return isUsual(stack) || std::ranges::any_of(former, [&](const ItemStack& before) {
                   return before.item == stack.item && before.count >= stack.count;
               });
    });
}

base::Result<BlockEntityData> fittedInventory(const BlockEntityData& data, int slots) {
    auto inventory = TERRANE_TRY(decodeInventory(data, slots));
    inventory.resize(static_cast<std::size_t>(slots));
    for (ItemStack& stack : inventory) {
        if (base::printable(stack.item) != stack.item) stack = {};
        stack.count = std::min(stack.count, kMaxStack);
    }
    return encodeInventory(inventory);
}

}  // namespace terrane::world

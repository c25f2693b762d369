// The items of a session's players: what survival asks for, and actions with items.
#include <algorithm>
#include <utility>

#include "terrane/base/match.h"
#include "terrane/game/items.h"
#include "terrane/game/session.h"
#include "terrane/world/blocks/block_behavior.h"

namespace terrane::game {
namespace {

// Commands of a client come unevenly: breaking may end so much earlier, though not on average.
constexpr double kBreakSlack = 0.4;

}  // namespace

Mode Session::modeOf(PlayerId player) const {
    return itemsOf(player).mode.value_or(mode);
}

const PlayerItems& Session::itemsOf(PlayerId player) const {
    static const PlayerItems kNone;
    const auto found = items_.find(player);
    return found == items_.end() ? kNone : found->second;
}

void Session::setItems(PlayerId player, PlayerItems items) {
    items_.insert_or_assign(player, std::move(items));
}

void Session::setMode(PlayerId player, std::optional<Mode> own) {
    items_[player].mode = own;
    notifyItems(player);
}

world::Tool Session::toolOf(PlayerId player) const {
    const world::ItemStack& hand = itemsOf(player).hand();
    const world::ItemType* type = hand.count > 0 ? blocks_->items().find(hand.item) : nullptr;
    return type ? type->tool : world::Tool{};
}

int Session::give(PlayerId player, const world::ItemStack& stack) {
    const int left = giveItems(items_[player], blocks_->items(), stack);
    if (left < stack.count) notifyItems(player);
    return left;
}

int Session::take(PlayerId player, std::string_view item, int count) {
    const int taken = world::takeItems(items_[player].slots, item, count);
    if (taken > 0) notifyItems(player);
    return taken;
}

bool Session::isSurvival(const EditCommand& command) const {
    return command.player != kNoPlayer && command.pack == kNoPack && modeOf(command.player) == Mode::Survival;
}

// The upper half of a door gives the door.
world::ItemStack Session::dropOf(PlayerId player, world::BlockId block) const {
    const world::BlockType& type = blocks_->type(block);
    const world::BlockId whole = world::isUpperHalf(type) ? world::otherHalf(*blocks_, block) : block;
    const world::ItemStack drop = world::dropOf(blocks_->type(whole), toolOf(player));
    return blocks_->items().find(drop.item) ? drop : world::ItemStack{};
}

std::optional<EditResult> Session::refusalOfSurvival(const EditCommand& command) const {
    if (!isSurvival(command)) return std::nullopt;
    if (std::holds_alternative<world::SetState>(command.change)) return EditResult::Creative;
    const auto* set = std::get_if<world::SetBlock>(&command.change);
    if (!set) return std::nullopt;
    const PlayerItems& items = itemsOf(command.player);
    const world::ItemTable& table = blocks_->items();
    const world::BlockType& there = blocks_->type(world_.block(command.pos));
    if (set->id != world::kAir) {
        const world::ItemType* held = items.hand().count > 0 ? table.find(items.hand().item) : nullptr;
        if (!held || held->block != set->id) return EditResult::NoItem;
        const bool isFree =
            there.id == world::kAir || there.shape == world::Shape::Liquid || there.replaceable;
        return isFree ? std::nullopt : std::optional(EditResult::Conflict);
    }
    if (there.id == world::kAir) return std::nullopt;
    if (!hasRoom(items, table, dropOf(command.player, there.id))) return EditResult::NoRoom;
    const auto player = players_.find(command.player);
    const double end = player->second.breaksSince + world::secondsToBreak(there, toolOf(command.player));
    // Who predicts has no clock of the server's.
    return authority_.edited || end <= seconds_ + kBreakSlack ? std::nullopt
                                                              : std::optional(EditResult::TooSoon);
}

// Changes a player's items with the block that a command has changed: moved stacks, and what it costs and
// gives in survival.
void Session::settle(const EditCommand& command, world::BlockId there) {
    const auto* set = std::get_if<world::SetBlock>(&command.change);
    const bool pays = set && isSurvival(command) && !authority_.edited;
    if (!pays && !moved_) return;
    if (std::ranges::count(paid_, command.player) == 0) paid_.push_back(command.player);
    PlayerItems& items = items_[command.player];
    if (moved_) {
        items = *std::exchange(moved_, std::nullopt);
        return;
    }
    const world::ItemTable& table = blocks_->items();
    if (set->id != world::kAir) {
        world::takeFromStack(items.slots[items.selected], 1);
    } else if (there != world::kAir) {
        const double needed = world::secondsToBreak(blocks_->type(there), toolOf(command.player));
        double& since = players_[command.player].breaksSince;
        since = std::max(since + needed, seconds_ - kBreakSlack);
        giveItems(items, table, dropOf(command.player, there));
        if (blocks_->type(there).hardness > 0) wearHand(items, table);
    }
}

EditResult Session::act(PlayerId player, const ItemAction& action) {
    if (authority_.act) {
        if (const auto* slot = std::get_if<SelectSlot>(&action)) (void)select(player, *slot);
        authority_.act(action);
        return EditResult::Sent;
    }
    return std::visit(base::Match{
                          [&](const MoveStack& one) { return move(player, one); },
                          [&](const CraftItems& one) { return craft(player, one); },
                          [&](const UseItem&) { return useItem(player); },
                          [&](const SelectSlot& one) { return select(player, one); },
                      },
                      action);
}

EditResult Session::select(PlayerId player, const SelectSlot& select) {
    if (select.slot >= kHotbarSlots) return EditResult::BadData;
    items_[player].selected = select.slot;
    return EditResult::Applied;
}

EditResult Session::move(PlayerId player, const MoveStack& wanted) {
    PlayerItems items = itemsOf(player);
    const auto block = wanted.from.block ? wanted.from.block : wanted.to.block;
    if (wanted.from.block && wanted.to.block && wanted.from.block != wanted.to.block)
        return EditResult::BadData;
    world::Inventory held;
    if (block) {
        if (!world_.isMade(*block)) return EditResult::NotLoaded;
        if (!isContainer(world_, *blocks_, *block)) return EditResult::Conflict;
        auto read = game::itemsOf(world_, *blocks_, *block);
        if (!read) return EditResult::BadData;
        held = std::move(*read);
    }
    world::Inventory& from = wanted.from.block ? held : items.slots;
    world::Inventory& to = wanted.to.block ? held : items.slots;
    if (wanted.from.slot >= from.size() || wanted.to.slot >= to.size()) return EditResult::BadData;
    world::ItemStack& stack = from[wanted.from.slot];
    const int limit = blocks_->items().maxStackOf(stack.item);
    if (!world::moveItems(stack, to[wanted.to.slot], wanted.count, limit)) return EditResult::Unchanged;
    if (!block) {
        items_[player] = std::move(items);
        notifyItems(player);
        return EditResult::Applied;
    }
    const EditCommand command{player, *block, world::SetEntityData{world::encodeInventory(held)},
                              world_.block(*block)};
    moved_ = std::move(items);
    const EditResult result = applyAll(std::span(&command, 1)).front();
    moved_.reset();
    return result;
}

EditResult Session::craft(PlayerId player, const CraftItems& craft) {
    if (craft.workbench) {
        if (!canReach(player, *craft.workbench)) return EditResult::OutOfReach;
        if (!world_.isMade(*craft.workbench)) return EditResult::NotLoaded;
        if (!world::hasBehavior(blocks_->type(world_.block(*craft.workbench)), "workbench"))
            return EditResult::Conflict;
    }
    const int side = craft.workbench ? world::kMaxGridSide : kHandGridSide;
    const world::Recipe* recipe = game::craft(items_[player], blocks_->items(), side);
    if (!recipe) return EditResult::Unchanged;
    notifyItems(player);
    events.crafted.notify({player, {recipe->makes, static_cast<std::uint16_t>(recipe->count)}});
    return EditResult::Applied;
}

EditResult Session::useItem(PlayerId player) {
    PlayerItems& items = items_[player];
    const world::ItemType* type = items.hand().count > 0 ? blocks_->items().find(items.hand().item) : nullptr;
    if (!type || type->block != world::kAir) return EditResult::NoItem;
    if (type->food > 0) {
        world::takeFromStack(items.slots[items.selected], 1);
        notifyItems(player);
    }
    events.itemUsed.notify({player, type->name});
    return EditResult::Applied;
}

}  // namespace terrane::game

#include "terrane/game/container.h"

#include "terrane/world/block_behavior.h"

namespace terrane::game {

bool isContainer(const world::World& world, const world::BlockRegistry& blocks, world::BlockPos pos) {
    return world::behaviorWith(blocks.type(world.block(pos)), &world::BlockBehavior::items) != nullptr;
}

base::Result<world::Inventory> itemsOf(const world::World& world, const world::BlockRegistry& blocks,
                                       world::BlockPos pos) {
    const world::BlockType& type = blocks.type(world.block(pos));
    const world::BlockBehavior* behavior = world::behaviorWith(type, &world::BlockBehavior::items);
    if (!behavior) return world::Inventory();
    auto items = behavior->items(world, blocks, pos);
    if (!items)
        return base::fail("the {} at {},{},{}: {}", type.name, pos.x, pos.y, pos.z, items.error().message);
    return items;
}

bool clickSlot(world::Inventory& items, const world::BlockRegistry& blocks, const SlotClick& click,
               world::BlockId& inHand) {
    if (click.slot >= items.size()) return false;
    const int count = click.wholeStack ? world::kMaxStack : 1;
    world::ItemStack& stack = items[click.slot];
    if (!click.takes && inHand == world::kAir) return false;
    if (!click.takes) return world::addToStack(stack, blocks.type(inHand).name, count) < count;
    const world::BlockType* kind = blocks.find(stack.item);
    if (stack.count == 0 || !kind) return false;
    inHand = kind->id;
    return world::takeFromStack(stack, count) > 0;
}

EditResult putItems(Session& session, PlayerId player, world::BlockPos pos, const world::Inventory& items) {
    return session.edit(
        {player, pos, world::SetEntityData{world::encodeInventory(items)}, session.world().block(pos)});
}

}  // namespace terrane::game

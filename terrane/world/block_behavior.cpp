#include "terrane/world/block_behavior.h"

#include <algorithm>
#include <utility>

#include "terrane/world/block_edit.h"
#include "terrane/world/liquid_flow.h"
#include "terrane/world/shape_behaviors.h"
#include "terrane/world/sign.h"

namespace terrane::world {
namespace {

BlockPos below(BlockPos pos) {
    return {pos.x, pos.y, pos.z - 1};
}

bool hasGround(const World& world, const BlockRegistry& blocks, BlockPos pos, BlockId plant) {
    const BlockId ground = world.block(below(pos));
    return ground != kAir && (blocks.type(ground).opaqueCube || ground == plant);
}

BlockBehavior plant() {
    return {.name = "plant",
            .canStand = hasGround,
            .neighborChanged = [](BlockUpdate& update, BlockPos pos, Face side) {
                const BlockId id = update.world().block(pos);
                if (side == kFaceNegZ && !hasGround(update.world(), update.blocks(), pos, id))
                    update.change(pos, SetBlock{kAir});
            }};
}

BlockBehavior crop() {
    return {.name = "crop",
            .placed =
                [](BlockUpdate& update, BlockPos pos) {
                    const std::size_t stages = update.blocks().type(update.world().block(pos)).growth.size();
                    update.change(pos, SetState{static_cast<std::uint16_t>(stages)});
                },
            .tick =
                [](BlockUpdate& update, BlockPos pos) {
                    const int stagesLeft = update.world().blockState(pos);
                    if (stagesLeft > 0)
                        update.change(pos, SetState{static_cast<std::uint16_t>(stagesLeft - 1)});
                }};
}

void fall(BlockUpdate& update, BlockPos pos) {
    BlockPos end = pos;
    while (end.z > 0) {
        const BlockId id = update.world().block(below(end));
        if (id != kAir && update.blocks().type(id).shape != Shape::Liquid) break;
        end = below(end);
    }
    if (end != pos) update.move(pos, end);
}

// Not where a block beside goes: overhangs of generated terrain stay as they are.
BlockBehavior falling() {
    return {.name = "falling",
            .placed = fall,
            .neighborChanged = [](BlockUpdate& update, BlockPos pos, Face side) {
                if (side == kFaceNegZ) fall(update, pos);
            }};
}

BlockBehavior container() {
    return {.name = "container",
            .items = [](const World& world, const BlockRegistry& blocks,
                        BlockPos pos) -> base::Result<Inventory> {
                const int slots = blocks.type(world.block(pos)).slots;
                const BlockEntityData* data = world.blockEntityData(pos);
                if (!data) return Inventory(static_cast<std::size_t>(slots));
                return decodeInventory(*data, slots);
            }};
}

}  // namespace

void BehaviorTable::add(BlockBehavior behavior) {
    auto added = std::make_shared<const BlockBehavior>(std::move(behavior));
    const auto same = std::ranges::find(behaviors_, added->name, [](const auto& b) { return b->name; });
    if (same == behaviors_.end())
        behaviors_.push_back(std::move(added));
    else
        *same = std::move(added);
}

BehaviorPtr BehaviorTable::find(std::string_view name) const {
    const auto found = std::ranges::find(behaviors_, name, [](const auto& b) { return b->name; });
    return found == behaviors_.end() ? nullptr : *found;
}

bool hasBehavior(const BlockType& type, std::string_view name) {
    return std::ranges::any_of(type.behaviors, [&](const BehaviorPtr& b) { return b->name == name; });
}

const BehaviorTable& builtInBehaviors() {
    static const BehaviorTable table = [] {
        BehaviorTable made;
        for (BlockBehavior (*make)() : {plant, crop, falling, container, flows}) made.add(make());
        for (BlockBehavior& behavior : shapeBehaviors()) made.add(std::move(behavior));
        made.add(signBehavior());
        return made;
    }();
    return table;
}

}  // namespace terrane::world

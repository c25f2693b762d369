#include "terrane/world/block_behavior.h"

#include <algorithm>
#include <utility>

#include "terrane/world/behavior_template.h"
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

// Only changes of the block below count: overhangs of generated terrain stay as they are.
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

template <class T>
std::shared_ptr<const T> findNamed(const std::vector<std::shared_ptr<const T>>& list, std::string_view name) {
    const auto found = std::ranges::find(list, name, [](const auto& entry) { return entry->name; });
    return found == list.end() ? nullptr : *found;
}

template <class T>
void addNamed(std::vector<std::shared_ptr<const T>>& list, T value) {
    auto added = std::make_shared<const T>(std::move(value));
    const auto same = std::ranges::find(list, added->name, [](const auto& entry) { return entry->name; });
    if (same == list.end())
        list.push_back(std::move(added));
    else
        *same = std::move(added);
}

}  // namespace

void BehaviorTable::add(BlockBehavior behavior) {
    addNamed(behaviors_, std::move(behavior));
}

void BehaviorTable::addTemplate(BehaviorTemplate behavior) {
    addNamed(templates_, std::move(behavior));
}

BehaviorPtr BehaviorTable::find(std::string_view name) const {
    return findNamed(behaviors_, name);
}

std::shared_ptr<const BehaviorTemplate> BehaviorTable::findTemplate(std::string_view name) const {
    return findNamed(templates_, name);
}

std::vector<std::string_view> BehaviorTable::names() const {
    std::vector<std::string_view> names;
    for (const BehaviorPtr& behavior : behaviors_) names.push_back(behavior->name);
    for (const auto& behavior : templates_) names.push_back(behavior->name);
    return names;
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
        for (BehaviorTemplate& behavior : builtInTemplates()) made.addTemplate(std::move(behavior));
        return made;
    }();
    return table;
}

}  // namespace terrane::world

#include "terrane/world/blocks/block_behavior.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "terrane/world/blocks/behavior_template.h"
#include "terrane/world/blocks/block_model.h"
#include "terrane/world/blocks/sign.h"
#include "terrane/world/changes/block_edit.h"
#include "terrane/world/changes/liquid_flow.h"

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
    while (end.z > update.world().heights().bottom) {
        const BlockId id = update.world().block(below(end));
        if (id != kAir && update.blocks().type(id).shape != Shape::Liquid) break;
        end = below(end);
    }
    const BlockId falling = update.world().block(pos);
    if (end != pos) update.move(pos, end);
    if (update.world().block(end) != falling) return;  // it cannot stand there
    const std::uint16_t before = update.world().blockState(end);
    const bool isOnUnmade = update.world().block(below(end)) == kUnmade;
    const auto state = static_cast<std::uint16_t>(isOnUnmade ? before | kUnsettled : before & ~kUnsettled);
    if (state != before) update.change(end, SetState{state});
}

// Only changes of the block below count: overhangs of generated terrain stay as they are. A block that ends
// on ground that is not made falls on when it is: flowLiquids runs its tick then.
BlockBehavior falling() {
    return {.name = "falling",
            .placed = fall,
            .neighborChanged =
                [](BlockUpdate& update, BlockPos pos, Face side) {
                    if (side == kFaceNegZ) fall(update, pos);
                },
            .tick =
                [](BlockUpdate& update, BlockPos pos) {
                    if ((update.world().blockState(pos) & kUnsettled) != 0) fall(update, pos);
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

BlockBehavior workbench() {
    return {.name = "workbench"};
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
        for (BlockBehavior (*make)() : {plant, crop, falling, container, workbench, flows}) made.add(make());
        for (BlockBehavior& behavior : shapeBehaviors()) made.add(std::move(behavior));
        made.add(signBehavior());
        for (BehaviorTemplate& behavior : builtInTemplates()) made.addTemplate(std::move(behavior));
        return made;
    }();
    return table;
}

constexpr std::string_view kUpperHalf = "_top";

bool isUpperHalf(const BlockType& type) {
    const auto isDoor = [](const BehaviorPtr& behavior) { return behavior->name == "door"; };
    return type.name.ends_with(kUpperHalf) && std::ranges::any_of(type.behaviors, isDoor);
}

BlockId otherHalf(const BlockRegistry& blocks, BlockId id) {
    std::string name = blocks.type(id).name;
    if (isUpperHalf(blocks.type(id)))
        name.resize(name.size() - kUpperHalf.size());
    else
        name += kUpperHalf;
    const BlockType* other = blocks.find(name);
    return other ? other->id : kAir;
}

namespace {

constexpr std::array<Face, 4> kSides{kFaceNegX, kFacePosX, kFaceNegY, kFacePosY};
// By facing: the direction of +y of the shape.
constexpr std::array<Face, 4> kAhead{kFacePosY, kFaceNegX, kFaceNegY, kFacePosX};

bool supports(const World& world, const BlockRegistry& blocks, BlockPos pos, Face side) {
    return !blocks.type(world.block(adjacent(pos, side))).collision.empty();
}

Face standsAt(std::uint16_t state) {
    return (state & kStateUpsideDown) != 0 ? kFacePosZ : kFaceNegZ;
}

Face leansAt(std::uint16_t state) {
    return kAhead[state & kStateFacing];
}

Face standsOrLeansAt(std::uint16_t state) {
    return (state & kStateOther) != 0 ? leansAt(state) : standsAt(state);
}

// A block that is removed with its support, the block at the side that its state names. The state is set
// before `placed` is called, which removes a block without support.
BlockBehavior supported(std::string name, Face (*sideOf)(std::uint16_t)) {
    const auto goesWithout = [sideOf](BlockUpdate& update, BlockPos pos) {
        const Face side = sideOf(update.world().blockState(pos));
        if (!supports(update.world(), update.blocks(), pos, side)) update.change(pos, SetBlock{kAir});
    };
    return {.name = std::move(name),
            .placed = goesWithout,
            .neighborChanged = [goesWithout](BlockUpdate& update, BlockPos pos, Face) {
                goesWithout(update, pos);
            }};
}

void updateArms(BlockUpdate& update, BlockPos pos) {
    const std::uint16_t before = update.world().blockState(pos);
    std::uint16_t state = before & static_cast<std::uint16_t>(~kStateArms);
    for (const Face side : kSides) {
        const BlockType& next = update.blocks().type(update.world().block(adjacent(pos, side)));
        if (next.opaqueCube || hasBehavior(next, "connects"))
            state |= static_cast<std::uint16_t>(1u << (kStateArmShift + side));
    }
    if (state != before) update.change(pos, SetState{state});
}

BlockBehavior connects() {
    return {.name = "connects",
            .placed = updateArms,
            .neighborChanged = [](BlockUpdate& update, BlockPos pos, Face) { updateArms(update, pos); }};
}

void toggle(BlockUpdate& update, BlockPos pos) {
    const auto state = static_cast<std::uint16_t>(update.world().blockState(pos) ^ kStateOther);
    update.change(pos, SetState{state});
}

BlockBehavior opens() {
    return {.name = "opens", .used = toggle};
}

BlockPos besideOfHalf(const BlockRegistry& blocks, BlockId id, BlockPos pos) {
    return adjacent(pos, isUpperHalf(blocks.type(id)) ? kFaceNegZ : kFacePosZ);
}

BlockBehavior door() {
    return {.name = "door",
            .canStand =
                [](const World& world, const BlockRegistry& blocks, BlockPos pos, BlockId id) {
                    if (isUpperHalf(blocks.type(id))) return true;
                    const BlockId above = world.block(adjacent(pos, kFacePosZ));
                    return supports(world, blocks, pos, kFaceNegZ) && pos.z + 1 < world.heights().top &&
                           (above == kAir || above == otherHalf(blocks, id));
                },
            .placed =
                [](BlockUpdate& update, BlockPos pos) {
                    const BlockId id = update.world().block(pos);
                    if (isUpperHalf(update.blocks().type(id))) return;
                    update.change(adjacent(pos, kFacePosZ),
                                  SetBlock{otherHalf(update.blocks(), id), update.world().blockState(pos)});
                },
            .removed =
                [](BlockUpdate& update, BlockPos pos, const RemovedBlock& removed) {
                    const BlockPos half = besideOfHalf(update.blocks(), removed.id, pos);
                    if (update.world().block(half) == otherHalf(update.blocks(), removed.id))
                        update.change(half, SetBlock{kAir});
                },
            .neighborChanged =
                [](BlockUpdate& update, BlockPos pos, Face side) {
                    const bool isLower = !isUpperHalf(update.blocks().type(update.world().block(pos)));
                    if (isLower && side == kFaceNegZ && !supports(update.world(), update.blocks(), pos, side))
                        update.change(pos, SetBlock{kAir});
                },
            .used =
                [](BlockUpdate& update, BlockPos pos) {
                    const BlockId id = update.world().block(pos);
                    const BlockPos half = besideOfHalf(update.blocks(), id, pos);
                    toggle(update, pos);
                    const BlockId other = otherHalf(update.blocks(), id);
                    if (other != kAir && update.world().block(half) == other) toggle(update, half);
                }};
}

// Quarter turns counterclockwise from +y; yaw 90 looks along +y.
std::uint16_t facingOf(float yaw) {
    const int quarters = static_cast<int>(std::floor((yaw - 90) / 90 + 0.5f));
    return static_cast<std::uint16_t>(((quarters % 4) + 4) % 4);
}

}  // namespace

std::vector<BlockBehavior> shapeBehaviors() {
    return {supported("stands", standsAt),
            supported("leans", leansAt),
            supported("stands_or_leans", standsOrLeansAt),
            connects(),
            opens(),
            door()};
}

std::uint16_t placedState(const BlockType& type, const Placement& placement) {
    if (!type.model) return 0;
    const std::uint16_t mask = type.model->stateMask;
    const bool isAgainstSide = placement.face < kFaceNegZ;
    const bool mayLean = hasBehavior(type, "leans") || hasBehavior(type, "stands_or_leans");
    std::uint16_t state = facingOf(placement.yaw);
    if (isAgainstSide && mayLean) {
        // The wall is at the side opposite to the face that is built on.
        const auto wall = static_cast<Face>(placement.face ^ 1);
        const auto facing = std::ranges::find(kAhead, wall) - kAhead.begin();
        state = static_cast<std::uint16_t>(facing | kStateOther);
    }
    const bool isUpperHalfOfSide = isAgainstSide && placement.heightInCell > 0.5f;
    if (placement.face == kFaceNegZ || isUpperHalfOfSide) state |= kStateUpsideDown;
    return state & mask;
}

}  // namespace terrane::world

#include "terrane/game/block_interaction.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "terrane/world/blocks/block_behavior.h"
#include "terrane/world/blocks/block_model.h"
#include "terrane/world/changes/liquid_flow.h"
#include "terrane/world/items/item_table.h"

namespace terrane::game {
namespace {

bool overlap(const world::Aabb& a, const world::Aabb& b) {
    return glm::all(glm::lessThan(a.min, b.max)) && glm::all(glm::lessThan(b.min, a.max));
}

// Whether a block of this type would overlap the body.
bool isInTheWay(const world::BlockType& type, std::uint16_t state, world::BlockPos pos,
                const std::optional<world::Aabb>& body) {
    const glm::dvec3 corner(pos.x, pos.y, pos.z);
    return body && std::ranges::any_of(world::collisionBoxes(type, state), [&](const world::Box& box) {
               return overlap({corner + glm::dvec3(box.min), corner + glm::dvec3(box.max)}, *body);
           });
}

world::Placement placementAt(const world::RayHit& target, const world::Ray& ray, float yaw) {
    const double z = ray.origin.z + ray.direction.z * target.distance;
    return {target.face, static_cast<float>(z - target.block.z), yaw};
}

bool isReplacedBy(const world::BlockType& there, world::BlockId block) {
    return there.replaceable && there.id != block;
}

bool isFree(const world::BlockType& there, world::BlockId block) {
    return there.id == world::kAir || there.shape == world::Shape::Liquid || isReplacedBy(there, block);
}

// The face to build `block` on: the one that is looked at, or the ground of a block that is to be replaced.
world::RayHit buildTarget(const Session& session, world::BlockId block, const world::RayHit& aimed) {
    if (!isReplacedBy(session.blocks().type(session.world().block(aimed.block)), block)) return aimed;
    return {world::adjacent(aimed.block, world::kFaceNegZ), world::kFacePosZ, aimed.distance};
}

}  // namespace

bool BlockInteraction::use(Session& session, PlayerId id) {
    if (!target_) return false;
    const world::BlockId there = session.world().block(target_->block);
    if (!world::behaviorWith(session.blocks().type(there), &world::BlockBehavior::used)) return false;
    session.edit({id, target_->block, world::UseBlock{}, there});
    return true;
}

bool BlockInteraction::pick(const Session& session, PlayerId id) {
    if (!target_) return false;
    const world::BlockRegistry& blocks = session.blocks();
    const world::BlockType* type = &blocks.type(session.world().block(target_->block));
    if (world::isUpperHalf(*type)) type = &blocks.type(world::otherHalf(blocks, type->id));
    if (!isBuildable(*type, blocks)) return false;
    if (session.modeOf(id) == Mode::Creative) {
        selectBlock(hotbar, type->id);
        return true;
    }
    const world::Inventory& slots = session.itemsOf(id).slots;
    const auto end = slots.begin() + kHotbarSlots;
    const auto found = std::find_if(slots.begin(), end, [&](const world::ItemStack& stack) {
        return stack.count > 0 && stack.item == type->name;
    });
    if (found == end) return false;
    hotbar.selected = static_cast<std::size_t>(found - slots.begin());
    return true;
}

// Builds into air, liquids and replaceable blocks; never a source of a liquid into another source of it.
std::optional<EditResult> BlockInteraction::build(Session& session, PlayerId id, const Player& player,
                                                  const world::Ray& ray) const {
    const world::BlockType& type = session.blocks().type(block());
    const world::RayHit target = buildTarget(session, block(), *target_);
    const world::BlockPos pos = world::adjacent(target.block, target.face);
    const world::BlockId there = session.world().block(pos);
    const bool isSource = there == block() && world::isLiquidSource(session.world().blockState(pos));
    if (block() == world::kAir || isSource || !isFree(session.blocks().type(there), block()))
        return std::nullopt;
    const std::uint16_t state =
        isFlowing(type) ? world::kUnsettled : placedState(type, placementAt(target, ray, player.pose().yaw));
    if (isInTheWay(type, state, pos, player.body())) return std::nullopt;
    return session.edit({id, pos, world::SetBlock{block(), state}, there});
}

// Whether the block that the player looks at breaks in this frame: in survival, after the button was held for
// as long as it takes.
bool BlockInteraction::breaksNow(const Session& session, PlayerId id, double seconds) {
    const bool isMining = breaking.isDown();
    const bool acts = breaking.acts(seconds);
    if (!held_) return acts;
    const world::BlockType* type =
        target_ ? &session.blocks().type(session.world().block(target_->block)) : nullptr;
    const double needed = type ? world::secondsToBreak(*type, session.toolOf(id)) : 0;
    if (needed == 0) {
        mined_.reset();
        return acts;
    }
    if (!isMining) {
        mined_.reset();
        return false;
    }
    if (!mined_ || mined_->pos != target_->block || mined_->block != type->id)
        mined_ = {target_->block, type->id, 0};
    mined_->done += seconds / needed;
    if (mined_->done < 1) return false;
    mined_.reset();
    return true;
}

std::optional<EditResult> BlockInteraction::act(Session& session, PlayerId id, const Player& player,
                                                double seconds) {
    held_.reset();
    if (session.modeOf(id) == Mode::Survival) {
        if (session.itemsOf(id).selected != hotbar.selected)
            session.act(id, SelectSlot{static_cast<std::uint8_t>(hotbar.selected)});
        const world::ItemStack& hand = session.itemsOf(id).hand();
        const world::ItemType* type = hand.count > 0 ? session.blocks().items().find(hand.item) : nullptr;
        held_ = type ? type->block : world::kAir;
    }
    const world::Pose& pose = player.pose();
    const world::Ray ray{pose.position, glm::dvec3(world::lookDirection(pose.yaw, pose.pitch))};
    const auto look = [&](world::BlockId liquid) {
        return world::castRay(session.world(), session.blocks(), ray, kReach, liquid);
    };
    target_ = look(world::kAir);
    const bool breaks = breaksNow(session, id, seconds), builds = building.acts(seconds);
    if (builds && held_ == world::kAir) return session.act(id, UseItem{});
    // If a liquid is chosen, breaking takes its sources.
    const auto aimed = breaks && isFlowing(session.blocks().type(block())) ? look(block()) : target_;
    if (!aimed || (!breaks && !builds)) return std::nullopt;
    std::optional<EditResult> result;
    if (breaks)
        result = session.edit(
            {id, aimed->block, world::SetBlock{world::kAir}, session.world().block(aimed->block)});
    else
        result = build(session, id, player, ray);
    target_ = look(world::kAir);
    return result;
}

}  // namespace terrane::game

#include "terrane/game/block_interaction.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "terrane/world/block_model.h"
#include "terrane/world/liquid_flow.h"
#include "terrane/world/shape_behaviors.h"

namespace terrane::game {
namespace {

bool overlap(const world::Aabb& a, const world::Aabb& b) {
    return glm::all(glm::lessThan(a.min, b.max)) && glm::all(glm::lessThan(b.min, a.max));
}

// Whether a block of this kind would stand in the body.
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

}  // namespace

BlockInteraction::BlockInteraction(const world::BlockRegistry& blocks) {
    for (const world::BlockType& type : blocks.types()) {
        if (type.id != world::kAir && type.id != blocks.missing()) kinds_.push_back(type.id);
    }
}

void BlockInteraction::choose(int steps) {
    const int count = static_cast<int>(kinds_.size());
    chosen_ = static_cast<std::size_t>(((static_cast<int>(chosen_) + steps) % count + count) % count);
}

void BlockInteraction::choose(world::BlockId kind) {
    const auto found = std::ranges::find(kinds_, kind);
    if (found != kinds_.end()) chosen_ = static_cast<std::size_t>(found - kinds_.begin());
}

bool BlockInteraction::use(Session& session, PlayerId id) {
    if (!target_) return false;
    const world::BlockId there = session.world().block(target_->block);
    if (!world::behaviorWith(session.blocks().type(there), &world::BlockBehavior::used)) return false;
    session.edit({id, target_->block, world::UseBlock{}, there});
    return true;
}

void BlockInteraction::act(Session& session, PlayerId id, const Player& player, double seconds) {
    const world::World& world = session.world();
    const world::BlockRegistry& blocks = session.blocks();
    const world::Pose& pose = player.pose();
    const world::Ray ray{pose.position, glm::dvec3(world::lookDirection(pose.yaw, pose.pitch))};
    target_ = world::castRay(world, blocks, ray, kReach);
    const bool breaks = breaking.acts(seconds), builds = building.acts(seconds);
    // Who has a liquid in hand takes its sources.
    const bool holdsLiquid = isFlowing(blocks.type(block()));
    const auto aimed = breaks && holdsLiquid ? world::castRay(world, blocks, ray, kReach, block()) : target_;
    if (!aimed || (!breaks && !builds)) return;
    const world::BlockPos pos = breaks ? aimed->block : world::beside(aimed->block, aimed->face);
    const world::BlockId there = world.block(pos);
    if (breaks) {
        session.edit({id, pos, world::SetBlock{world::kAir}, there});
    } else {
        // Into air and liquids, not into plants and the like; a source of a liquid not into another of it.
        const bool isSource = there == block() && world::isLiquidSource(world.blockState(pos));
        const bool isFree =
            there == world::kAir || (blocks.type(there).shape == world::Shape::Liquid && !isSource);
        const std::uint16_t state =
            holdsLiquid ? world::kLiquidUnsettled
                        : placedState(blocks.type(block()), placementAt(*aimed, ray, pose.yaw));
        if (isFree && !isInTheWay(blocks.type(block()), state, pos, player.body())) {
            session.edit({id, pos, world::SetBlock{block(), state}, there});
        }
    }
    target_ = world::castRay(world, blocks, ray, kReach);
}

}  // namespace terrane::game

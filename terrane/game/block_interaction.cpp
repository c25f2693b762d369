#include "terrane/game/block_interaction.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include "terrane/world/block_model.h"
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

bool BlockInteraction::use(Session& session, PlayerId id) {
    if (!target_) return false;
    const world::BlockId there = session.world().block(target_->block);
    if (!world::behaviorWith(session.blocks().type(there), &world::BlockBehavior::used)) return false;
    session.edit({id, target_->block, world::UseBlock{}, there});
    return true;
}

bool BlockInteraction::pick(const Session& session) {
    if (!target_) return false;
    const world::BlockRegistry& blocks = session.blocks();
    const world::BlockType* type = &blocks.type(session.world().block(target_->block));
    constexpr std::string_view kUpperHalf = "_top";  // of a door: the door is taken
    if (type->name.ends_with(kUpperHalf))
        type = blocks.find(type->name.substr(0, type->name.size() - kUpperHalf.size()));
    if (!type || !isBuilt(*type, blocks)) return false;
    takeInHand(hotbar, type->id);
    return true;
}

// Into air and liquids, not into plants and the like.
std::optional<EditResult> BlockInteraction::build(Session& session, PlayerId id, const Player& player,
                                                  const world::Ray& ray) const {
    const world::BlockType& type = session.blocks().type(block());
    const world::BlockPos pos = world::beside(target_->block, target_->face);
    const world::BlockId there = session.world().block(pos);
    const bool isFree = there == world::kAir || session.blocks().type(there).shape == world::Shape::Liquid;
    const std::uint16_t state = placedState(type, placementAt(*target_, ray, player.pose().yaw));
    if (block() == world::kAir || !isFree || isInTheWay(type, state, pos, player.body())) return std::nullopt;
    return session.edit({id, pos, world::SetBlock{block(), state}, there});
}

std::optional<EditResult> BlockInteraction::act(Session& session, PlayerId id, const Player& player,
                                                double seconds) {
    const world::Pose& pose = player.pose();
    const world::Ray ray{pose.position, glm::dvec3(world::lookDirection(pose.yaw, pose.pitch))};
    const auto look = [&] { return world::castRay(session.world(), session.blocks(), ray, kReach); };
    target_ = look();
    const bool breaks = breaking.acts(seconds), builds = building.acts(seconds);
    if (!target_ || (!breaks && !builds)) return std::nullopt;
    std::optional<EditResult> result;
    if (breaks)
        result = session.edit(
            {id, target_->block, world::SetBlock{world::kAir}, session.world().block(target_->block)});
    else
        result = build(session, id, player, ray);
    target_ = look();
    return result;
}

}  // namespace terrane::game

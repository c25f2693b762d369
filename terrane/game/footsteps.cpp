#include "terrane/game/footsteps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "terrane/world/block_model.h"
#include "terrane/world/pose.h"

namespace terrane::game {
namespace {

// Blocks. A stride grows with speed: 2.3 steps a second at a walk of 4.5 blocks a second, 2.9 at a run.
constexpr double kStride = 1.05, kStrideSeconds = 0.2, kClimbStride = 0.8, kSwimStride = 2.2;
constexpr double kSoftFall = 4;      // blocks/s; a slower landing counts as walking
constexpr double kHardFall = 22;     // full volume
constexpr double kMostInAFrame = 8;  // blocks; a longer move is a teleport

double lengthOver(const glm::dvec3& v) {
    return std::hypot(v.x, v.y);
}

float strengthOfFall(double speed) {
    return static_cast<float>(std::clamp(speed / kHardFall, 0.3, 1.0));
}

bool carries(const world::World& world, const world::BlockRegistry& blocks, world::BlockPos pos) {
    return !world::collisionBoxes(blocks.type(world.block(pos)), world.blockState(pos)).empty();
}

}  // namespace

std::optional<FootEvent> Footsteps::advance(const world::Character& now) {
    using Kind = FootEvent::Kind;
    const std::optional<world::Character> before = std::exchange(before_, now);
    const glm::dvec3 moved = before ? now.feet - before->feet : glm::dvec3(0);
    if (!before || glm::length(moved) > kMostInAFrame) {
        sinceStep_ = fallSpeed_ = 0;
        return std::nullopt;
    }
    const double fell = std::exchange(fallSpeed_, now.isOnGround ? 0 : std::max(-now.velocity.z, 0.0));
    if (now.isSwimming && !before->isSwimming && fell > kSoftFall) {
        sinceStep_ = 0;
        return FootEvent{Kind::Splash, strengthOfFall(fell)};
    }
    if (now.isOnGround && !before->isOnGround && !now.isSwimming && fell > kSoftFall) {
        sinceStep_ = 0;
        return FootEvent{Kind::Land, strengthOfFall(fell)};
    }
    const bool climbs = now.isClimbing && !now.isOnGround;
    if (!now.isSwimming && !climbs && !now.isOnGround) return std::nullopt;
    sinceStep_ += now.isSwimming ? glm::length(moved) : climbs ? std::abs(moved.z) : lengthOver(moved);
    const double stride = now.isSwimming ? kSwimStride
                          : climbs       ? kClimbStride
                                         : kStride + kStrideSeconds * lengthOver(now.velocity);
    if (sinceStep_ < stride) return std::nullopt;
    sinceStep_ = 0;
    const bool runs = lengthOver(now.velocity) > (world::kWalkSpeed + world::kRunSpeed) / 2;
    return FootEvent{now.isSwimming ? Kind::Swim : climbs ? Kind::Climb : Kind::Step, runs ? 1.0f : 0.7f};
}

world::BlockId groundUnder(const world::World& world, const world::BlockRegistry& blocks, glm::dvec3 feet) {
    constexpr double kDeep = 0.05, kSide = world::kCharacterWidth / 2;
    constexpr std::array<glm::dvec2, 5> kPlaces = {
        {{0, 0}, {-kSide, -kSide}, {kSide, -kSide}, {-kSide, kSide}, {kSide, kSide}}};
    for (const glm::dvec2& place : kPlaces) {
        const world::BlockPos pos = world::blockOf(feet + glm::dvec3(place, -kDeep));
        if (carries(world, blocks, pos)) return world.block(pos);
        // The boxes of fences are higher than their cells.
        const world::BlockPos below{pos.x, pos.y, pos.z - 1};
        if (feet.z - pos.z < 0.55 && carries(world, blocks, below)) return world.block(below);
    }
    return world::kAir;
}

}  // namespace terrane::game

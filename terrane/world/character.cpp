#include "terrane/world/character.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

#include "terrane/world/pose.h"

namespace terrane::world {
namespace {

// Rates at which velocity approaches its target, 1/s: most of it within 1/14 s on the ground, within 1/3 s in
// the air.
constexpr double kGroundGrip = 14, kAirGrip = 3, kWaterGrip = 5, kFlightGrip = 12;

double approach(double value, double target, double grip) {
    return value + (target - value) * (1 - std::exp(-grip * kStepSeconds));
}

void steer(Character& c, const CharacterInput& input, double speed, double grip) {
    c.velocity.x = approach(c.velocity.x, input.direction.x * speed, grip);
    c.velocity.y = approach(c.velocity.y, input.direction.y * speed, grip);
}

void accelerate(Character& c, const CharacterInput& input) {
    const double upward = (input.jumps ? 1 : 0) - (input.dives ? 1 : 0);
    if (!input.hasGravity) {
        steer(c, input, input.runs ? kRunSpeed : kWalkSpeed, kFlightGrip);
        c.velocity.z = approach(c.velocity.z, upward * kWalkSpeed, kFlightGrip);
    } else if (c.isSwimming) {
        steer(c, input, kSwimSpeed, kWaterGrip);
        c.velocity.z = approach(c.velocity.z, upward * kSwimSpeed - 0.6, kWaterGrip);  // sinks slowly
    } else if (c.isClimbing) {
        steer(c, input, kClimbSpeed, kGroundGrip);
        const double wanted = c.isBlocked && upward == 0 ? 1 : upward;  // walking against a ladder climbs
        c.velocity.z = approach(c.velocity.z, wanted == 0 ? -0.5 : wanted * kClimbSpeed, kGroundGrip);
    } else {
        steer(c, input, input.runs ? kRunSpeed : kWalkSpeed, c.isOnGround ? kGroundGrip : kAirGrip);
        if (c.isOnGround && input.jumps) c.velocity.z = kJumpSpeed;
        c.velocity.z = std::max(c.velocity.z - kGravity * kStepSeconds, -kFallLimit);
    }
}

// The place after a step over an obstacle no higher than `height`: up, along, down again.
glm::dvec3 steppedOver(const World& world, const BlockRegistry& blocks, glm::dvec3 feet, glm::dvec3 along,
                       double height = kStepHeight) {
    const double rise = sweep(world, blocks, characterBox(feet), {0, 0, height}).moved.z;
    glm::dvec3 at = feet + glm::dvec3(0, 0, rise);
    at += sweep(world, blocks, characterBox(at), along).moved;
    at += sweep(world, blocks, characterBox(at), {0, 0, -rise}).moved;
    return at;
}

double distanceOver(const glm::dvec3& from, const glm::dvec3& to) {
    return glm::length(glm::dvec2(to - from));
}

void move(const World& world, const BlockRegistry& blocks, Character& c) {
    const glm::dvec3 motion = c.velocity * kStepSeconds;
    const Sweep swept = sweep(world, blocks, characterBox(c.feet), motion);
    glm::dvec3 feet = c.feet + swept.moved;
    const bool lands = swept.blocked.z && motion.z < 0;
    bool blockedX = swept.blocked.x, blockedY = swept.blocked.y;
    if ((blockedX || blockedY) && (c.isOnGround || lands)) {
        const glm::dvec3 over = steppedOver(world, blocks, c.feet, {motion.x, motion.y, 0});
        if (distanceOver(c.feet, over) > distanceOver(c.feet, feet) + kSkin) {
            feet = over;
            blockedX = blockedY = false;
        }
    }
    c.feet = feet;
    c.isBlocked = blockedX || blockedY;
    if (blockedX) c.velocity.x = 0;
    if (blockedY) c.velocity.y = 0;
    if (swept.blocked.z) c.velocity.z = 0;
    c.isOnGround = lands;
}

// Whether a jump over an obstacle no higher than a block brings the character farther.
bool canJumpOver(const World& world, const BlockRegistry& blocks, const Character& c, glm::dvec2 direction) {
    constexpr double kBlock = 1.0 + kSkin, kAhead = 0.3;
    const glm::dvec3 along(direction * kAhead, 0);
    const glm::dvec3 now = c.feet + sweep(world, blocks, characterBox(c.feet), along).moved;
    const glm::dvec3 over = steppedOver(world, blocks, c.feet, along, kBlock);
    return distanceOver(c.feet, over) > distanceOver(c.feet, now) + kSkin;
}

bool isInClimbable(const World& world, const BlockRegistry& blocks, glm::dvec3 point) {
    const BlockPos at = blockOf(point);
    return isInHeight(at.z) && blocks.type(world.block(at)).climbable;
}

// Whether the chunks that the box is in are loaded.
bool isLoadedUnder(const World& world, const Aabb& box) {
    const auto cell = [](double v) {
        constexpr std::numeric_limits<std::int32_t> kRange;
        return static_cast<std::int32_t>(std::clamp<double>(std::floor(v), kRange.min(), kRange.max()));
    };
    for (const double x : {box.min.x, box.max.x})
        for (const double y : {box.min.y, box.max.y})
            if (!world.maybeChunkAt(chunkOf(BlockPos{cell(x), cell(y), 0}))) return false;
    return true;
}

}  // namespace

Aabb characterBox(glm::dvec3 feet) {
    constexpr double kHalf = kCharacterWidth / 2;
    return {feet - glm::dvec3(kHalf, kHalf, 0), feet + glm::dvec3(kHalf, kHalf, kCharacterHeight)};
}

Character stepped(const World& world, const BlockRegistry& blocks, const Character& before,
                  const CharacterInput& input) {
    Character c = before;
    if (collides(world, blocks, characterBox(c.feet))) {
        // Chunks that are not loaded count as full: the character waits for them.
        if (!isLoadedUnder(world, characterBox(c.feet))) return c;
        c.feet.z += kRunSpeed * kStepSeconds;
        c.velocity = {};
        return c;
    }
    c.isSwimming = isInLiquid(world, blocks, c.feet + glm::dvec3(0, 0, kCharacterHeight * 0.45));
    c.isClimbing = isInClimbable(world, blocks, c.feet);
    const bool meetsBlock = c.isBlocked && c.isOnGround && input.jumpsByItself && input.hasGravity;
    CharacterInput wanted = input;
    if (meetsBlock && canJumpOver(world, blocks, c, input.direction)) wanted.jumps = true;
    accelerate(c, wanted);
    move(world, blocks, c);
    return c;
}

}  // namespace terrane::world

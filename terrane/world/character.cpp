#include "terrane/world/character.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

#include "terrane/base/result.h"
#include "terrane/world/blocks/block_model.h"
#include "terrane/world/changes/liquid_flow.h"
#include "terrane/world/pose.h"

namespace terrane::world {

namespace {

constexpr Box kFullBlock;

std::int64_t cellOf(double coordinate) {
    return static_cast<std::int64_t>(std::floor(coordinate));
}

bool hasBlocks(std::int64_t x, std::int64_t y) {
    const auto fits = [](std::int64_t v) { return v == static_cast<std::int32_t>(v); };
    return fits(x) && fits(y);
}

// Calls use(Aabb) for each box that collides in the cells that `area` touches. `use` returns false to stop.
template <class Use>
void forEachCollisionBox(const World& world, const BlockRegistry& blocks, const Aabb& area, Use use) {
    const auto emit = [&](glm::dvec3 corner, const Box& box) {
        return use(Aabb{corner + glm::dvec3(box.min), corner + glm::dvec3(box.max)});
    };
    const std::int64_t minZ = std::max<std::int64_t>(cellOf(area.min.z), world.heights().bottom);
    const std::int64_t maxZ = std::min<std::int64_t>(cellOf(area.max.z), world.heights().top - 1);
    for (std::int64_t y = cellOf(area.min.y); y <= cellOf(area.max.y); ++y) {
        for (std::int64_t x = cellOf(area.min.x); x <= cellOf(area.max.x); ++x) {
            const BlockPos column{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y), 0};
            const ChunkPtr chunk = hasBlocks(x, y) ? world.maybeChunkAt(chunkOf(column)) : nullptr;
            for (std::int64_t z = minZ; z <= maxZ; ++z) {
                const glm::dvec3 corner(x, y, z);
                if (!chunk) {
                    if (!emit(corner, kFullBlock)) return;
                    continue;
                }
                const BlockIndex index = blockIndex({column.x, column.y, static_cast<std::int32_t>(z)});
                const BlockType& type = blocks.type(chunk->block(index));
                for (const Box& box : collisionBoxes(type, chunk->blockState(index))) {
                    if (!emit(corner, box)) return;
                }
            }
        }
    }
}

bool overlapsBeside(const Aabb& a, const Aabb& b, int axis) {
    for (int k = 0; k < 3; ++k) {
        if (k != axis && (a.max[k] <= b.min[k] || a.min[k] >= b.max[k])) return false;
    }
    return true;
}

// The distance that `box` moves along one axis.
double sweepAlong(const World& world, const BlockRegistry& blocks, const Aabb& box, int axis, double motion) {
    Aabb way = box;
    (motion > 0 ? way.max : way.min)[axis] += motion;
    double free = std::abs(motion);
    forEachCollisionBox(world, blocks, way, [&](const Aabb& obstacle) {
        if (!overlapsBeside(box, obstacle, axis)) return true;
        // Negative where it is beside or behind: then it does not stop the box.
        const double gap =
            motion > 0 ? obstacle.min[axis] - box.max[axis] : box.min[axis] - obstacle.max[axis];
        if (gap >= 0) free = std::min(free, std::max(gap - kSkin, 0.0));
        return true;
    });
    return std::copysign(free, motion);
}

}  // namespace

Sweep sweep(const World& world, const BlockRegistry& blocks, const Aabb& box, glm::dvec3 motion) {
    base::require(!glm::any(glm::isnan(motion)), "sweep: the motion is not a number");
    Sweep result;
    Aabb moving = box;
    for (const int axis : {2, 0, 1}) {
        const double wanted = std::clamp(motion[axis], -kMaxMotion, kMaxMotion);
        if (wanted == 0) continue;
        const double moved = sweepAlong(world, blocks, moving, axis, wanted);
        moving.min[axis] += moved;
        moving.max[axis] += moved;
        result.moved[axis] = moved;
        result.blocked[axis] = std::abs(moved) < std::abs(wanted);
    }
    return result;
}

bool collides(const World& world, const BlockRegistry& blocks, const Aabb& box) {
    bool found = false;
    forEachCollisionBox(world, blocks, box, [&](const Aabb& obstacle) {
        found =
            glm::all(glm::lessThan(box.min, obstacle.max)) && glm::all(glm::lessThan(obstacle.min, box.max));
        return !found;
    });
    return found;
}

bool isInLiquid(const World& world, const BlockRegistry& blocks, glm::dvec3 point) {
    const std::int64_t x = cellOf(point.x), y = cellOf(point.y), z = cellOf(point.z);
    if (!hasBlocks(x, y) || z < world.heights().bottom || z >= world.heights().top) return false;
    const BlockPos pos{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y),
                       static_cast<std::int32_t>(z)};
    if (blocks.type(world.block(pos)).shape != Shape::Liquid) return false;
    const bool isFull = isLiquidSource(world.blockState(pos));  // one swims up to the top of a source's cell
    return isFull || point.z - static_cast<double>(z) < liquidHeight(world, blocks, pos);
}

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
        const double speed = input.runs ? kFlyRunSpeed : kFlySpeed;
        steer(c, input, speed, kFlightGrip);
        c.velocity.z = approach(c.velocity.z, upward * speed, kFlightGrip);
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
    constexpr double kBlockAndSkin = 1.0 + kSkin, kJumpAhead = 0.3;
    const glm::dvec3 along(direction * kJumpAhead, 0);
    const glm::dvec3 now = c.feet + sweep(world, blocks, characterBox(c.feet), along).moved;
    const glm::dvec3 over = steppedOver(world, blocks, c.feet, along, kBlockAndSkin);
    return distanceOver(c.feet, over) > distanceOver(c.feet, now) + kSkin;
}

bool isInClimbable(const World& world, const BlockRegistry& blocks, glm::dvec3 point) {
    const BlockPos at = blockOf(point);
    return world.heights().contains(at.z) && blocks.type(world.block(at)).climbable;
}

// Whether the blocks that the box is in are there.
bool isMadeAround(const World& world, const Aabb& box) {
    const auto cell = [](double v) {
        constexpr std::numeric_limits<std::int32_t> kRange;
        return static_cast<std::int32_t>(std::clamp<double>(std::floor(v), kRange.min(), kRange.max()));
    };
    for (const double x : {box.min.x, box.max.x})
        for (const double y : {box.min.y, box.max.y})
            if (!world.isMade({cell(x), cell(y), world.heights().clamp(cell(box.min.z))})) return false;
    return true;
}

}  // namespace

Aabb characterBox(glm::dvec3 feet) {
    constexpr double kHalf = kCharacterWidth / 2;
    return {feet - glm::dvec3(kHalf, kHalf, 0), feet + glm::dvec3(kHalf, kHalf, kCharacterHeight)};
}

Character advanceCharacter(const World& world, const BlockRegistry& blocks, const Character& before,
                           const CharacterInput& input) {
    Character c = before;
    if (collides(world, blocks, characterBox(c.feet))) {
        // What is not there yet counts as full: the character waits for it.
        if (!isMadeAround(world, characterBox(c.feet))) return c;
        c.feet.z += kRunSpeed * kStepSeconds;
        c.velocity = {};
        return c;
    }
    c.isSwimming = isInLiquid(world, blocks, c.feet + glm::dvec3(0, 0, kCharacterHeight * 0.45));
    c.isClimbing = isInClimbable(world, blocks, c.feet);
    const bool meetsBlock = c.isBlocked && c.isOnGround && input.autoJump && input.hasGravity;
    CharacterInput wanted = input;
    if (meetsBlock && canJumpOver(world, blocks, c, input.direction)) wanted.jumps = true;
    accelerate(c, wanted);
    // It does not land on what is not there yet, and keeps its speed.
    const glm::dvec3 fall(0, 0, std::min(c.velocity.z, 0.0) * kStepSeconds);
    if (!isMadeAround(world, characterBox(c.feet + fall))) return before;
    move(world, blocks, c);
    return c;
}

}  // namespace terrane::world

#include "terrane/game/sounds.h"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "terrane/world/blocks/block_behavior.h"
#include "terrane/world/blocks/block_model.h"
#include "terrane/world/pose.h"

namespace terrane::game {

namespace {

constexpr int kSkyReach = 40;  // blocks above the ears that are searched for a roof
// Wind grows from kLeastWind at the first height over the sea to 1 at the second.
constexpr double kCalm = -10, kStormy = 120, kLeastWind = 0.15;
constexpr int kStep = 2;        // between the columns that are searched for water
constexpr int kWaterDepth = 5;  // blocks above and below the ears
// Volume for each surface found.
constexpr float kLakeWeight = 0.012f, kStreamWeight = 0.06f, kFallWeight = 0.2f;

bool isWater(const world::World& world, const world::BlockRegistry& blocks, world::BlockPos pos) {
    return blocks.type(world.block(pos)).shape == world::Shape::Liquid;
}

// Water that falls stands in blocks that are no liquid.
bool isFall(const world::World& world, const world::BlockRegistry& blocks, world::BlockPos pos) {
    const world::BlockType& type = blocks.type(world.block(pos));
    return type.sound == world::SoundMaterial::Water && type.shape != world::Shape::Liquid;
}

bool seesSky(const world::World& world, const world::BlockRegistry& blocks, world::BlockPos from) {
    for (int k = 0; k < kSkyReach; ++k)
        if (!blocks.type(world.block(world::offsetBy(from, 0, 0, k))).collision.empty()) return false;
    return true;
}

// The share of nearby columns that are open to the sky.
float openness(const world::World& world, const world::BlockRegistry& blocks, world::BlockPos ears) {
    constexpr std::array<std::array<int, 2>, 9> kColumns = {
        {{0, 0}, {4, 0}, {-4, 0}, {0, 4}, {0, -4}, {3, 3}, {3, -3}, {-3, 3}, {-3, -3}}};
    const auto open = std::ranges::count_if(kColumns, [&](const std::array<int, 2>& column) {
        return seesSky(world, blocks, world::offsetBy(ears, column[0], column[1], 0));
    });
    return static_cast<float>(open) / static_cast<float>(kColumns.size());
}

// The highest surface of water in a column near the ears, or of a waterfall, whose sides are heard.
std::optional<world::BlockPos> surfaceIn(const world::World& world, const world::BlockRegistry& blocks,
                                         world::BlockPos column) {
    bool isAir = false;
    for (int z = column.z + kWaterDepth; z >= column.z - kWaterDepth; --z) {
        const world::BlockPos pos{column.x, column.y, z};
        if ((isAir && isWater(world, blocks, pos)) || isFall(world, blocks, pos)) return pos;
        isAir = world.block(pos) == world::kAir;
    }
    return std::nullopt;
}

void addWater(Ambience& ambience, const world::World& world, const world::BlockRegistry& blocks,
              const glm::dvec3& ears) {
    const world::BlockPos cell = world::blockOf(ears);
    double nearest = kWaterReach;
    for (int y = -kWaterReach; y <= kWaterReach; y += kStep) {
        for (int x = -kWaterReach; x <= kWaterReach; x += kStep) {
            const auto found = surfaceIn(world, blocks, world::offsetBy(cell, x, y, 0));
            if (!found) continue;
            const glm::dvec3 at(found->x + 0.5, found->y + 0.5, found->z + 1);
            if (glm::distance(at, ears) > kWaterReach) continue;
            const bool flows = world.blockState(*found) != 0;
            ambience.water += isFall(world, blocks, *found) ? kFallWeight
                              : flows                       ? kStreamWeight
                                                            : kLakeWeight;
            if (glm::distance(at, ears) >= nearest) continue;
            nearest = glm::distance(at, ears);
            ambience.waterAt = at;
        }
    }
    ambience.water = std::min(ambience.water, 1.0f);
}

}  // namespace

Ambience ambienceAt(const world::World& world, const world::BlockRegistry& blocks, const glm::dvec3& ears,
                    int seaLevel) {
    Ambience ambience;
    if (isWater(world, blocks, world::blockOf(ears))) {
        ambience.water = 0.5f;  // all around
        return ambience;
    }
    const double height = std::clamp((ears.z - seaLevel - kCalm) / (kStormy - kCalm), 0.0, 1.0);
    ambience.wind = static_cast<float>(kLeastWind + (1 - kLeastWind) * height) *
                    openness(world, blocks, world::blockOf(ears));
    addWater(ambience, world, blocks, ears);
    return ambience;
}

namespace {

std::optional<BlockSound> soundOf(const world::BlockRegistry& blocks, const world::BlockEdit& edit,
                                  bool isPlayers) {
    using Kind = BlockSound::Kind;
    const world::BlockType &before = blocks.type(edit.before), &after = blocks.type(edit.after);
    const auto isFluid = [](const world::BlockType& type) {
        return type.id == world::kAir || type.shape == world::Shape::Liquid;
    };
    if (isFluid(before) && isFluid(after) && !isPlayers) return std::nullopt;
    if (edit.before == edit.after) {
        const bool isDoor = after.slots == 0 && world::behaviorWith(after, &world::BlockBehavior::used);
        return isDoor ? std::optional(BlockSound{Kind::Place, after.sound, edit.pos}) : std::nullopt;
    }
    const bool breaks = isFluid(after) && !isFluid(before);
    const bool takesLiquid = edit.after == world::kAir;
    const world::SoundMaterial material = breaks || takesLiquid ? before.sound : after.sound;
    // Water has no sound of breaking: taking a liquid sounds like placing it.
    const Kind kind = breaks && material != world::SoundMaterial::Water ? Kind::Break : Kind::Place;
    if (material == world::SoundMaterial::None) return std::nullopt;
    return BlockSound{kind, material, edit.pos};
}

}  // namespace

std::vector<BlockSound> soundsOf(const world::BlockRegistry& blocks, std::span<const world::BlockEdit> edits,
                                 bool isPlayers) {
    std::vector<BlockSound> sounds;
    for (const world::BlockEdit& edit : edits) {
        const auto sound = soundOf(blocks, edit, isPlayers);
        if (!sound) continue;
        // The two halves of a door make one sound.
        const bool isNew = std::ranges::none_of(sounds, [&](const BlockSound& other) {
            return other.kind == sound->kind && other.material == sound->material &&
                   other.pos.x == sound->pos.x && other.pos.y == sound->pos.y;
        });
        if (isNew) sounds.push_back(*sound);
        if (sounds.size() == kMaxSoundsPerChange) break;
    }
    return sounds;
}

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

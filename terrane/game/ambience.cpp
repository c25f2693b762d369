#include "terrane/game/ambience.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "terrane/world/pose.h"

namespace terrane::game {
namespace {

constexpr int kSkyReach = 40;  // blocks above the ears that are searched for a roof
// Wind grows from kLeastWind at the first height to 1 at the second; z.
constexpr double kCalm = 70, kStormy = 200, kLeastWind = 0.15;
constexpr int kStep = 2;        // between the columns that are searched for water
constexpr int kWaterDepth = 5;  // blocks above and below the ears
constexpr float kLakeWeight = 0.012f, kStreamWeight = 0.06f;  // volume for each surface found

bool isWater(const world::World& world, const world::BlockRegistry& blocks, world::BlockPos pos) {
    return blocks.type(world.block(pos)).shape == world::Shape::Liquid;
}

bool seesSky(const world::World& world, const world::BlockRegistry& blocks, world::BlockPos from) {
    for (int k = 0; k < kSkyReach; ++k)
        if (!blocks.type(world.block({from.x, from.y, from.z + k})).collision.empty()) return false;
    return true;
}

// The share of nearby columns that are open to the sky.
float openness(const world::World& world, const world::BlockRegistry& blocks, world::BlockPos ears) {
    constexpr std::array<std::array<int, 2>, 9> kColumns = {
        {{0, 0}, {4, 0}, {-4, 0}, {0, 4}, {0, -4}, {3, 3}, {3, -3}, {-3, 3}, {-3, -3}}};
    const auto open = std::ranges::count_if(kColumns, [&](const std::array<int, 2>& column) {
        return seesSky(world, blocks, {ears.x + column[0], ears.y + column[1], ears.z});
    });
    return static_cast<float>(open) / static_cast<float>(kColumns.size());
}

// The highest surface of water in a column near the ears.
std::optional<world::BlockPos> surfaceIn(const world::World& world, const world::BlockRegistry& blocks,
                                         world::BlockPos column) {
    bool isAir = false;
    for (int z = column.z + kWaterDepth; z >= column.z - kWaterDepth; --z) {
        const world::BlockPos pos{column.x, column.y, z};
        if (isAir && isWater(world, blocks, pos)) return pos;
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
            const auto found = surfaceIn(world, blocks, {cell.x + x, cell.y + y, cell.z});
            if (!found) continue;
            const glm::dvec3 at(found->x + 0.5, found->y + 0.5, found->z + 1);
            if (glm::distance(at, ears) > kWaterReach) continue;
            ambience.water += world.blockState(*found) != 0 ? kStreamWeight : kLakeWeight;
            if (glm::distance(at, ears) >= nearest) continue;
            nearest = glm::distance(at, ears);
            ambience.waterAt = at;
        }
    }
    ambience.water = std::min(ambience.water, 1.0f);
}

}  // namespace

Ambience ambienceAt(const world::World& world, const world::BlockRegistry& blocks, const glm::dvec3& ears) {
    Ambience ambience;
    if (isWater(world, blocks, world::blockOf(ears))) {
        ambience.water = 0.5f;  // all around
        return ambience;
    }
    const double height = std::clamp((ears.z - kCalm) / (kStormy - kCalm), 0.0, 1.0);
    ambience.wind = static_cast<float>(kLeastWind + (1 - kLeastWind) * height) *
                    openness(world, blocks, world::blockOf(ears));
    addWater(ambience, world, blocks, ears);
    return ambience;
}

}  // namespace terrane::game

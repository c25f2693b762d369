#include "terrane/world/collision.h"

#include "terrane/base/require.h"
#include "terrane/world/block_model.h"
#include "terrane/world/liquid_flow.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

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
    const std::int64_t minZ = std::max<std::int64_t>(cellOf(area.min.z), 0);
    const std::int64_t maxZ = std::min<std::int64_t>(cellOf(area.max.z), kChunkHeight - 1);
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
    if (!hasBlocks(x, y) || z < 0 || z >= kChunkHeight) return false;
    const BlockPos pos{static_cast<std::int32_t>(x), static_cast<std::int32_t>(y),
                       static_cast<std::int32_t>(z)};
    if (blocks.type(world.block(pos)).shape != Shape::Liquid) return false;
    const bool isFull = isLiquidSource(world.blockState(pos));  // one swims up to the top of a source's cell
    return isFull || point.z - static_cast<double>(z) < liquidHeight(world, blocks, pos);
}

}  // namespace terrane::world

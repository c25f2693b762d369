// Cells along the ray are visited in order with one addition and comparison each: J. Amanatides, A. Woo, A
// Fast Voxel Traversal Algorithm for Ray Tracing, Eurographics 1987. Distances are computed from the count of
// cell borders passed rather than summed, so that they do not drift, and relative to the origin's cell, so
// that they are as exact far from the world's origin as near it.
#include "terrane/world/ray_cast.h"

#include "terrane/world/blocks/block_model.h"
#include "terrane/world/changes/liquid_flow.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>

namespace terrane::world {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr std::int64_t kLowest = std::numeric_limits<std::int32_t>::min();
constexpr std::int64_t kHighest = std::numeric_limits<std::int32_t>::max();

using Cell = std::array<std::int64_t, 3>;

// The ray as seen from the lower corner of its first cell.
struct LocalRay {
    Cell cell;         // the first
    glm::dvec3 start;  // in that cell, 0…1
    glm::dvec3 direction;

    // Distance at which the ray is `offset` blocks from the first cell's corner along an axis that it moves
    // on.
    double distanceTo(int axis, double offset) const { return (offset - start[axis]) / direction[axis]; }
};

bool isFinite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// None if the ray is invalid, or begins so far away that cells have no 64-bit numbers.
std::optional<LocalRay> localRay(const Ray& ray) {
    const double largest =
        std::max({std::abs(ray.direction.x), std::abs(ray.direction.y), std::abs(ray.direction.z)});
    if (!isFinite(ray.origin) || !isFinite(ray.direction) || !(largest > 0)) return std::nullopt;
    LocalRay local{};
    // Scaled first: squares of very short or long directions leave the range of a double.
    local.direction = glm::normalize(ray.direction / largest);
    for (int axis = 0; axis < 3; ++axis) {
        const double floor = std::floor(ray.origin[axis]);
        if (std::abs(floor) > 0x1p52) return std::nullopt;
        local.cell[static_cast<std::size_t>(axis)] = static_cast<std::int64_t>(floor);
        local.start[axis] = ray.origin[axis] - floor;
    }
    return local;
}

struct BoxHit {
    double distance;
    Face face;
};

// Slab method: the ray is inside the box where it is inside on all three axes.
std::optional<BoxHit> enterBox(const LocalRay& ray, const Cell& cell, const Box& box) {
    double enter = -kInfinity, leave = kInfinity;
    int face = kFacePosZ;
    for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        const auto offset = static_cast<double>(cell[a] - ray.cell[a]);
        const double low = offset + box.min[axis], high = offset + box.max[axis];
        if (ray.direction[axis] == 0) {
            if (ray.start[axis] < low || ray.start[axis] > high) return std::nullopt;
            continue;
        }
        const bool forward = ray.direction[axis] > 0;
        const double in = ray.distanceTo(axis, forward ? low : high);
        if (in > enter) {
            enter = in;
            face = 2 * axis + (forward ? 0 : 1);
        }
        leave = std::min(leave, ray.distanceTo(axis, forward ? high : low));
    }
    if (enter >= leave || leave <= 0) return std::nullopt;
    return BoxHit{std::max(enter, 0.0), static_cast<Face>(face)};
}

// The walk from cell to cell.
struct Walk {
    Cell cell;
    std::array<int, 3> step{};       // -1, 0 or 1
    std::array<double, 3> next{};    // distance of the next border along each axis
    std::array<double, 3> border{};  // that border, in blocks from the first cell's corner

    explicit Walk(const LocalRay& ray) : cell(ray.cell) {
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            step[a] = (ray.direction[axis] > 0) - (ray.direction[axis] < 0);
            border[a] = step[a] > 0 ? 1 : 0;
            next[a] = step[a] == 0 ? kInfinity : ray.distanceTo(axis, border[a]);
        }
    }

    // Enters the next cell; returns the distance at which it begins.
    double advance(const LocalRay& ray) {
        std::size_t a = next[0] <= next[1] ? 0 : 1;
        if (next[2] < next[a]) a = 2;
        const double distance = next[a];
        cell[a] += step[a];
        border[a] += step[a];
        next[a] = ray.distanceTo(static_cast<int>(a), border[a]);
        return distance;
    }

    // Outside the world and moving on away from it.
    bool isGone(Heights heights) const {
        const Cell lowest{kLowest, kLowest, heights.bottom}, highest{kHighest, kHighest, heights.top - 1};
        for (std::size_t a = 0; a < 3; ++a)
            if ((cell[a] < lowest[a] && step[a] <= 0) || (cell[a] > highest[a] && step[a] >= 0)) return true;
        return false;
    }

    bool isInWorld(Heights heights) const {
        return cell[0] >= kLowest && cell[0] <= kHighest && cell[1] >= kLowest && cell[1] <= kHighest &&
               cell[2] >= heights.bottom && cell[2] < heights.top;
    }

    BlockPos pos() const {
        return {static_cast<std::int32_t>(cell[0]), static_cast<std::int32_t>(cell[1]),
                static_cast<std::int32_t>(cell[2])};
    }
};

}  // namespace

std::optional<RayHit> castRay(const World& world, const BlockRegistry& registry, const Ray& ray,
                              double maxDistance, BlockId liquid) {
    const std::optional<LocalRay> local = localRay(ray);
    if (!local || !std::isfinite(maxDistance)) return std::nullopt;

    Walk walk(*local);
    for (double distance = 0; distance <= maxDistance && !walk.isGone(world.heights());
         distance = walk.advance(*local)) {
        if (!walk.isInWorld(world.heights())) continue;
        const BlockType& type = registry.type(world.block(walk.pos()));
        const bool isSource =
            type.id == liquid && liquid != kAir && isLiquidSource(world.blockState(walk.pos()));
        if (!type.selectable && !isSource) continue;
        std::optional<BoxHit> hit;
        for (const Box& box : selectionBoxes(type, world.blockState(walk.pos()))) {
            const std::optional<BoxHit> entered = enterBox(*local, walk.cell, box);
            if (entered && (!hit || entered->distance < hit->distance)) hit = entered;
        }
        if (hit && hit->distance <= maxDistance)
            return RayHit{.block = walk.pos(), .face = hit->face, .distance = hit->distance};
    }
    return std::nullopt;
}

}  // namespace terrane::world

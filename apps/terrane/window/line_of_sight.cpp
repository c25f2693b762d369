#include "apps/terrane/window/line_of_sight.h"

#include <glm/geometric.hpp>

namespace terrane::app {
namespace {

constexpr double kBeforePoint = 1.0 / 128;  // the surface that holds the point does not hide it

bool hidesWhatIsBehind(const world::BlockRegistry& blocks, const world::RayHit& hit, world::BlockId id) {
    const world::BlockType& type = blocks.type(id);
    if (type.shape == world::Shape::Model) return true;
    if (type.shape != world::Shape::Cube) return false;
    const bool isClear = type.opacity == 0;  // such as glass with transparent panes
    return !isClear && blocks.materials()[type.material[hit.face]].alpha != world::AlphaMode::Blend;
}

}  // namespace

bool isInSight(const world::World& world, const world::BlockRegistry& blocks, const glm::dvec3& eye,
               const glm::dvec3& point, std::optional<world::BlockPos> own) {
    constexpr int kMostPassed = 24;
    constexpr double kStep = 0.25;  // blocks; a clear cell is left in several steps
    const glm::dvec3 way = point - eye, ahead = glm::normalize(way);
    double from = 0, left = glm::length(way) - kBeforePoint;
    for (int passed = 0; passed < kMostPassed && left > 0; ++passed) {
        const auto hit = world::castRay(world, blocks, {eye + ahead * from, ahead}, left);
        if (!hit || hit->block == own) return true;
        if (hidesWhatIsBehind(blocks, *hit, world.block(hit->block))) return false;
        const double step = hit->distance + kStep;
        from += step;
        left -= step;
    }
    return left <= 0;
}

}  // namespace terrane::app

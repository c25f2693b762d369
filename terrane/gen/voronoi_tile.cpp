#include "terrane/gen/voronoi_tile.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <limits>

#include "terrane/gen/program.h"
#include "terrane/shared/hash.h"

namespace terrane::gen {
namespace {

using shared::uint;

std::int64_t floorDivide(std::int64_t a, std::int64_t b) {
    return a / b - (a % b < 0 ? 1 : 0);
}

// Points of a cell relative to (x0, y0). Cell coordinates wrap at 32 bits like everything hashed.
void addCell(std::vector<VoronoiPoint>& points, const NoiseCall& call, std::uint32_t seed,
             std::array<std::int64_t, 4> cellAndOrigin) {
    const auto [cellX, cellY, x0, y0] = cellAndOrigin;
    const uint h = shared::hash2(static_cast<uint>(cellX), static_cast<uint>(cellY), seed);
    const int count = 1 + static_cast<int>(((h >> 16) * static_cast<uint>(call.maxPoints)) >> 16);
    const auto size = static_cast<uint>(call.size);
    for (int k = 0; k < count; ++k) {
        const uint hx = shared::mixBits(h + static_cast<uint>(2 * k + 1) * shared::kHashX);
        const uint hy = shared::mixBits(h + static_cast<uint>(2 * k + 2) * shared::kHashY);
        const std::int64_t x = cellX * call.size + ((hx >> 16) * size >> 16);
        const std::int64_t y = cellY * call.size + ((hy >> 16) * size >> 16);
        points.push_back({static_cast<std::int32_t>(x - x0), static_cast<std::int32_t>(y - y0)});
    }
}

// Squared distance from a point to the nearest and to the farthest column of the tile.
struct DistanceRange {
    std::int64_t nearest, farthest;
};

DistanceRange tileDistance(VoronoiPoint p) {
    constexpr std::int64_t kLast = kTileSize - 1;
    const std::int64_t x = p.x, y = p.y;
    const std::int64_t outsideX = std::max({-x, x - kLast, std::int64_t{0}});
    const std::int64_t outsideY = std::max({-y, y - kLast, std::int64_t{0}});
    const std::int64_t farX = std::max(x < 0 ? -x : x, x < kLast ? kLast - x : x - kLast);
    const std::int64_t farY = std::max(y < 0 ? -y : y, y < kLast ? kLast - y : y - kLast);
    return {outsideX * outsideX + outsideY * outsideY, farX * farX + farY * farY};
}

}  // namespace

void prepare(std::vector<VoronoiPoint>& points, const NoiseCall& call, std::uint32_t seed, std::int32_t x0,
             std::int32_t y0) {
    assert(call.size <= kMaxVoronoiSize && "squared distances fit 31 bits");
    points.clear();
    const std::int64_t firstX = floorDivide(x0, call.size) - 2, firstY = floorDivide(y0, call.size) - 2;
    const std::int64_t lastX = floorDivide(std::int64_t{x0} + kTileSize - 1, call.size) + 2;
    const std::int64_t lastY = floorDivide(std::int64_t{y0} + kTileSize - 1, call.size) + 2;
    for (std::int64_t cellY = firstY; cellY <= lastY; ++cellY) {
        for (std::int64_t cellX = firstX; cellX <= lastX; ++cellX) {
            addCell(points, call, seed, {cellX, cellY, x0, y0});
        }
    }
    // A point farther from every column than two other points are from any column is never among the two
    // nearest.
    std::int64_t best = std::numeric_limits<std::int64_t>::max(), second = best;
    for (const VoronoiPoint p : points) {
        const std::int64_t d = tileDistance(p).farthest;
        second = std::min(second, std::max(best, d));
        best = std::min(best, d);
    }
    std::erase_if(points, [&](VoronoiPoint p) { return tileDistance(p).nearest > second; });
}

}  // namespace terrane::gen

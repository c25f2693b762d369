#include "terrane/gen/noise/voronoi_tile.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdlib>
#include <limits>

#include "terrane/gen/compile/program.h"
#include "terrane/shared/hash.h"

namespace terrane::gen {
namespace {

using shared::uint;

std::int64_t floorDivide(std::int64_t a, std::int64_t b) {
    return a / b - (a % b < 0 ? 1 : 0);
}

struct Cell2D {
    std::int64_t x, y;
};

// Cells within two of those of 16 columns, along one axis.
struct CellRange {
    std::int64_t first, last;
};

CellRange searchedCells(std::int64_t firstColumn, std::int64_t step, std::int64_t size) {
    assert(size >= step && "smaller cells have no place in a tile: Pass gives their means");
    return {floorDivide(firstColumn, size) - 2, floorDivide(firstColumn + (kTileSize - 1) * step, size) + 2};
}

// Points of a cell relative to the grid's first column. Cell coordinates wrap at 32 bits like everything
// hashed.
void addCell(std::vector<VoronoiPoint>& points, const NoiseCall& call, std::uint32_t seed, SampleGrid grid,
             Cell2D cell) {
    const auto [cellX, cellY] = cell;
    const uint h = shared::hash2(static_cast<uint>(cellX), static_cast<uint>(cellY), seed);
    const int count = 1 + static_cast<int>(((h >> 16) * static_cast<uint>(call.maxPoints)) >> 16);
    const auto size = static_cast<uint>(call.size);
    for (int k = 0; k < count; ++k) {
        const uint hx = shared::mixBits(h + static_cast<uint>(2 * k + 1) * shared::kHashX);
        const uint hy = shared::mixBits(h + static_cast<uint>(2 * k + 2) * shared::kHashY);
        const std::int64_t x = cellX * call.size + ((hx >> 16) * size >> 16);
        const std::int64_t y = cellY * call.size + ((hy >> 16) * size >> 16);
        points.push_back({static_cast<std::int32_t>(x - grid.x), static_cast<std::int32_t>(y - grid.y)});
    }
}

// Squared distance from a point to the nearest and to the farthest column of the tile.
struct DistanceRange {
    std::int64_t nearest, farthest;
};

// The same along one axis of the tile.
DistanceRange axisDistance(std::int64_t p, std::int64_t step) {
    const std::int64_t last = (kTileSize - 1) * step;
    return {std::max({-p, p - last, std::int64_t{0}}), std::max(std::abs(p), std::abs(last - p))};
}

DistanceRange tileDistance(VoronoiPoint p, std::int32_t step) {
    const DistanceRange x = axisDistance(p.x, step), y = axisDistance(p.y, step);
    return {x.nearest * x.nearest + y.nearest * y.nearest, x.farthest * x.farthest + y.farthest * y.farthest};
}

void addCell3D(Voronoi3DTile& tile, std::vector<Voronoi3DPoint>& points, std::int64_t cellX,
               std::int64_t cellY, std::int32_t cellZ) {
    const uint h = shared::hash3(static_cast<uint>(cellX), static_cast<uint>(cellY), static_cast<uint>(cellZ),
                                 tile.seed);
    const uint count = 1 + (((h >> 16) * static_cast<uint>(tile.call.maxPoints)) >> 16);
    const auto size = static_cast<uint>(tile.call.size);
    const auto inCell = [&](uint hash) { return static_cast<std::int64_t>((hash >> 16) * size >> 16); };
    for (uint k = 0; k < count; ++k) {
        const std::int64_t x =
            cellX * tile.call.size + inCell(shared::mixBits(h + (3 * k + 1) * shared::kHashX));
        const std::int64_t y =
            cellY * tile.call.size + inCell(shared::mixBits(h + (3 * k + 2) * shared::kHashY));
        const std::int64_t z = inCell(shared::mixBits(h + (3 * k + 3) * shared::kHashZ));
        points.push_back({static_cast<std::int32_t>(x - tile.grid.x),
                          static_cast<std::int32_t>(y - tile.grid.y),
                          cellZ * tile.call.size + static_cast<std::int32_t>(z)});
    }
}

void fillCells(Voronoi3DTile& tile, std::vector<Voronoi3DPoint>& points, std::int32_t cellZ) {
    points.clear();
    const std::int64_t size = tile.call.size;
    const CellRange x = searchedCells(tile.grid.x, tile.grid.step, size);
    const CellRange y = searchedCells(tile.grid.y, tile.grid.step, size);
    for (std::int64_t cellY = y.first; cellY <= y.last; ++cellY) {
        for (std::int64_t cellX = x.first; cellX <= x.last; ++cellX)
            addCell3D(tile, points, cellX, cellY, cellZ);
    }
}

// Sums of powers as noise.h defines them: no step of it gives less for a larger distance.
float powerSum(const NoiseCall& call, std::array<std::int64_t, 3> distance) {
    std::array<float, 3> powers;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const float d = static_cast<float>(distance[axis]) * (1.0f / static_cast<float>(call.size));
        powers[axis] = d;
        for (int k = 1; k < call.exponent; ++k) powers[axis] = powers[axis] * d;
    }
    return (powers[0] + powers[1]) + powers[2];
}

struct SumRange {
    float nearest, farthest;
};

SumRange layerDistance(const Voronoi3DTile& tile, Voronoi3DPoint p, std::int32_t z) {
    const DistanceRange x = axisDistance(p.x, tile.grid.step), y = axisDistance(p.y, tile.grid.step);
    const std::int64_t height = std::abs(p.z - z);
    return {powerSum(tile.call, {x.nearest, y.nearest, height}),
            powerSum(tile.call, {x.farthest, y.farthest, height})};
}

}  // namespace

void prepare(Voronoi2DTile& tile, const NoiseCall& call, std::uint32_t seed, SampleGrid grid) {
    assert(call.size <= kMaxVoronoiSize && "squared distances fit 31 bits");
    tile.size = call.size;
    tile.step = grid.step;
    std::vector<VoronoiPoint>& points = tile.points;
    points.clear();
    const CellRange x = searchedCells(grid.x, grid.step, call.size);
    const CellRange y = searchedCells(grid.y, grid.step, call.size);
    for (std::int64_t cellY = y.first; cellY <= y.last; ++cellY) {
        for (std::int64_t cellX = x.first; cellX <= x.last; ++cellX) {
            addCell(points, call, seed, grid, {cellX, cellY});
        }
    }
    // A point farther from every column than two other points are from any column is never among the two
    // nearest.
    std::int64_t best = std::numeric_limits<std::int64_t>::max(), second = best;
    for (const VoronoiPoint p : points) {
        const std::int64_t d = tileDistance(p, grid.step).farthest;
        second = std::min(second, std::max(best, d));
        best = std::min(best, d);
    }
    std::erase_if(points, [&](VoronoiPoint p) { return tileDistance(p, grid.step).nearest > second; });
}

void prepare(Voronoi3DTile& tile, const NoiseCall& call, std::uint32_t seed, SampleGrid grid) {
    tile.call = call;
    tile.seed = seed;
    tile.grid = grid;
    tile.layer = kNoLayer;
}

void moveToLayer(Voronoi3DTile& tile, std::int32_t z) {
    const std::int32_t zCell = cellOfLayer(z, tile.call.size);
    if (tile.layer == kNoLayer || zCell != tile.zCell) {
        const bool isNext = tile.layer != kNoLayer && zCell == tile.zCell + 1;
        if (isNext) std::rotate(tile.cells.begin(), tile.cells.begin() + 1, tile.cells.end());
        for (int k = isNext ? 4 : 0; k < 5; ++k) {
            fillCells(tile, tile.cells[static_cast<std::size_t>(k)], zCell - 2 + k);
        }
        tile.zCell = zCell;
    }
    tile.layer = z;
    // As in 2D: a point farther from every column than two others are from any column does not count.
    constexpr float kFar = std::numeric_limits<float>::max();
    float best = kFar, second = kFar;
    for (const auto& cell : tile.cells) {
        for (const Voronoi3DPoint p : cell) {
            const float d = layerDistance(tile, p, z).farthest;
            second = std::min(second, std::max(best, d));
            best = std::min(best, d);
        }
    }
    tile.points.clear();
    for (const auto& cell : tile.cells) {
        for (const Voronoi3DPoint p : cell) {
            if (layerDistance(tile, p, z).nearest <= second) tile.points.push_back(p);
        }
    }
}

}  // namespace terrane::gen

// A point scattered over the plane, for objects that keep a distance from each other, like trees.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "terrane/gen/language/pass.h"

namespace terrane::gen {

struct ScatterPoint {
    Bool isHere;  // whether a point lies in this column
    IVec2 at;     // its block: the position for random numbers, so that all levels agree
    Int hash;     // 0…2^24−1, by point
};

constexpr int kMaxScatterSpacing = 1024;

// Returns one point in each square of `spacing` blocks; rows of squares are shifted by chance, so that no
// columns of points show. Any two are minDistance blocks or more apart along x or along y. A point depends on
// its own square alone, so that neighbors and levels agree; of several points in a wide column the first one
// counts, which never happens where minDistance is at least the step. 1 ≤ minDistance ≤ spacing ≤ 1024.
ScatterPoint scatter(Pass& p, std::string_view name, int spacing, int minDistance);

// An erosion filter: gullies and ridges that branch downhill, found for each column by itself, without
// simulation and without neighbors. Waves of one size run across the slope, so that their valleys run down
// it; each following octave is smaller and follows the slope that the last one left. After R. S. Johansen,
// Fast and Gorgeous Erosion Filter (2026), who builds on C. John and F. Westin; the formulas here are our
// own.
struct Erosion {
    int size = 128;          // blocks: from gully to gully in the first octave
    int octaves = 5;         // each half as large
    float depth = 0.16f;     // of gullies, in sizes, on ground as steep as `fullSlope`
    float fullSlope = 0.6f;  // blocks a block, from which on gullies are whole
    float gain = 0.56f;      // depth of an octave by the one before
};

struct Eroded {
    Float height;  // blocks to add: at most 0 on ridges, less in gullies
    Float ridge;   // -1…1: in a gully … on a ridge, of the large octaves
};

// Returns the erosion of the ground. `slope` is the slope of the ground before, in blocks a block. `name`
// makes the seeds. `strength` is 0…1, by column: 0 leaves the ground as it is. Octaves too fine for the
// columns fade; their mean is still subtracted, so that far land is as high as near land.
Eroded erode(Pass& p, std::string_view name, Vec2 slope, Float strength, const Erosion& erosion);

// Means of Voronoi noise. They replace it where cells are smaller than a column (Pass::voronoi2D).
//
// Measured over 1,500,000 (2D) and 150,000 (3D) random places among random points, to within 0.001. The
// metric's exponent changes the distance alone.
struct VoronoiMean {
    float distance;  // cells, to the nearest point
    float ratio;     // nearest / second nearest
};

// Returns the means in 2D; `maxPoints` is 1…4.
constexpr VoronoiMean voronoiMean2D(int maxPoints) {
    constexpr std::array<VoronoiMean, 4> kMeans = {
        {{0.430f, 0.626f}, {0.370f, 0.647f}, {0.331f, 0.655f}, {0.304f, 0.660f}}};
    return kMeans[static_cast<std::size_t>(maxPoints - 1)];
}

// Returns the means in 3D; `exponent` is 2…8.
constexpr VoronoiMean voronoiMean3D(int maxPoints, int exponent) {
    constexpr std::array<float, 4> kRatio = {0.730f, 0.740f, 0.744f, 0.747f};
    constexpr std::array<std::array<float, 7>, 4> kDistance = {
        {{0.520f, 0.470f, 0.450f, 0.440f, 0.435f, 0.431f, 0.429f},
         {0.464f, 0.419f, 0.402f, 0.393f, 0.388f, 0.385f, 0.382f},
         {0.428f, 0.387f, 0.370f, 0.362f, 0.358f, 0.355f, 0.353f},
         {0.401f, 0.362f, 0.347f, 0.339f, 0.335f, 0.332f, 0.330f}}};
    const auto points = static_cast<std::size_t>(maxPoints - 1);
    return {kDistance[points][static_cast<std::size_t>(exponent - 2)], kRatio[points]};
}

}  // namespace terrane::gen

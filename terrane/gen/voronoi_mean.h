// Means of Voronoi noise. They replace it where cells are smaller than a column (Pass::voronoi2D).
//
// Measured over 1,500,000 (2D) and 150,000 (3D) random places among random points, to within 0.001. The
// metric's exponent changes the distance alone.
#pragma once

#include <array>
#include <cstddef>

namespace terrane::gen {

struct VoronoiMean {
    float distance;  // cells, to the nearest point
    float ratio;     // nearest / second nearest
};

// maxPoints: 1…4.
constexpr VoronoiMean voronoiMean2D(int maxPoints) {
    constexpr std::array<VoronoiMean, 4> kMeans = {
        {{0.430f, 0.626f}, {0.370f, 0.647f}, {0.331f, 0.655f}, {0.304f, 0.660f}}};
    return kMeans[static_cast<std::size_t>(maxPoints - 1)];
}

// exponent: 2…8.
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

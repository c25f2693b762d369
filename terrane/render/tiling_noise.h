// Smooth random numbers that repeat, for textures generated at the start. Pure functions, any thread.
#pragma once

#include <cmath>

#include "terrane/shared/hash.h"

namespace terrane::render {

// Value noise: random numbers on a lattice of `cells` × `cells` (a power of two) in the unit square, smoothly
// interpolated; 0…1. Repeats.
inline float valueNoise(float x, float y, int cells, std::uint32_t seed) {
    const auto at = [&](int cx, int cy) {
        const auto wrap = [&](int c) { return static_cast<std::uint32_t>(c & (cells - 1)); };
        return static_cast<float>(shared::hash2(wrap(cx), wrap(cy), seed) >> 8) / 16777216.0f;
    };
    const auto smooth = [](float t) { return t * t * (3 - 2 * t); };
    const float fx = x * static_cast<float>(cells), fy = y * static_cast<float>(cells);
    const int ix = static_cast<int>(std::floor(fx)), iy = static_cast<int>(std::floor(fy));
    const float u = smooth(fx - static_cast<float>(ix)), v = smooth(fy - static_cast<float>(iy));
    return std::lerp(std::lerp(at(ix, iy), at(ix + 1, iy), u),
                     std::lerp(at(ix, iy + 1), at(ix + 1, iy + 1), u), v);
}

// Sum of `count` octaves of value noise, each with half the weight and twice the frequency; 0…1.
inline float octaves(float x, float y, int firstCells, int count, std::uint32_t seed) {
    float sum = 0, weight = 0.5f;
    for (int k = 0; k < count; ++k, weight *= 0.5f) {
        sum += weight * valueNoise(x, y, firstCells << k, seed + static_cast<std::uint32_t>(k));
    }
    return sum / (1 - 2 * weight);  // weights from 0.5 on sum up to 1 less twice the next one
}

}  // namespace terrane::render

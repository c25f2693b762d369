// Noise as terrane/gen/noise/noise.h describes it, one sample at a time and with nothing shared between
// samples.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "terrane/gen/noise/noise.h"
#include "terrane/shared/det_math.h"
#include "terrane/shared/hash.h"

namespace terrane::gen::reference {

using shared::detDivide;
using shared::detSqrt;

constexpr std::int64_t floorDivide(std::int64_t a, std::int64_t b) {
    return (a - ((a % b) + b) % b) / b;
}

// Node and cell coordinates are hashed modulo 2^32.
constexpr std::uint32_t hashed(std::int64_t v) {
    return static_cast<std::uint32_t>(v);
}

inline std::array<float, 2> gradient2(std::int64_t x, std::int64_t y, std::uint32_t seed) {
    const double k = shared::hash2(hashed(x), hashed(y), seed) >> 28;
    const double angle = (k + 0.5) * std::numbers::pi / 8;
    return {static_cast<float>(std::numbers::sqrt2 * std::cos(angle)),
            static_cast<float>(std::numbers::sqrt2 * std::sin(angle))};
}

inline std::array<float, 3> gradient3(std::array<std::int64_t, 3> node, std::uint32_t seed) {
    const std::uint32_t h = shared::hash3(hashed(node[0]), hashed(node[1]), hashed(node[2]), seed);
    const std::uint32_t k = ((h >> 16) * 12) >> 16;
    // Four sign pairs, the first sign changing fastest, in the planes xy, xz and yz.
    const float first = k % 2 == 0 ? 1.0f : -1.0f, second = k / 2 % 2 == 0 ? 1.0f : -1.0f;
    if (k < 4) return {first, second, 0};
    if (k < 8) return {first, 0, second};
    return {0, first, second};
}

constexpr float fade(float f) {
    return ((f * f) * f) * (f * (6.0f * f - 15.0f) + 10.0f);
}

constexpr float lerp(float a, float b, float t) {
    return a + t * (b - a);
}

// Position on one axis of a lattice.
struct Axis {
    Axis(std::int64_t v, std::int64_t size)
        : node(floorDivide(v, size)),
          f(static_cast<float>(v - node * size) * (1.0f / static_cast<float>(size))),
          t(fade(f)) {}
    std::int64_t node;
    float f, t;
};

constexpr std::uint32_t octaveSeed(std::uint32_t seed, std::size_t octave) {
    return seed + 0x9E3779B9u * static_cast<std::uint32_t>(octave);
}

inline float octave2D(std::int64_t size, std::uint32_t seed, std::int64_t xBlock, std::int64_t yBlock) {
    const Axis x(xBlock, size), y(yBlock, size);
    // The value at a node row, whose y offset is f.
    const auto rowValue = [&](std::int64_t node, float f) {
        const auto left = gradient2(x.node, node, seed), right = gradient2(x.node + 1, node, seed);
        const float one = lerp(left[0] * x.f, right[0] * (x.f - 1.0f), x.t);
        return one + lerp(left[1], right[1], x.t) * f;
    };
    return lerp(rowValue(y.node, y.f), rowValue(y.node + 1, y.f - 1.0f), y.t);
}

inline float octave3D(std::int64_t size, std::uint32_t seed, std::array<std::int64_t, 3> block) {
    const Axis x(block[0], size), y(block[1], size), z(block[2], size);
    const auto rowValue = [&](std::int64_t yNode, float f) {
        struct Level {
            float one, y, z;
        };
        const auto level = [&](std::int64_t zNode) -> Level {
            const auto left = gradient3({x.node, yNode, zNode}, seed);
            const auto right = gradient3({x.node + 1, yNode, zNode}, seed);
            return {lerp(left[0] * x.f, right[0] * (x.f - 1.0f), x.t), lerp(left[1], right[1], x.t),
                    lerp(left[2], right[2], x.t)};
        };
        const Level low = level(z.node), high = level(z.node + 1);
        const float one = lerp(low.one + low.z * z.f, high.one + high.z * (z.f - 1.0f), z.t);
        return one + lerp(low.y, high.y, z.t) * f;
    };
    return lerp(rowValue(y.node, y.f), rowValue(y.node + 1, y.f - 1.0f), y.t);
}

template <class Octave>
float sumOfOctaves(const NoiseCall& call, std::uint32_t seed, Octave octave) {
    float sum = 0;
    bool isFirst = true;
    for (std::size_t o = 0; o < call.weights.size(); ++o) {
        if (call.weights[o] == 0.0f) continue;
        const float term = octave(std::int64_t{call.size} << o, octaveSeed(seed, o)) * call.weights[o];
        sum = isFirst ? term : sum + term;
        isFirst = false;
    }
    return sum;
}

inline float perlin2D(const NoiseCall& call, std::uint32_t seed, std::int64_t x, std::int64_t y) {
    return sumOfOctaves(call, seed,
                        [&](std::int64_t size, std::uint32_t s) { return octave2D(size, s, x, y); });
}

inline float perlin3D(const NoiseCall& call, std::uint32_t seed, std::array<std::int64_t, 3> block) {
    return sumOfOctaves(call, seed,
                        [&](std::int64_t size, std::uint32_t s) { return octave3D(size, s, block); });
}

// Order of operations: simplex_tile.h.
inline float simplexOctave(std::int64_t size, std::uint32_t seed, std::int64_t xBlock, std::int64_t yBlock) {
    const std::int64_t period = 41 * size;
    const std::int64_t periodX = floorDivide(xBlock, period), periodY = floorDivide(yBlock, period);
    const float inverseSize = 1.0f / static_cast<float>(size);
    const float fx = static_cast<float>(xBlock - periodX * period) * inverseSize;
    const float fy = static_cast<float>(yBlock - periodY * period) * inverseSize;
    const float skew = (fx + fy) * (15.0f / 41.0f), unskewed = 15.0f / 71.0f;
    const float i = std::floor(fx + skew), j = std::floor(fy + skew);
    const float unskew = (i + j) * unskewed;
    const float x0 = fx - (i - unskew), y0 = fy - (j - unskew);
    const std::int64_t shift = (periodX + periodY) * 15;
    const auto corner = [&](int di, int dj, float back) {
        const float x = x0 - static_cast<float>(di) + back, y = y0 - static_cast<float>(dj) + back;
        const float t = std::max(0.5f - (x * x + y * y), 0.0f);
        const auto g = gradient2(periodX * 41 + shift + static_cast<std::int64_t>(i) + di,
                                 periodY * 41 + shift + static_cast<std::int64_t>(j) + dj, seed);
        return ((t * t) * (t * t)) * (g[0] * x + g[1] * y);
    };
    const int right = x0 > y0 ? 1 : 0;
    return 70.3f *
           ((corner(0, 0, 0.0f) + corner(right, 1 - right, unskewed)) + corner(1, 1, 2.0f * unskewed));
}

inline float simplex2D(const NoiseCall& call, std::uint32_t seed, std::int64_t x, std::int64_t y) {
    return sumOfOctaves(call, seed,
                        [&](std::int64_t size, std::uint32_t s) { return simplexOctave(size, s, x, y); });
}

// Cosine and sine. Order of operations: stripe_tile.h.
inline std::array<float, 2> stripes2D(const NoiseCall& call, std::uint32_t seed,
                                      std::array<std::int64_t, 2> block, std::array<float, 2> direction) {
    const std::int64_t size = call.size;
    const auto wave = [](float turns) {
        const float q = turns - std::floor(turns + 0.5f);
        return q * (8.0f - 16.0f * std::abs(q));
    };
    const std::int64_t cellX = floorDivide(block[0], size), cellY = floorDivide(block[1], size);
    float weights = 0, cosine = 0, sine = 0;
    for (std::int64_t y = cellY - 1; y <= cellY + 1; ++y) {
        for (std::int64_t x = cellX - 1; x <= cellX + 1; ++x) {
            const std::uint32_t h = shared::hash2(hashed(x), hashed(y), seed);
            const auto offset = [&](std::int64_t cell, std::int64_t at, std::uint32_t bits) {
                return static_cast<float>(cell * size - at) * (1.0f / static_cast<float>(size)) +
                       (0.25f + static_cast<float>(bits & 1023) * (0.5f / 1024.0f));
            };
            const float ox = offset(x, block[0], h), oy = offset(y, block[1], h >> 10);
            const float t = std::max(1.0f - (ox * ox + oy * oy) * (1.0f / 1.55f), 0.0f), weight = t * t;
            if (weight == 0.0f) continue;
            const float turns =
                static_cast<float>(h >> 20) * (1.0f / 4096.0f) - (ox * direction[0] + oy * direction[1]);
            weights += weight;
            cosine += weight * wave(turns + 0.25f);
            sine += weight * wave(turns);
        }
    }
    return {detDivide(cosine, weights), detDivide(sine, weights)};
}

struct VoronoiSample {
    float distance = 0, ratio = 0;
    std::int32_t offsetX = 0, offsetY = 0;
};

// Searches `reach` cells in each direction.
inline VoronoiSample voronoi2D(const NoiseCall& call, std::uint32_t seed, std::int64_t x, std::int64_t y,
                               int reach) {
    std::int64_t best = std::numeric_limits<std::int64_t>::max(), second = best;
    VoronoiSample sample;
    const std::int64_t ownX = floorDivide(x, call.size), ownY = floorDivide(y, call.size);
    for (std::int64_t cellY = ownY - reach; cellY <= ownY + reach; ++cellY) {
        for (std::int64_t cellX = ownX - reach; cellX <= ownX + reach; ++cellX) {
            const std::uint32_t h = shared::hash2(hashed(cellX), hashed(cellY), seed);
            const std::uint32_t count = 1 + (((h >> 16) * static_cast<std::uint32_t>(call.maxPoints)) >> 16);
            for (std::uint32_t k = 0; k < count; ++k) {
                const auto inCell = [&](std::uint32_t hash) {
                    return std::int64_t{hash >> 16} * call.size >> 16;
                };
                const std::int64_t px =
                    cellX * call.size + inCell(shared::mixBits(h + (2 * k + 1) * shared::kHashX));
                const std::int64_t py =
                    cellY * call.size + inCell(shared::mixBits(h + (2 * k + 2) * shared::kHashY));
                const std::int64_t d = (px - x) * (px - x) + (py - y) * (py - y);
                if (d < best) {
                    second = best;
                    best = d;
                    sample.offsetX = static_cast<std::int32_t>(px - x);
                    sample.offsetY = static_cast<std::int32_t>(py - y);
                } else if (d < second) {
                    second = d;
                }
            }
        }
    }
    sample.distance = detSqrt(static_cast<float>(best));
    sample.ratio = detDivide(sample.distance, detSqrt(static_cast<float>(second > 1 ? second : 1)));
    return sample;
}

struct Voronoi3DSample {
    float nearest = std::numeric_limits<float>::max(), second = nearest;
    std::array<std::int32_t, 3> offset{};
};

inline float powerSum(const NoiseCall& call, std::array<std::int64_t, 3> offset) {
    std::array<float, 3> powers;
    for (std::size_t k = 0; k < 3; ++k) {
        const float d = static_cast<float>(offset[k] < 0 ? -offset[k] : offset[k]) *
                        (1.0f / static_cast<float>(call.size));
        powers[k] = d;
        for (int n = 1; n < call.exponent; ++n) powers[k] *= d;
    }
    return (powers[0] + powers[1]) + powers[2];
}

inline Voronoi3DSample voronoi3D(const NoiseCall& call, std::uint32_t seed, std::array<std::int64_t, 3> block,
                                 int reach = 2) {
    Voronoi3DSample sample;
    const int width = 2 * reach + 1;
    for (int n = 0; n < width * width * width; ++n) {
        const std::array<std::int64_t, 3> cell = {
            floorDivide(block[0], call.size) + n % width - reach,
            floorDivide(block[1], call.size) + n / width % width - reach,
            floorDivide(block[2], call.size) + n / width / width - reach};
        const std::uint32_t h = shared::hash3(hashed(cell[0]), hashed(cell[1]), hashed(cell[2]), seed);
        const std::uint32_t count = 1 + (((h >> 16) * static_cast<std::uint32_t>(call.maxPoints)) >> 16);
        for (std::uint32_t k = 0; k < count; ++k) {
            constexpr std::array<std::uint32_t, 3> kFactors = {shared::kHashX, shared::kHashY,
                                                               shared::kHashZ};
            std::array<std::int64_t, 3> offset;
            for (std::uint32_t axis = 0; axis < 3; ++axis) {
                const std::uint32_t hash = shared::mixBits(h + (3 * k + 1 + axis) * kFactors[axis]);
                offset[axis] =
                    cell[axis] * call.size + (std::int64_t{hash >> 16} * call.size >> 16) - block[axis];
            }
            const float sum = powerSum(call, offset);
            if (sum < sample.nearest) {
                sample.second = sample.nearest;
                sample.nearest = sum;
                for (std::size_t axis = 0; axis < 3; ++axis)
                    sample.offset[axis] = static_cast<std::int32_t>(offset[axis]);
            } else if (sum < sample.second) {
                sample.second = sum;
            }
        }
    }
    return sample;
}

}  // namespace terrane::gen::reference

// Random numbers and directions that trees grow by: the same bits on every machine. One thread at a time may
// use it.
#pragma once

#include <cstdint>

#include "terrane/shared/det_math.h"
#include "terrane/shared/hash.h"

namespace terrane::gen::trees {

struct Point {
    float x = 0, y = 0, z = 0;  // blocks; (0, 0, 0) is the middle of the foot's voxel
};

// clang-format off
constexpr Point operator+(Point a, Point b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
constexpr Point operator-(Point a, Point b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
constexpr Point operator*(Point a, float s) { return {a.x * s, a.y * s, a.z * s}; }
constexpr float lengthSquared(Point a) { return a.x * a.x + a.y * a.y + a.z * a.z; }
// clang-format on

inline float lengthOf(Point a) {
    return shared::detSqrt(lengthSquared(a));
}

inline Point normalized(Point a) {
    const float length = lengthOf(a);
    return length < 1e-6f ? Point{0, 0, 1} : a * shared::detReciprocal(length);
}

constexpr int roundToInt(float v) {
    const int toZero = static_cast<int>(v + 0.5f);
    return toZero - (v + 0.5f < static_cast<float>(toZero) ? 1 : 0);
}

// Returns sin(2π turns) within 0.0011: a parabola and one of its squares.
constexpr float sinTurns(float turns) {
    const float t = turns - static_cast<float>(roundToInt(turns));  // −½…½
    const float s = t * (8.0f - 16.0f * (t < 0 ? -t : t));
    return s * (0.775f + 0.225f * (s < 0 ? -s : s));
}

// Returns a horizontal direction.
constexpr Point heading(float turns) {
    return {sinTurns(turns + 0.25f), sinTurns(turns), 0};
}

class Random {
  public:
    explicit Random(std::uint32_t seed) : seed_(seed) {}

    // Call this once per expression: compilers may evaluate operands in any order.
    float unit() {  // [0, 1)
        return static_cast<float>(shared::hash2(count_++, 0, seed_) >> 8) * (1.0f / 16777216.0f);
    }
    float between(float low, float high) { return low + (high - low) * unit(); }
    int between(int low, int high) {  // both included
        return low + static_cast<int>(unit() * static_cast<float>(high - low + 1));
    }
    Point inBall() {  // uniform in the ball of radius 1
        for (;;) {
            const float x = between(-1.0f, 1.0f), y = between(-1.0f, 1.0f), z = between(-1.0f, 1.0f);
            if (lengthSquared({x, y, z}) <= 1.0f) return {x, y, z};
        }
    }

  private:
    std::uint32_t seed_, count_ = 0;
};

// Returns a horizontal offset of a random direction, `low`…`high` blocks long.
inline Point aside(float low, float high, Random& random) {
    const Point way = heading(random.unit());
    return way * random.between(low, high);
}

}  // namespace terrane::gen::trees

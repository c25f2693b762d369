// Interval arithmetic for expressions: the results that an operation can have for arguments in known ranges.
// slab_ranges.cpp uses it to find computations that can be skipped.
//
// Every range holds all values the operation gives, to the bit: integers that may wrap are unknown, and the
// bounds of float operations are rounded as the operation itself is (rounding to nearest is monotone).
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "terrane/gen/compile/op.h"
#include "terrane/gen/noise/noise.h"

namespace terrane::gen {

struct ValueRange {
    // The type of the value's node says which members hold.
    union {
        std::int32_t low;  // Int: as it is. Bool: 0 and -1, a lane's bits as a number.
        float lowF;        // NaN excluded; −0 equals 0
    };
    union {
        std::int32_t high;
        float highF;
    };
    bool mayBeNaN;
    bool mayNarrow;  // fewer layers may have a smaller range
};

constexpr ValueRange intRange(std::int32_t low, std::int32_t high) {
    return {.low = low, .high = high, .mayBeNaN = false, .mayNarrow = false};
}
constexpr ValueRange floatRange(float low, float high) {
    return {.lowF = low, .highF = high, .mayBeNaN = false, .mayNarrow = false};
}

constexpr ValueRange kAnyInt =
    intRange(std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max());
constexpr ValueRange kAnyBool = intRange(-1, 0);
constexpr ValueRange kAnyFloat = {.lowF = -std::numeric_limits<float>::infinity(),
                                  .highF = std::numeric_limits<float>::infinity(),
                                  .mayBeNaN = true,
                                  .mayNarrow = false};

constexpr ValueRange unknownRange(Type type) {
    if (type == Type::Float) return kAnyFloat;
    return type == Type::Int ? kAnyInt : kAnyBool;
}
// Returns the range of one value, which may be NaN.
ValueRange rangeOf(Type type, Bits value);

inline bool isCertain(const ValueRange& intOrBool) {
    return intOrBool.low == intOrBool.high;
}

// Returns the smallest range that includes both.
ValueRange unite(Type type, const ValueRange& a, const ValueRange& b);

// Returns the result of an operation that is a function of its arguments (record(op).evaluate). `type` is its
// result's. Select and Phi: the condition, then both sides.
ValueRange resultRange(Op op, Type type, std::span<const ValueRange> args);

// Returns the range of Perlin noise in 3D: ±1.5 Σ|weight|. Along an axis the distances of the nodes, weighted
// as the blend weights them, add up to f + t − 2ft = ½ − 2(½ − f)(½ − t), at most ½, as the fade t is on the
// same side of ½ as f. A gradient has components of 0 and ±1, so three axes give 1.5 at most. A small margin
// covers rounding.
ValueRange perlin3DRange(const NoiseCall& call);

}  // namespace terrane::gen

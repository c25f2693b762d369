// Intervals of the values of expressions: what an operation can give for arguments of known ranges, whatever
// values in them columns and layers have. Used by slab_ranges.cpp to find what need not be computed.
//
// Every range holds all values the operation gives, to the bit: integers that may wrap are unknown, and the
// bounds of float operations are rounded as the operation itself is (rounding to nearest is monotone).
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include "terrane/gen/noise.h"
#include "terrane/gen/op.h"

namespace terrane::gen {

struct ValueRange {
    // Which ones hold is the type of the value's node to know.
    union {
        std::int32_t low;  // Int: as it is. Bool: 0 and -1, a lane's bits as a number.
        float lowF;        // of what is not NaN; zeros are equal whatever their signs
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
// Of one value.
ValueRange rangeOf(Type type, Bits value);
// Of several: NaN is allowed.
ValueRange rangeOf(Type type, std::span<const Bits> values);

inline bool isCertain(const ValueRange& intOrBool) {
    return intOrBool.low == intOrBool.high;
}
bool contains(const ValueRange& range, Type type, Bits value);

// Of either of two values of a type.
ValueRange unite(Type type, const ValueRange& a, const ValueRange& b);

// The result of an operation that is a function of its arguments (record(op).evaluate). `type` is its
// result's. Select and Phi: the condition, then both sides.
ValueRange resultRange(Op op, Type type, std::span<const ValueRange> args);

// Of Perlin noise in 3D: within ±1.5 Σ|weight|. Along an axis the nodes' distances, weighted as the blend
// weights them, add up to f + t − 2ft = ½ − 2(½ − f)(½ − t), at most ½ as the fade t is on the same side of ½
// as f. A gradient has components of 0 and ±1, so that three axes give 1.5 at most; and a little more for
// rounding.
ValueRange perlin3DRange(const NoiseCall& call);

}  // namespace terrane::gen

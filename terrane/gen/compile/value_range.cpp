#include "terrane/gen/compile/value_range.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace terrane::gen {
namespace {

using Ranges = std::span<const ValueRange>;
using Ints = std::numeric_limits<std::int32_t>;

constexpr float kInfinity = std::numeric_limits<float>::infinity();

bool isFinite(const ValueRange& r) {
    return !r.mayBeNaN && r.lowF > -kInfinity && r.highF < kInfinity;
}

ValueRange truth(bool always, bool never) {
    return intRange(never ? 0 : -1, always ? -1 : 0);
}

ValueRange unlessWrapped(std::int64_t low, std::int64_t high) {
    if (low < Ints::min() || high > Ints::max()) return kAnyInt;
    return intRange(static_cast<std::int32_t>(low), static_cast<std::int32_t>(high));
}

// Range of the results at the four corners, for operations that are monotone in each argument.
template <class Function>
ValueRange cornersOf(Ranges a, Function f) {
    const std::int64_t r[] = {f(a[0].low, a[1].low), f(a[0].low, a[1].high), f(a[0].high, a[1].low),
                              f(a[0].high, a[1].high)};
    return unlessWrapped(*std::min_element(r, r + 4), *std::max_element(r, r + 4));
}

template <class Function>
ValueRange cornersOfF(Ranges a, Function f) {
    if (!isFinite(a[0]) || !isFinite(a[1])) return kAnyFloat;
    const float r[] = {f(a[0].lowF, a[1].lowF), f(a[0].lowF, a[1].highF), f(a[0].highF, a[1].lowF),
                       f(a[0].highF, a[1].highF)};
    return floatRange(*std::min_element(r, r + 4), *std::max_element(r, r + 4));
}

// Division and square root are within 2 units in the last place for arguments far from the ends of the
// exponents (det_math.h): these margins are wider.
constexpr float kLargest = 0x1p60f, kMargin = 0x1p-18f, kSmallest = 0x1p-48f;

ValueRange widened(float low, float high) {
    return floatRange(low - (std::abs(low) * kMargin + kSmallest),
                      high + (std::abs(high) * kMargin + kSmallest));
}

ValueRange divide(Ranges a) {
    const auto isMedium = [](const ValueRange& r) { return r.lowF >= -kLargest && r.highF <= kLargest; };
    const bool isAway = a[1].lowF >= 1 / kLargest || a[1].highF <= -1 / kLargest;
    if (a[0].mayBeNaN || a[1].mayBeNaN || !isMedium(a[0]) || !isMedium(a[1]) || !isAway) return kAnyFloat;
    const ValueRange exact = cornersOfF(a, [](float p, float q) { return p / q; });
    return widened(exact.lowF, exact.highF);
}

ValueRange squareRoot(const ValueRange& a) {
    if (a.mayBeNaN || a.lowF < 0 || a.highF > kLargest) return kAnyFloat;
    return widened(std::sqrt(a.lowF), std::sqrt(a.highF));
}

ValueRange absolute(const ValueRange& a) {
    if (a.low == Ints::min()) return kAnyInt;
    const std::int32_t low = std::abs(a.low), high = std::abs(a.high);
    const bool crosses = a.low < 0 && a.high > 0;
    return intRange(crosses ? 0 : std::min(low, high), std::max(low, high));
}

ValueRange absoluteF(const ValueRange& a) {
    const bool crosses = a.lowF < 0 && a.highF > 0;
    const float low = std::abs(a.lowF), high = std::abs(a.highF);
    ValueRange r = floatRange(crosses ? 0 : std::min(low, high), std::max(low, high));
    r.mayBeNaN = a.mayBeNaN;
    return r;
}

// The result is the first argument if either is NaN.
template <class Function>
ValueRange minOrMax(Ranges a, Function f) {
    if (a[0].mayBeNaN || a[1].mayBeNaN) return unite(Type::Float, a[0], a[1]);
    return floatRange(f(a[0].lowF, a[1].lowF), f(a[0].highF, a[1].highF));
}

ValueRange bitAnd(const ValueRange& a, const ValueRange& b) {
    if (a.low >= 0 && b.low >= 0) return intRange(0, std::min(a.high, b.high));
    if (a.low >= 0) return intRange(0, a.high);
    return b.low >= 0 ? intRange(0, b.high) : kAnyInt;
}

// Or and exclusive or: no bit above the highest one of both.
ValueRange bitOr(const ValueRange& a, const ValueRange& b) {
    if (a.low < 0 || b.low < 0) return kAnyInt;
    const auto highest = static_cast<std::uint32_t>(std::max(a.high, b.high));
    return intRange(0, static_cast<std::int32_t>((std::uint64_t{1} << std::bit_width(highest)) - 1));
}

ValueRange shift(Op op, Ranges a) {
    if (!isCertain(a[1])) return kAnyInt;
    const int by = a[1].low & 31;
    if (op == Op::ShiftRightI) return intRange(a[0].low >> by, a[0].high >> by);
    return unlessWrapped(std::int64_t{a[0].low} * (std::int64_t{1} << by),
                         std::int64_t{a[0].high} * (std::int64_t{1} << by));
}

ValueRange toInt(const ValueRange& a) {
    if (a.mayBeNaN || a.lowF < -2147483648.0f || a.highF >= 2147483648.0f) return kAnyInt;
    return intRange(static_cast<std::int32_t>(a.lowF), static_cast<std::int32_t>(a.highF));
}

// The bits of positive floats increase with their value. −0 has other bits.
ValueRange floatBits(const ValueRange& a) {
    if (a.mayBeNaN || a.lowF <= 0) return kAnyInt;
    return intRange(asInt(bitsOf(a.lowF)), asInt(bitsOf(a.highF)));
}

ValueRange bitsFloat(const ValueRange& a) {
    if (a.low < 0 || a.high > asInt(bitsOf(kInfinity))) return kAnyFloat;
    return floatRange(asFloat(bitsOf(a.low)), asFloat(bitsOf(a.high)));
}

ValueRange compareF(Op op, Ranges a) {
    const bool isOrdered = !a[0].mayBeNaN && !a[1].mayBeNaN;
    if (op == Op::LessF) return truth(isOrdered && a[0].highF < a[1].lowF, a[0].lowF >= a[1].highF);
    if (op == Op::LessEqualF) return truth(isOrdered && a[0].highF <= a[1].lowF, a[0].lowF > a[1].highF);
    const bool isSame = a[0].lowF == a[0].highF && a[1].lowF == a[1].highF && a[0].lowF == a[1].lowF;
    return truth(isOrdered && isSame, a[0].highF < a[1].lowF || a[1].highF < a[0].lowF);
}

ValueRange floatResult(Op op, Ranges a) {
    switch (op) {
        case Op::AddF:
            return cornersOfF(a, [](float p, float q) { return p + q; });
        case Op::SubF:
            return cornersOfF(a, [](float p, float q) { return p - q; });
        case Op::MulF:
            return cornersOfF(a, [](float p, float q) { return p * q; });
        case Op::DivF:
            return divide(a);
        case Op::MinF:
            return minOrMax(a, [](float p, float q) { return std::min(p, q); });
        case Op::MaxF:
            return minOrMax(a, [](float p, float q) { return std::max(p, q); });
        case Op::AbsF:
            return absoluteF(a[0]);
        case Op::FloorF:
            return isFinite(a[0]) ? floatRange(std::floor(a[0].lowF), std::floor(a[0].highF)) : kAnyFloat;
        case Op::SqrtF:
            return squareRoot(a[0]);
        case Op::IntToFloat:
            return floatRange(static_cast<float>(a[0].low), static_cast<float>(a[0].high));
        case Op::BitsFloat:
            return bitsFloat(a[0]);
        default:
            return kAnyFloat;
    }
}

ValueRange intResult(Op op, Ranges a) {
    switch (op) {
        case Op::AddI:
            return unlessWrapped(std::int64_t{a[0].low} + a[1].low, std::int64_t{a[0].high} + a[1].high);
        case Op::SubI:
            return unlessWrapped(std::int64_t{a[0].low} - a[1].high, std::int64_t{a[0].high} - a[1].low);
        case Op::MulI:
            return cornersOf(a, [](std::int64_t p, std::int64_t q) { return p * q; });
        case Op::MinI:
            return intRange(std::min(a[0].low, a[1].low), std::min(a[0].high, a[1].high));
        case Op::MaxI:
            return intRange(std::max(a[0].low, a[1].low), std::max(a[0].high, a[1].high));
        case Op::AbsI:
            return absolute(a[0]);
        case Op::FloorDivideI:
            if (a[1].low < 1) return kAnyInt;
            return cornersOf(a, [](std::int64_t p, std::int64_t q) { return p / q - (p % q < 0 ? 1 : 0); });
        case Op::AndI:
            return bitAnd(a[0], a[1]);
        case Op::OrI:
        case Op::XorI:
            return bitOr(a[0], a[1]);
        case Op::ShiftLeftI:
        case Op::ShiftRightI:
            return shift(op, a);
        case Op::FloatToInt:
            return toInt(a[0]);
        case Op::FloatBits:
            return floatBits(a[0]);
        default:
            return kAnyInt;
    }
}

ValueRange boolResult(Op op, Ranges a) {
    switch (op) {
        case Op::LessF:
        case Op::LessEqualF:
        case Op::EqualF:
            return compareF(op, a);
        case Op::LessI:
            return truth(a[0].high < a[1].low, a[0].low >= a[1].high);
        case Op::LessEqualI:
            return truth(a[0].high <= a[1].low, a[0].low > a[1].high);
        case Op::EqualI:
            return truth(isCertain(a[0]) && a[0].low == a[1].low && isCertain(a[1]),
                         a[0].high < a[1].low || a[1].high < a[0].low);
        case Op::And:  // of 0 and -1 the larger is 0
            return intRange(std::max(a[0].low, a[1].low), std::max(a[0].high, a[1].high));
        case Op::Or:
            return intRange(std::min(a[0].low, a[1].low), std::min(a[0].high, a[1].high));
        case Op::Not:
            return intRange(-1 - a[0].high, -1 - a[0].low);
        default:
            return kAnyBool;
    }
}

// Whether `value & mask` is in 0…mask whatever part of its range the value is in.
bool isMaskOf(const ValueRange& mask, const ValueRange& value) {
    return isCertain(mask) && mask.low >= 0 && (value.high < 0 || value.low >= mask.low);
}

}  // namespace

ValueRange rangeOf(Type type, Bits value) {
    if (type != Type::Float) return intRange(asInt(value), asInt(value));
    const float f = asFloat(value);
    return std::isnan(f) ? kAnyFloat : floatRange(f, f);
}

ValueRange unite(Type type, const ValueRange& a, const ValueRange& b) {
    ValueRange r = type == Type::Float ? floatRange(std::min(a.lowF, b.lowF), std::max(a.highF, b.highF))
                                       : intRange(std::min(a.low, b.low), std::max(a.high, b.high));
    r.mayBeNaN = a.mayBeNaN || b.mayBeNaN;
    r.mayNarrow = a.mayNarrow || b.mayNarrow;
    return r;
}

ValueRange resultRange(Op op, Type type, std::span<const ValueRange> args) {
    ValueRange r = kAnyInt;
    if (op == Op::Select || op == Op::Phi) {
        if (isCertain(args[0])) return args[0].low != 0 ? args[1] : args[2];
        r = unite(type, args[1], args[2]);
    } else if (type == Type::Float) {
        r = floatResult(op, args);
    } else {
        r = type == Type::Int ? intResult(op, args) : boolResult(op, args);
    }
    r.mayNarrow = false;
    if (type != Type::Float && isCertain(r)) return r;
    for (const ValueRange& a : args) r.mayNarrow = r.mayNarrow || a.mayNarrow;
    if (op == Op::AndI && isMaskOf(args[1], args[0])) r.mayNarrow = false;
    return r;
}

ValueRange perlin3DRange(const NoiseCall& call) {
    float sum = 0;
    for (const float weight : call.weights) sum += std::abs(weight);
    const float most = sum * 1.5f * 1.001f;
    return most < kInfinity ? floatRange(-most, most) : kAnyFloat;
}

}  // namespace terrane::gen

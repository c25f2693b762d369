#include "terrane/gen/language/expr.h"

#include <cassert>
#include <iterator>
#include <span>

namespace terrane::gen {

namespace {

Type argumentType(const OpRecord& rec, std::size_t number, Type result) {
    const bool isSide = (rec.op == Op::Select || rec.op == Op::Phi) && number > 0;
    return isSide ? result : rec.argTypes[number];
}

}  // namespace

Value applyOp(Op op, Type result, std::initializer_list<Value> args, std::uint32_t imm) {
    const OpRecord& rec = record(op);
    assert(args.size() == rec.argCount && "an operation takes as many arguments as its record says");
    Graph* graph = nullptr;
    for (const Value& v : args) graph = v.graph ? v.graph : graph;

    std::array<Bits, 3> values{};
    std::size_t count = 0;
    for (const Value& v : args) {
        values[count] = graph ? v.nodeIn(*graph, argumentType(rec, count, result)) : v.bits;
        ++count;
    }
    if (!graph) return {nullptr, rec.evaluate(values)};
    return {graph, graph->add(op, result, {values.data(), count}, imm)};
}

namespace {

constexpr int kMantissaBits = 23;

// c₀ + x (c₁ + x (c₂ + …))
Float polynomial(Float x, std::span<const float> coefficients) {
    Float sum = coefficients.back();
    for (std::size_t k = coefficients.size() - 1; k-- > 0;) sum = coefficients[k] + x * sum;
    return sum;
}

// sin(x + quarters · π/2)
Float sinOfQuarters(Float x, std::int32_t quarters) {
    constexpr float kTwoOverPi = 0.636619772f;
    // π/2 in three parts; the first two have so few bits that their products with n are exact up to n = 2^12.
    constexpr float kParts[] = {1.5703125f, 4.83751297e-4f, 7.54979013e-8f};
    const Float n = round(x * kTwoOverPi);
    const Float r = ((x - n * kParts[0]) - n * kParts[1]) - n * kParts[2];
    const Float r2 = r * r;
    // (sin r - r) / r³ and (cos r - 1 + r²/2) / r⁴ on |r| ≤ π/4; errors 2e-12 and 1e-10
    constexpr float kSin[] = {-0.166666672f, 8.33332818e-3f, -1.98390437e-4f, 2.71601402e-6f};
    constexpr float kCos[] = {4.16666456e-2f, -1.38873677e-3f, 2.44384519e-5f};
    const Float sine = r + r * r2 * polynomial(r2, kSin);
    const Float cosine = 1.0f - 0.5f * r2 + r2 * r2 * polynomial(r2, kCos);
    const Int quadrant = Int(n) + quarters;
    const Float value = select((quadrant & 1) == 0, sine, cosine);
    return select((quadrant & 2) == 0, value, -value);
}

}  // namespace

Float exp2(Float x) {
    constexpr float kSmallestExponent = -126.0f, kLargestExponent = 127.999992f;
    // NaN fails every comparison and takes the way of the small.
    const Bool fits = x >= kSmallestExponent;
    const Float inRange = min(select(fits, x, Float(0.0f)), kLargestExponent);
    const Float whole = floor(inRange + 0.5f);
    const Float f = inRange - whole;
    // (2^f - 1) / f on |f| ≤ ½; error 2e-9
    constexpr float kExp2[] = {0.693147182f,   0.240226507f,   5.55032790e-2f,
                               9.61800385e-3f, 1.34002697e-3f, 1.54763009e-4f};
    const Float power = 1.0f + f * polynomial(f, kExp2);
    // 2^128 has no bits of its own, so that the exponent is added in two steps.
    const Int exponent = Int(whole), half = exponent >> 1;
    const Float scaled = bitsFloat(floatBits(power) + (half << kMantissaBits));
    return select(fits, scaled * bitsFloat((exponent - half + 127) << kMantissaBits), Float(0.0f));
}

Float log2(Float x) {
    constexpr float kSmallestNormal = 0x1p-126f, kLogOfNothing = -1.0e9f;
    constexpr std::int32_t kRootOfHalf = 0x3F3504F3;  // √½: mantissas are taken from √½…√2
    const Int bits = floatBits(x);
    const Int exponent = (bits - kRootOfHalf) >> kMantissaBits;
    const Float f = bitsFloat(bits - (exponent << kMantissaBits)) - 1.0f;
    // log2(1 + f) / f for 1 + f in √½…√2; error 4e-8
    constexpr float kLog2[] = {1.44269502f,   -0.721347213f, 0.480910271f,  -0.360716254f, 0.287939101f,
                               -0.238675684f, 0.215212256f,  -0.208933815f, 0.129264295f};
    return select(x >= kSmallestNormal, Float(exponent) + f * polynomial(f, kLog2), Float(kLogOfNothing));
}

Float pow(Float x, Float y) {
    return exp2(y * log2(x));
}

Float sin(Float x) {
    return sinOfQuarters(x, 0);
}

Float cos(Float x) {
    return sinOfQuarters(x, 1);
}

Int packColor(Float red, Float green, Float blue) {
    const auto byte = [](const Float& channel) { return Int(clamp(channel, 0.0f, 1.0f) * 255.0f + 0.5f); };
    return byte(red) << 16 | byte(green) << 8 | byte(blue);
}

}  // namespace terrane::gen

// Division and square root from additions, multiplications and integer operations, so that every machine and
// every instruction set gives the same bits. `kernels.cpp` repeats them in SIMD, step by step; tests compare
// the two.
#pragma once

#include <bit>
#include <cstdint>

namespace terrane::gen {

// First guess for 1/x by integer subtraction from the exponent, error 5.1 %; each of three Newton steps
// squares the error, until roundings are all that is left: 2 units in the last place. x in [2^-126, 2^125].
constexpr std::uint32_t kReciprocalMagic = 0x7EF311C7u;

constexpr float detReciprocal(float x) {
    float r = std::bit_cast<float>(kReciprocalMagic - std::bit_cast<std::uint32_t>(x));
    r = r * (2.0f - x * r);
    r = r * (2.0f - x * r);
    r = r * (2.0f - x * r);
    return r;
}

// a / b within 2 units in the last place (measured: 1.4); whole quotients may be one unit off too, so that
// floor(a / b) is no integer division. |b| in [2^-126, 2^125]; other divisors, 0 too, give infinities, NaN or
// garbage, the same on every machine.
constexpr float detDivide(float a, float b) {
    const std::uint32_t sign = std::bit_cast<std::uint32_t>(b) & 0x80000000u;
    const float magnitude = std::bit_cast<float>(std::bit_cast<std::uint32_t>(b) ^ sign);
    const float r = detReciprocal(magnitude);
    const float signedA = std::bit_cast<float>(std::bit_cast<std::uint32_t>(a) ^ sign);
    const float q = signedA * r;
    return q + r * (signedA - magnitude * q);
}

// First guess for 1/√x (C. Lomont, Fast Inverse Square Root, 2003), error 3.5 %.
constexpr std::uint32_t kInverseRootMagic = 0x5F375A86u;

// √x within 1 unit in the last place (measured over all of them: 0.76) for normal x; 0 for 0.
// (half · r) · r, in this order: r · r would overflow for 0.
constexpr float detSqrt(float x) {
    const float half = 0.5f * x;
    float r = std::bit_cast<float>(kInverseRootMagic - (std::bit_cast<std::uint32_t>(x) >> 1));
    r = r * (1.5f - (half * r) * r);
    r = r * (1.5f - (half * r) * r);
    r = r * (1.5f - (half * r) * r);
    const float s = x * r;
    return s + (0.5f * r) * (x - s * s);
}

}  // namespace terrane::gen

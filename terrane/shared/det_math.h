// Division and square root from additions, multiplications and integer operations, so that every machine,
// every instruction set and every GPU gives the same bits. gen/tile_rows-inl.h repeats them in SIMD, step
// by step; tests compare.
#ifndef TERRANE_SHARED_DET_MATH_H
#define TERRANE_SHARED_DET_MATH_H

#include "terrane/shared/language.h"

SHARED_BEGIN

// First guess for 1/x by integer subtraction from the exponent, error 5.1 %; each of three Newton steps
// squares the error, until roundings are all that is left: 2 units in the last place. x in [2^-126, 2^125].
const uint kReciprocalMagic = 0x7EF311C7u;

SHARED_FN float detReciprocal(float x) {
    SHARED_PRECISE float r = uintBitsToFloat(kReciprocalMagic - floatBitsToUint(x));
    r = r * (2.0f - x * r);
    r = r * (2.0f - x * r);
    r = r * (2.0f - x * r);
    return r;
}

// a / b within 2 units in the last place (measured: 1.4). |b| in [2^-126, 2^125]; other divisors, 0 too, give
// infinities, NaN or garbage, the same on every machine.
SHARED_FN float detDivide(float a, float b) {
    uint sign = floatBitsToUint(b) & 0x80000000u;
    float magnitude = uintBitsToFloat(floatBitsToUint(b) ^ sign);
    float r = detReciprocal(magnitude);
    float signedA = uintBitsToFloat(floatBitsToUint(a) ^ sign);
    SHARED_PRECISE float q = signedA * r;
    SHARED_PRECISE float corrected = q + r * (signedA - magnitude * q);
    return corrected;
}

// First guess for 1/√x (C. Lomont, Fast Inverse Square Root, 2003), error 3.5 %.
const uint kInverseRootMagic = 0x5F375A86u;

// √x within 1 unit in the last place (measured: 0.82) for normal x; 0 for 0.
// (half · r) · r, in this order: r · r would overflow for 0.
SHARED_FN float detSqrt(float x) {
    SHARED_PRECISE float halfX = 0.5f * x;
    SHARED_PRECISE float r = uintBitsToFloat(kInverseRootMagic - (floatBitsToUint(x) >> 1));
    r = r * (1.5f - (halfX * r) * r);
    r = r * (1.5f - (halfX * r) * r);
    r = r * (1.5f - (halfX * r) * r);
    SHARED_PRECISE float s = x * r;
    SHARED_PRECISE float corrected = s + (0.5f * r) * (x - s * s);
    return corrected;
}

// 1/√x for normal x, to within 5 millionths of it: two of the steps of detSqrt.
SHARED_FN float detInverseSqrt(float x) {
    SHARED_PRECISE float halfX = 0.5f * x;
    SHARED_PRECISE float r = uintBitsToFloat(kInverseRootMagic - (floatBitsToUint(x) >> 1));
    r = r * (1.5f - (halfX * r) * r);
    r = r * (1.5f - (halfX * r) * r);
    return r;
}

SHARED_END
#endif

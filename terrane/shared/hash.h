// Integer hashing with one possible result on every machine, for generation on the CPU and the GPU.
// All arithmetic is modulo 2^32.
#ifndef TERRANE_SHARED_HASH_H
#define TERRANE_SHARED_HASH_H

#include "terrane/shared/language.h"

SHARED_BEGIN

// Odd multipliers that spread one coordinate over 32 bits each: 2^32 divided by the golden ratio's
// generalizations to three dimensions (roots of g^4 = g + 1), rounded to odd.
const uint kHashX = 0xD1B54A33u;
const uint kHashY = 0xABC98389u;
const uint kHashZ = 0x8CB92BA7u;

// Finalizer of 32 bits with two multiplications; constants from the "lowbias32" search (C. Wellons,
// Prospecting for Hash Functions, 2018), avalanche bias 0.17.
SHARED_FN uint mixBits(uint h) {
    h ^= h >> 16;
    h *= 0x7FEB352Du;
    h ^= h >> 15;
    h *= 0x846CA68Bu;
    h ^= h >> 16;
    return h;
}

// Half a finalizer between two coordinates: with nothing but XOR between the products, hash2(x, y) would
// equal hash2(-x, -y) wherever x and y end in as many zero bits, a third of all positions.
SHARED_FN uint mixHalf(uint h) {
    h ^= h >> 15;
    return h * 0x846CA68Bu;
}

SHARED_FN uint hash2(uint x, uint y, uint seed) {
    return mixBits(mixHalf((x * kHashX) ^ seed) ^ (y * kHashY));
}

SHARED_FN uint hash3(uint x, uint y, uint z, uint seed) {
    return mixBits(mixHalf(mixHalf((x * kHashX) ^ seed) ^ (y * kHashY)) ^ (z * kHashZ));
}

SHARED_END
#endif

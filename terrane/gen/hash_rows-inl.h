// Hashes of lattice coordinates in SIMD lanes, as terrane/shared/hash.h has them. Included once for each
// instruction set by kernels.cpp.
#if defined(TERRANE_GEN_HASH_ROWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TERRANE_GEN_HASH_ROWS_INL_H
#undef TERRANE_GEN_HASH_ROWS_INL_H
#else
#define TERRANE_GEN_HASH_ROWS_INL_H
#endif

#include "terrane/gen/tile_rows-inl.h"
#include "terrane/shared/hash.h"

HWY_BEFORE_NAMESPACE();
namespace terrane::gen {
namespace HWY_NAMESPACE {

HWY_INLINE VU mixBits(VU h) {
    h = hn::Xor(h, hn::ShiftRight<16>(h));
    h = hn::Mul(h, hn::Set(du, 0x7FEB352Du));
    h = hn::Xor(h, hn::ShiftRight<15>(h));
    h = hn::Mul(h, hn::Set(du, 0x846CA68Bu));
    return hn::Xor(h, hn::ShiftRight<16>(h));
}

HWY_INLINE VU mixHalf(VU h) {
    return hn::Mul(hn::Xor(h, hn::ShiftRight<15>(h)), hn::Set(du, 0x846CA68Bu));
}

HWY_INLINE VU hash2Lanes(VU x, VU y, VU seed) {
    const VU half = mixHalf(hn::Xor(hn::Mul(x, hn::Set(du, shared::kHashX)), seed));
    return mixBits(hn::Xor(half, hn::Mul(y, hn::Set(du, shared::kHashY))));
}

}  // namespace HWY_NAMESPACE
}  // namespace terrane::gen
HWY_AFTER_NAMESPACE();
#endif

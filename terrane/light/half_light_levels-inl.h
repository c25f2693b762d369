// Half a row of light, eight voxels, in SIMD: in one vector of 32 bytes or in two of 16. It is included once
// for each instruction set by light_levels-inl.h.
#if defined(TERRANE_LIGHT_HALF_LIGHT_LEVELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TERRANE_LIGHT_HALF_LIGHT_LEVELS_INL_H
#undef TERRANE_LIGHT_HALF_LIGHT_LEVELS_INL_H
#else
#define TERRANE_LIGHT_HALF_LIGHT_LEVELS_INL_H
#endif

#include <hwy/highway.h>

#include "terrane/light/chunk_light.h"

HWY_BEFORE_NAMESPACE();
namespace terrane::light {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The levels of eight voxels, a byte each, so that maximum and saturated difference of bytes are those of
// levels: 16 bytes with red and blue in the low four bits (even) and 16 with green and daylight in the high
// four (odd). Both are in one vector of 32 bytes, or in two of 16.
#if HWY_MAX_BYTES >= 32
const hn::FixedTag<std::uint8_t, 32> kBytes;
using Bytes = hn::Vec<decltype(kBytes)>;
struct Half {
    Bytes levels;
};
#else
const hn::FixedTag<std::uint8_t, 16> kBytes;
using Bytes = hn::Vec<decltype(kBytes)>;
struct Half {
    Bytes even, odd;
};
#endif

HWY_INLINE const std::uint8_t* bytesOf(const LightValue* values) {
    return reinterpret_cast<const std::uint8_t*>(values);
}

HWY_INLINE std::uint8_t* bytesOf(LightValue* values) {
    return reinterpret_cast<std::uint8_t*>(values);
}

#if HWY_MAX_BYTES >= 32

// `even` in the lower 16 bytes, `odd` in the upper.
HWY_INLINE Bytes evenAndOdd(std::uint64_t even, std::uint64_t odd) {
    alignas(32) const std::uint64_t words[4] = {even, even, odd, odd};
    return hn::BitCast(kBytes, hn::Load(hn::FixedTag<std::uint64_t, 4>(), words));
}

HWY_INLINE Half loadHalf(const LightValue* values) {
    return {
        hn::And(hn::LoadDup128(kBytes, bytesOf(values)), evenAndOdd(0x0F0F0F0F0F0F0F0F, 0xF0F0F0F0F0F0F0F0))};
}

HWY_INLINE void storeHalf(Half half, LightValue* values) {
    const hn::Half<decltype(kBytes)> block;
    hn::StoreU(hn::Or(hn::LowerHalf(block, half.levels), hn::UpperHalf(block, half.levels)), block,
               bytesOf(values));
}

// Returns a level of 1.
HWY_INLINE Half halfOfOnes() {
    return {evenAndOdd(0x0101010101010101, 0x1010101010101010)};
}

template <class Function>
HWY_INLINE Half eachOf(Function f, const Half& p, const Half& q) {
    return {f(p.levels, q.levels)};
}

HWY_INLINE Bytes anyOf(const Half& half) {
    return half.levels;
}

#else

HWY_INLINE Half loadHalf(const LightValue* values) {
    const Bytes both = hn::LoadU(kBytes, bytesOf(values));
    return {hn::And(both, hn::Set(kBytes, 0x0F)), hn::And(both, hn::Set(kBytes, 0xF0))};
}

HWY_INLINE void storeHalf(Half half, LightValue* values) {
    hn::StoreU(hn::Or(half.even, half.odd), kBytes, bytesOf(values));
}

HWY_INLINE Half halfOfOnes() {
    return {hn::Set(kBytes, 0x01), hn::Set(kBytes, 0x10)};
}

template <class Function>
HWY_INLINE Half eachOf(Function f, const Half& p, const Half& q) {
    return {f(p.even, q.even), f(p.odd, q.odd)};
}

HWY_INLINE Bytes anyOf(const Half& half) {
    return hn::Or(half.even, half.odd);
}

#endif

}  // namespace HWY_NAMESPACE
}  // namespace terrane::light
HWY_AFTER_NAMESPACE();

#endif

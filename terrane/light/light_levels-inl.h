// Rows of light in SIMD. It is included once for each instruction set by kernels.cpp.
#if defined(TERRANE_LIGHT_LIGHT_LEVELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TERRANE_LIGHT_LIGHT_LEVELS_INL_H
#undef TERRANE_LIGHT_LIGHT_LEVELS_INL_H
#else
#define TERRANE_LIGHT_LIGHT_LEVELS_INL_H
#endif

#include <hwy/highway.h>

#include "terrane/light/half_light_levels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace terrane::light {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

// The levels of a row: a holds x = 0…7, b holds 8…15.
struct LightLevels {
    Half a, b;
};

HWY_INLINE LightLevels loadRow(const LightValue* row) {
    return {loadHalf(row), loadHalf(row + 8)};
}

HWY_INLINE void storeRow(const LightLevels& levels, LightValue* row) {
    storeHalf(levels.a, row);
    storeHalf(levels.b, row + 8);
}

template <class Function>
HWY_INLINE LightLevels each(Function f, const LightLevels& p, const LightLevels& q) {
    return {eachOf(f, p.a, q.a), eachOf(f, p.b, q.b)};
}

HWY_INLINE LightLevels maxOf(const LightLevels& p, const LightLevels& q) {
    return each([](Bytes a, Bytes b) HWY_ATTR { return hn::Max(a, b); }, p, q);
}

HWY_INLINE LightLevels minus(const LightLevels& p, const LightLevels& q) {
    return each([](Bytes a, Bytes b) HWY_ATTR { return hn::SaturatedSub(a, b); }, p, q);
}

// Levels of p where they exceed those of q, else 0.
HWY_INLINE LightLevels whereAbove(const LightLevels& p, const LightLevels& q) {
    return each([](Bytes a, Bytes b) HWY_ATTR { return hn::IfThenElseZero(hn::Gt(a, b), a); }, p, q);
}

HWY_INLINE bool isSame(const LightLevels& p, const LightLevels& q) {
    const LightLevels differences = each([](Bytes a, Bytes b) HWY_ATTR { return hn::Xor(a, b); }, p, q);
    const Bytes any = hn::Or(anyOf(differences.a), anyOf(differences.b));
    return hn::AllTrue(kBytes, hn::Eq(any, hn::Zero(kBytes)));
}

// Returns 1 + opacity. In the high four bits 15 saturates at 255, which darkens 240 as 256 would.
HWY_INLINE LightLevels lossOf(const LightValue* opacity) {
    const LightLevels one = {halfOfOnes(), halfOfOnes()};
    return each([](Bytes a, Bytes b) HWY_ATTR { return hn::SaturatedAdd(a, b); }, loadRow(opacity), one);
}

// Returns the brighter of the voxels at x − 1 and x + 1. `west` ends with the voxel before the row, `east`
// begins with the one after it. Shifts stay in blocks of 16 bytes.
HWY_INLINE LightLevels brighterBeside(const Half& west, const LightLevels& row, const Half& east) {
    const auto before = [](Bytes here, Bytes lower)
                            HWY_ATTR { return hn::CombineShiftRightBytes<14>(kBytes, here, lower); };
    const auto after = [](Bytes here, Bytes upper)
                           HWY_ATTR { return hn::CombineShiftRightBytes<2>(kBytes, upper, here); };
    return maxOf({eachOf(before, row.a, west), eachOf(before, row.b, row.a)},
                 {eachOf(after, row.a, row.b), eachOf(after, row.b, east)});
}

}  // namespace HWY_NAMESPACE
}  // namespace terrane::light
HWY_AFTER_NAMESPACE();

#endif

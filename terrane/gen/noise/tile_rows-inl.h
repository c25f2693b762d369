// Rows of a tile as vectors; all kernels are written with them. It is included once for each instruction set
// by kernels.cpp.
#if defined(TERRANE_GEN_TILE_ROWS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TERRANE_GEN_TILE_ROWS_INL_H
#undef TERRANE_GEN_TILE_ROWS_INL_H
#else
#define TERRANE_GEN_TILE_ROWS_INL_H
#endif

#include <hwy/highway.h>

#include "terrane/gen/cpu/kernels.h"
#include "terrane/shared/det_math.h"

HWY_BEFORE_NAMESPACE();
namespace terrane::gen {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using DI = hn::CappedTag<std::int32_t, kRowLanes>;
using DU = hn::CappedTag<std::uint32_t, kRowLanes>;
using DF = hn::CappedTag<float, kRowLanes>;
using VI = hn::Vec<DI>;
using VU = hn::Vec<DU>;
using VF = hn::Vec<DF>;

constexpr DI di;
constexpr DU du;
constexpr DF df;

// The rows for which instructions run.
struct RowList {
    std::uint8_t rows[kTileSize];
    int count;
};

HWY_INLINE Bits* rowOf(Bits* arena, Operand o, int row) {
    return arena + static_cast<std::size_t>(o.row + o.rowStep * row) * kRowLanes;
}

// An operand's rows in the arena.
struct RowsOf {
    RowsOf(Bits* arena, Operand o)
        : first(arena + std::size_t{o.row} * kRowLanes), stride(std::size_t{o.rowStep} * kRowLanes) {}
    Bits* at(int row, std::size_t lane) const {
        return first + stride * static_cast<std::size_t>(row) + lane;
    }

    Bits* first;
    std::size_t stride;  // lanes from row to row; 0 where all rows are one
};

// Calls f(row, lane) for each vector of the destination's rows: one row where the value is the same in every
// column. All rows are a loop of their own, in which addresses are counted up instead of multiplied.
template <class Function>
HWY_INLINE void forEachVector(const RowList& rows, Operand dst, Function f) {
    const auto eachLane = [&](int row) HWY_ATTR {
        for (std::size_t lane = 0; lane < kRowLanes; lane += hn::Lanes(di)) f(row, lane);
    };
    if (dst.rowStep == 0) {
        eachLane(0);
    } else if (rows.count == kTileSize) {
        for (int row = 0; row < kTileSize; ++row) eachLane(row);
    } else {
        for (int k = 0; k < rows.count; ++k) eachLane(rows.rows[k]);
    }
}

// Does the same for expensive functions, which are inlined only once.
template <class Function>
HWY_INLINE void forEachCostlyVector(const RowList& rows, Operand dst, Function f) {
    const int count = dst.rowStep ? rows.count : 1;
    for (int k = 0; k < count; ++k) {
        const int row = dst.rowStep ? rows.rows[k] : 0;
        for (std::size_t lane = 0; lane < kRowLanes; lane += hn::Lanes(di)) f(row, lane);
    }
}

HWY_INLINE VF loadF(const Bits* p) {
    return hn::BitCast(df, hn::Load(du, p));
}
HWY_INLINE VI loadI(const Bits* p) {
    return hn::BitCast(di, hn::Load(du, p));
}
template <class V>
HWY_INLINE void storeBits(V v, Bits* p) {
    hn::Store(hn::BitCast(du, v), du, p);
}

// Returns a comparison's mask as lanes of 0 or ~0.
template <class D, class M>
HWY_INLINE auto maskBits(D d, M mask) {
    return hn::VecFromMask(d, mask);
}

// Takes the same steps as hash.h.
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

// Takes the same steps as detDivide in det_math.h.
HWY_INLINE VF divide(VF a, VF b) {
    const VF two = hn::Set(df, 2.0f);
    const VU sign = hn::And(hn::BitCast(du, b), hn::Set(du, 0x80000000u));
    const VF magnitude = hn::BitCast(df, hn::Xor(hn::BitCast(du, b), sign));
    const VU guess = hn::Sub(hn::Set(du, shared::kReciprocalMagic), hn::BitCast(du, magnitude));
    VF r = hn::BitCast(df, guess);
    for (int step = 0; step < 3; ++step) r = hn::Mul(r, hn::Sub(two, hn::Mul(magnitude, r)));
    const VF signedA = hn::BitCast(df, hn::Xor(hn::BitCast(du, a), sign));
    const VF q = hn::Mul(signedA, r);
    return hn::Add(q, hn::Mul(r, hn::Sub(signedA, hn::Mul(magnitude, q))));
}

// Takes the same steps as detSqrt in det_math.h.
HWY_INLINE VF squareRoot(VF x) {
    const VF half = hn::Mul(hn::Set(df, 0.5f), x);
    const VF threeHalves = hn::Set(df, 1.5f);
    const VU guess = hn::Sub(hn::Set(du, shared::kInverseRootMagic), hn::ShiftRight<1>(hn::BitCast(du, x)));
    VF r = hn::BitCast(df, guess);
    for (int step = 0; step < 3; ++step) {
        r = hn::Mul(r, hn::Sub(threeHalves, hn::Mul(hn::Mul(half, r), r)));
    }
    const VF s = hn::Mul(x, r);
    return hn::Add(s, hn::Mul(hn::Mul(hn::Set(df, 0.5f), r), hn::Sub(x, hn::Mul(s, s))));
}

// Takes the same steps as detInverseSqrt in det_math.h.
HWY_INLINE VF inverseRoot(VF x) {
    const VF half = hn::Mul(hn::Set(df, 0.5f), x);
    const VF threeHalves = hn::Set(df, 1.5f);
    VF r = hn::BitCast(
        df, hn::Sub(hn::Set(du, shared::kInverseRootMagic), hn::ShiftRight<1>(hn::BitCast(du, x))));
    for (int step = 0; step < 2; ++step) {
        r = hn::Mul(r, hn::Sub(threeHalves, hn::Mul(hn::Mul(half, r), r)));
    }
    return r;
}

}  // namespace HWY_NAMESPACE
}  // namespace terrane::gen
HWY_AFTER_NAMESPACE();
#endif

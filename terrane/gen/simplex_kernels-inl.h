// Simplex noise over rows of a tile. Included once for each instruction set by kernels.cpp.
#if defined(TERRANE_GEN_SIMPLEX_KERNELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TERRANE_GEN_SIMPLEX_KERNELS_INL_H
#undef TERRANE_GEN_SIMPLEX_KERNELS_INL_H
#else
#define TERRANE_GEN_SIMPLEX_KERNELS_INL_H
#endif

#include "terrane/gen/tile_rows-inl.h"
#include "terrane/shared/hash.h"

HWY_BEFORE_NAMESPACE();
namespace terrane::gen {
namespace HWY_NAMESPACE {

HWY_INLINE VU hash2Lanes(VU x, VU y, VU seed) {
    const VU half = mixHalf(hn::Xor(hn::Mul(x, hn::Set(du, shared::kHashX)), seed));
    return mixBits(hn::Xor(half, hn::Mul(y, hn::Set(du, shared::kHashY))));
}

// √2·(cos, sin) of (k + ½)·22.5°, k the upper four bits, times (x, y): the first quadrant's four directions,
// then turned.
HWY_INLINE VF gradientDot(VU hash, VF x, VF y) {
    const auto bit = [&](int n) {
        return hn::RebindMask(df, hn::TestBit(hash, hn::Set(du, 1u << (28 + n))));
    };
    const auto isOdd = bit(0), isUpper = bit(1);
    const auto pick = [&](float a, float b, float c, float d) HWY_ATTR {
        return hn::IfThenElse(isUpper, hn::IfThenElse(isOdd, hn::Set(df, d), hn::Set(df, c)),
                              hn::IfThenElse(isOdd, hn::Set(df, b), hn::Set(df, a)));
    };
    constexpr float kG[] = {1.38703990f, 1.17587554f, 0.785694957f, 0.275899380f};
    const VF gx = pick(kG[0], kG[1], kG[2], kG[3]), gy = pick(kG[3], kG[2], kG[1], kG[0]);
    const auto isTurned = bit(2), isOpposite = bit(3);
    const VF turnedX = hn::IfThenElse(isTurned, hn::Neg(gy), gx), turnedY = hn::IfThenElse(isTurned, gx, gy);
    const VF signedX = hn::IfThenElse(isOpposite, hn::Neg(turnedX), turnedX);
    const VF signedY = hn::IfThenElse(isOpposite, hn::Neg(turnedY), turnedY);
    return hn::Add(hn::Mul(signedX, x), hn::Mul(signedY, y));
}

HWY_INLINE VF simplexCorner(VU hash, VF x, VF y) {
    const VF left = hn::Sub(hn::Set(df, 0.5f), hn::Add(hn::Mul(x, x), hn::Mul(y, y)));
    const VF t = hn::Max(left, hn::Zero(df)), t2 = hn::Mul(t, t);
    return hn::Mul(hn::Mul(t2, t2), gradientDot(hash, x, y));
}

HWY_INLINE VF simplexSample(const Simplex2DTile::Octave& o, int row, std::size_t lane) {
    const auto r = static_cast<std::size_t>(row);
    const VF fx = hn::Load(df, o.x.cells.data() + lane), fy = hn::Set(df, o.y.cells[r]);
    const VF skew = hn::Mul(hn::Add(fx, fy), hn::Set(df, kSimplexSkew));
    const VF i = hn::Floor(hn::Add(fx, skew)), j = hn::Floor(hn::Add(fy, skew));
    const VF unskew = hn::Mul(hn::Add(i, j), hn::Set(df, kSimplexUnskew));
    const VF x0 = hn::Sub(fx, hn::Sub(i, unskew)), y0 = hn::Sub(fy, hn::Sub(j, unskew));
    const VI periodX = hn::Load(di, o.x.period.data() + lane), periodY = hn::Set(di, o.y.period[r]);
    const VI shift = hn::Mul(hn::Add(periodX, periodY), hn::Set(di, kSimplexShift));
    const auto cell = [&](VI period, VF whole) HWY_ATTR {
        const VI before = hn::Add(hn::Mul(period, hn::Set(di, kSimplexPeriod)), shift);
        return hn::BitCast(du, hn::Add(before, hn::ConvertTo(di, whole)));
    };
    const VU cellX = cell(periodX, i), cellY = cell(periodY, j), one = hn::Set(du, 1u),
             seed = hn::Set(du, o.seed);
    const VF oneF = hn::Set(df, 1.0f);
    const auto isRight = hn::Gt(x0, y0);
    const VF rightF = hn::IfThenElseZero(isRight, oneF), upF = hn::Sub(oneF, rightF);
    const VU right = hn::And(hn::BitCast(du, hn::VecFromMask(df, isRight)), one), up = hn::Sub(one, right);
    const auto from = [&](VF offset, VF steps, float unskewed)
                          HWY_ATTR { return hn::Add(hn::Sub(offset, steps), hn::Set(df, unskewed)); };
    const VF first = simplexCorner(hash2Lanes(cellX, cellY, seed), x0, y0);
    const VF second = simplexCorner(hash2Lanes(hn::Add(cellX, right), hn::Add(cellY, up), seed),
                                    from(x0, rightF, kSimplexUnskew), from(y0, upF, kSimplexUnskew));
    const VF third =
        simplexCorner(hash2Lanes(hn::Add(cellX, one), hn::Add(cellY, one), seed),
                      from(x0, oneF, 2.0f * kSimplexUnskew), from(y0, oneF, 2.0f * kSimplexUnskew));
    return hn::Mul(hn::Set(df, kSimplexScale), hn::Add(hn::Add(first, second), third));
}

void simplex2D(const Instruction& i, TileContext& c, const RowList& rows) {
    const auto& octaves = c.simplex2D[i.imm].octaves;
    forEachVector(rows, i.dst, [&](int row, std::size_t lane) HWY_ATTR {
        VF sum = hn::Mul(simplexSample(octaves[0], row, lane), hn::Set(df, octaves[0].weight));
        for (std::size_t o = 1; o < octaves.size(); ++o) {
            sum = hn::Add(sum, hn::Mul(simplexSample(octaves[o], row, lane), hn::Set(df, octaves[o].weight)));
        }
        storeBits(sum, rowOf(c.arena, i.dst, row) + lane);
    });
}

}  // namespace HWY_NAMESPACE
}  // namespace terrane::gen
HWY_AFTER_NAMESPACE();
#endif

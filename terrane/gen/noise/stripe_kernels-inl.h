// Stripes over rows of a tile. It is included once for each instruction set by kernels.cpp.
#if defined(TERRANE_GEN_STRIPE_KERNELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TERRANE_GEN_STRIPE_KERNELS_INL_H
#undef TERRANE_GEN_STRIPE_KERNELS_INL_H
#else
#define TERRANE_GEN_STRIPE_KERNELS_INL_H
#endif

#include "terrane/gen/noise/tile_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace terrane::gen {
namespace HWY_NAMESPACE {

// Returns the sine of `turns` turns.
HWY_INLINE VF stripeWave(VF turns) {
    const VF q = hn::Sub(turns, hn::Floor(hn::Add(turns, hn::Set(df, 0.5f))));
    return hn::Mul(q, hn::Sub(hn::Set(df, 8.0f), hn::Mul(hn::Set(df, 16.0f), hn::Abs(q))));
}

struct StripeSums {
    VF weight, cosine, sine;
};

// Adds the waves of one row of cells, from cell `first` to `last` of the tile, which hold all that reach the
// columns at x.
HWY_INLINE void addStripes(const Stripes2DTile& t, int cellRow, int first, int last, VI x, VF y0, VF dx,
                           VF dy, StripeSums& sums) {
    const VF inverseSize = hn::Set(df, 1.0f / static_cast<float>(t.size)), one = hn::Set(df, 1.0f);
    for (int cell = first; cell <= last; ++cell) {
        const StripePoint& point = t.points[static_cast<std::size_t>(cellRow * t.width + cell)];
        const std::uint32_t corner =
            (t.firstX + static_cast<std::uint32_t>(cell)) * static_cast<std::uint32_t>(t.size);
        const VI blocks = hn::Sub(hn::Set(di, static_cast<std::int32_t>(corner)), x);
        const VF ox = hn::Add(hn::Mul(hn::ConvertTo(df, blocks), inverseSize), hn::Set(df, point.x));
        const VF oy = hn::Add(y0, hn::Set(df, point.y));
        const VF d2 = hn::Add(hn::Mul(ox, ox), hn::Mul(oy, oy));
        const VF t0 = hn::Max(hn::Sub(one, hn::Mul(d2, hn::Set(df, 1.0f / kStripeReach2))), hn::Zero(df));
        const VF weight = hn::Mul(t0, t0);
        const VF along = hn::Add(hn::Mul(ox, dx), hn::Mul(oy, dy));
        const VF turns = hn::Sub(hn::Set(df, point.phase), along);
        sums.weight = hn::Add(sums.weight, weight);
        // Not beyond its reach: there the wave of a huge direction may not be a number.
        const auto reaches = hn::Gt(weight, hn::Zero(df));
        const VF cosine = hn::Mul(weight, stripeWave(hn::Add(turns, hn::Set(df, 0.25f))));
        sums.cosine = hn::Add(sums.cosine, hn::IfThenElseZero(reaches, cosine));
        sums.sine = hn::Add(sums.sine, hn::IfThenElseZero(reaches, hn::Mul(weight, stripeWave(turns))));
    }
}

// Points beyond the 3×3 cells around a column add exactly 0, so that one loop over cells handles all columns
// of a vector.
void stripes2D(const Instruction& i, TileContext& c, const RowList& rows) {
    const Stripes2DTile& t = c.stripes2D[i.imm];
    const RowsOf directionX(c.arena, i.args[0]), directionY(c.arena, i.args[1]);
    const Operand sineRows{static_cast<std::uint16_t>(i.dst.row + kStripeSin * kTileSize), 1};
    const RowsOf cosines(c.arena, i.dst), sines(c.arena, sineRows);
    forEachVector(rows, i.dst, [&](int row, std::size_t lane) HWY_ATTR {
        const auto r = static_cast<std::size_t>(row);
        const VI columns = hn::Iota(di, static_cast<std::int32_t>(lane));
        const VI x = hn::Add(hn::Set(di, t.grid.x), hn::Mul(columns, hn::Set(di, t.grid.step)));
        const std::uint32_t y = static_cast<std::uint32_t>(t.grid.y) +
                                static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(t.grid.step);
        const VF dx = loadF(directionX.at(row, lane)), dy = loadF(directionY.at(row, lane));
        const int first = t.cellX[lane], last = t.cellX[lane + hn::Lanes(di) - 1] + 2;
        StripeSums sums{hn::Zero(df), hn::Zero(df), hn::Zero(df)};
        for (int cellRow = t.cellY[r]; cellRow <= t.cellY[r] + 2; ++cellRow) {
            const std::uint32_t corner =
                (t.firstY + static_cast<std::uint32_t>(cellRow)) * static_cast<std::uint32_t>(t.size);
            const float y0 = static_cast<float>(static_cast<std::int32_t>(corner - y)) *
                             (1.0f / static_cast<float>(t.size));
            addStripes(t, cellRow, first, last, x, hn::Set(df, y0), dx, dy, sums);
        }
        storeBits(divide(sums.cosine, sums.weight), cosines.at(row, lane));
        storeBits(divide(sums.sine, sums.weight), sines.at(row, lane));
    });
}

}  // namespace HWY_NAMESPACE
}  // namespace terrane::gen
HWY_AFTER_NAMESPACE();
#endif

// Simplex noise over rows of a tile. It is included once for each instruction set by kernels.cpp.
#if defined(TERRANE_GEN_SIMPLEX_KERNELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TERRANE_GEN_SIMPLEX_KERNELS_INL_H
#undef TERRANE_GEN_SIMPLEX_KERNELS_INL_H
#else
#define TERRANE_GEN_SIMPLEX_KERNELS_INL_H
#endif

#include "terrane/gen/noise/noise.h"
#include "terrane/gen/noise/tile_rows-inl.h"
#include "terrane/shared/hash.h"

HWY_BEFORE_NAMESPACE();
namespace terrane::gen {
namespace HWY_NAMESPACE {

HWY_INLINE VU hash2Lanes(VU x, VU y, VU seed) {
    const VU half = mixHalf(hn::Xor(hn::Mul(x, hn::Set(du, shared::kHashX)), seed));
    return mixBits(hn::Xor(half, hn::Mul(y, hn::Set(du, shared::kHashY))));
}

struct Gradients {
    VF x, y;
};

// Returns the gradients of hashes. Their upper four bits are the direction k: two of the gradient in the
// first quadrant, two of the quadrant.
HWY_INLINE Gradients gradients(VU hash) {
    const auto bit = [&](int n) {
        return hn::RebindMask(df, hn::TestBit(hash, hn::Set(du, 1u << (28 + n))));
    };
    const auto isOdd = bit(0), isUpper = bit(1);
    const auto pick = [&](float a, float b, float c, float d) HWY_ATTR {
        return hn::IfThenElse(isUpper, hn::IfThenElse(isOdd, hn::Set(df, d), hn::Set(df, c)),
                              hn::IfThenElse(isOdd, hn::Set(df, b), hn::Set(df, a)));
    };
    constexpr auto& g = kQuadrant;
    const VF gx = pick(g[0], g[1], g[2], g[3]), gy = pick(g[3], g[2], g[1], g[0]);
    const auto isTurned = bit(2), isOpposite = bit(3);
    const VF turnedX = hn::IfThenElse(isTurned, hn::Neg(gy), gx), turnedY = hn::IfThenElse(isTurned, gx, gy);
    return {hn::IfThenElse(isOpposite, hn::Neg(turnedX), turnedX),
            hn::IfThenElse(isOpposite, hn::Neg(turnedY), turnedY)};
}

HWY_INLINE VF simplexCorner(const Gradients& g, VF x, VF y) {
    const VF left = hn::Sub(hn::Set(df, 0.5f), hn::Add(hn::Mul(x, x), hn::Mul(y, y)));
    const VF t = hn::Max(left, hn::Zero(df)), t2 = hn::Mul(t, t);
    return hn::Mul(hn::Mul(t2, t2), hn::Add(hn::Mul(g.x, x), hn::Mul(g.y, y)));
}

HWY_INLINE Gradients gradientsAt(VU x, VU y, VU seed) {
    return gradients(hash2Lanes(x, y, seed));
}

HWY_INLINE Gradients choose(hn::Mask<DF> first, const Gradients& a, const Gradients& b) {
    return {hn::IfThenElse(first, a.x, b.x), hn::IfThenElse(first, a.y, b.y)};
}

// Position of a row of columns in the lattice.
struct SimplexCells {
    VF x0, y0;  // from the cell's corner
    VU x, y;    // cells, modulo 2^32
};

HWY_INLINE SimplexCells simplexCells(const Simplex2DTile::Octave& o, std::size_t row, std::size_t lane) {
    const VF fx = hn::Load(df, o.x.cells.data() + lane), fy = hn::Set(df, o.y.cells[row]);
    const VF skew = hn::Mul(hn::Add(fx, fy), hn::Set(df, kSimplexSkew));
    const VF i = hn::Floor(hn::Add(fx, skew)), j = hn::Floor(hn::Add(fy, skew));
    const VF unskew = hn::Mul(hn::Add(i, j), hn::Set(df, kSimplexUnskew));
    const VI periodX = hn::Load(di, o.x.period.data() + lane), periodY = hn::Set(di, o.y.period[row]);
    const VI shift = hn::Mul(hn::Add(periodX, periodY), hn::Set(di, kSimplexShift));
    const auto cell = [&](VI period, VF whole) HWY_ATTR {
        const VI before = hn::Add(hn::Mul(period, hn::Set(di, kSimplexPeriod)), shift);
        return hn::BitCast(du, hn::Add(before, hn::ConvertTo(di, whole)));
    };
    return {hn::Sub(fx, hn::Sub(i, unskew)), hn::Sub(fy, hn::Sub(j, unskew)), cell(periodX, i),
            cell(periodY, j)};
}

// The gradients at the corners of a cell: its own, those to its right and above, and the opposite one.
struct SimplexCorners {
    Gradients own, right, up, opposite;
};

HWY_INLINE SimplexCorners simplexCorners(VU x, VU y, VU seed) {
    const VU one = hn::Set(du, 1u), x1 = hn::Add(x, one), y1 = hn::Add(y, one);
    return {gradientsAt(x, y, seed), gradientsAt(x1, y, seed), gradientsAt(x, y1, seed),
            gradientsAt(x1, y1, seed)};
}

HWY_INLINE VF simplexSum(const SimplexCells& cells, hn::Mask<DF> isRight, const Gradients& own,
                         const Gradients& middle, const Gradients& opposite) {
    const VF one = hn::Set(df, 1.0f), right = hn::IfThenElseZero(isRight, one), up = hn::Sub(one, right);
    const auto from = [&](VF offset, VF steps, float unskewed)
                          HWY_ATTR { return hn::Add(hn::Sub(offset, steps), hn::Set(df, unskewed)); };
    const VF first = simplexCorner(own, cells.x0, cells.y0);
    const VF second =
        simplexCorner(middle, from(cells.x0, right, kSimplexUnskew), from(cells.y0, up, kSimplexUnskew));
    const VF third = simplexCorner(opposite, from(cells.x0, one, 2.0f * kSimplexUnskew),
                                   from(cells.y0, one, 2.0f * kSimplexUnskew));
    return hn::Mul(hn::Set(df, kSimplexScale), hn::Add(hn::Add(first, second), third));
}

// Calls write(row, lane, value) for each vector. Wide cells hold whole rows: the gradients of such a cell are
// computed once for all of its rows.
template <class Write>
HWY_INLINE void simplexOctave(const Simplex2DTile::Octave& o, const RowList& rows, Operand dst, Write write) {
    const VU seed = hn::Set(du, o.seed);
    std::uint32_t knownX = 0, knownY = 0;
    bool isKnown = false;
    SimplexCorners corners{};
    forEachVector(rows, dst, [&](int row, std::size_t lane) HWY_ATTR {
        const SimplexCells cells = simplexCells(o, static_cast<std::size_t>(row), lane);
        const auto isRight = hn::Gt(cells.x0, cells.y0);
        const std::uint32_t x = hn::GetLane(cells.x), y = hn::GetLane(cells.y);
        const bool isOneCell =
            hn::AllTrue(du, hn::And(hn::Eq(cells.x, hn::Set(du, x)), hn::Eq(cells.y, hn::Set(du, y))));
        if (isOneCell) {
            if (!isKnown || x != knownX || y != knownY) corners = simplexCorners(cells.x, cells.y, seed);
            isKnown = true;
            knownX = x;
            knownY = y;
            const Gradients middle = choose(isRight, corners.right, corners.up);
            return write(row, lane, simplexSum(cells, isRight, corners.own, middle, corners.opposite));
        }
        const VU one = hn::Set(du, 1u);
        const VU right = hn::IfThenElseZero(hn::RebindMask(du, isRight), one), up = hn::Sub(one, right);
        write(row, lane,
              simplexSum(cells, isRight, gradientsAt(cells.x, cells.y, seed),
                         gradientsAt(hn::Add(cells.x, right), hn::Add(cells.y, up), seed),
                         gradientsAt(hn::Add(cells.x, one), hn::Add(cells.y, one), seed)));
    });
}

void simplex2D(const Instruction& i, TileContext& c, const RowList& rows) {
    const auto& octaves = c.simplex2D[i.imm].octaves;
    const RowsOf out(c.arena, i.dst);
    for (std::size_t n = 0; n < octaves.size(); ++n) {
        const VF weight = hn::Set(df, octaves[n].weight);
        simplexOctave(octaves[n], rows, i.dst, [&](int row, std::size_t lane, VF noise) HWY_ATTR {
            const VF term = hn::Mul(noise, weight);
            Bits* const sum = out.at(row, lane);
            storeBits(n == 0 ? term : hn::Add(loadF(sum), term), sum);
        });
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace terrane::gen
HWY_AFTER_NAMESPACE();
#endif

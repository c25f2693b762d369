#include "terrane/gen/noise/lattice_kernels.h"

#include <cassert>

#include "terrane/gen/noise/noise.h"
#include "terrane/shared/hash.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "terrane/gen/noise/lattice_kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "terrane/gen/noise/tile_rows-inl.h"

#ifndef TERRANE_GEN_LATTICE_GRADIENTS
#define TERRANE_GEN_LATTICE_GRADIENTS
namespace terrane::gen {
namespace {

constexpr float kG0 = kQuadrant[0], kG1 = kQuadrant[1], kG2 = kQuadrant[2], kG3 = kQuadrant[3];
alignas(64) constexpr float kGradient2X[16] = {kG0,  kG1,  kG2,  kG3,  -kG3, -kG2, -kG1, -kG0,
                                               -kG0, -kG1, -kG2, -kG3, kG3,  kG2,  kG1,  kG0};
alignas(64) constexpr float kGradient2Y[16] = {kG3,  kG2,  kG1,  kG0,  kG0,  kG1,  kG2,  kG3,
                                               -kG3, -kG2, -kG1, -kG0, -kG0, -kG1, -kG2, -kG3};

// To the 12 edges of a cube; the rest fills a vector.
alignas(64) constexpr float kGradient3X[16] = {1, -1, 1, -1, 1, -1, 1, -1, 0, 0, 0, 0};
alignas(64) constexpr float kGradient3Y[16] = {1, 1, -1, -1, 0, 0, 0, 0, 1, -1, 1, -1};
alignas(64) constexpr float kGradient3Z[16] = {0, 0, 0, 0, 1, 1, -1, -1, 1, 1, -1, -1};

}  // namespace
}  // namespace terrane::gen
#endif

HWY_BEFORE_NAMESPACE();
namespace terrane::gen {
namespace HWY_NAMESPACE {

// A vector for the gradients of up to 16 nodes and for all columns: with AVX-512 tables are looked up in
// registers.
constexpr bool kHasWholeRows = HWY_MAX_BYTES >= 64;

HWY_INLINE VF lookUp(const float* table, VI index) {
    return hn::TableLookupLanes(hn::Load(df, table), hn::IndicesFromVec(df, index));
}
HWY_INLINE VF lookUp(VF table, VI index) {
    return hn::TableLookupLanes(table, hn::IndicesFromVec(df, index));
}

// blend(left node's value, right node's value) of each column.
struct Columns {
    VI left, right;  // nodes, from the first
    VF offset, offset1, fade;

    HWY_INLINE VF blend(VF nodes) const {
        const VF a = lookUp(nodes, left), b = lookUp(nodes, right);
        return hn::Add(a, hn::Mul(fade, hn::Sub(b, a)));
    }
    HWY_INLINE VF blendAlong(VF nodes) const {
        const VF a = hn::Mul(lookUp(nodes, left), offset), b = hn::Mul(lookUp(nodes, right), offset1);
        return hn::Add(a, hn::Mul(fade, hn::Sub(b, a)));
    }
};

HWY_INLINE Columns columnsOf(const AxisCells& x) {
    const VU cell = hn::LoadU(du, x.cell.data());
    const VI left = hn::BitCast(di, hn::Sub(cell, hn::Set(du, x.cell[0])));
    const VF offset = hn::LoadU(df, x.offset.data());
    return {left, hn::Add(left, hn::Set(di, 1)), offset, hn::Sub(offset, hn::Set(df, 1.0f)),
            hn::LoadU(df, x.fadeOf.data())};
}

HWY_INLINE bool fits(const AxisCells& x) {
    return kHasWholeRows && hn::Lanes(df) == kTileSize && x.cell[kTileSize - 1] - x.cell[0] + 2 <= kTileSize;
}

HWY_INLINE VU nodeHash(const AxisCells& x, std::uint32_t seed) {
    const VU nodes = hn::Add(hn::Iota(du, 0), hn::Set(du, x.cell[0]));
    return hn::Xor(hn::Set(du, seed), hn::Mul(nodes, hn::Set(du, shared::kHashX)));
}

// `rest`: blocks from the start of `cell` to the first column.
void cellsAlong(std::int32_t rest, std::uint32_t cell, std::int32_t step, std::int32_t size,
                AxisCells& axis) {
    const VF inverse = hn::Set(df, 1.0f / static_cast<float>(size));
    const VI blocks = hn::Set(di, size), one = hn::Set(di, 1);
    for (std::size_t lane = 0; lane < kRowLanes; lane += hn::Lanes(di)) {
        const VI index = hn::Iota(di, static_cast<std::int32_t>(lane));
        const VI at = hn::Add(hn::Mul(index, hn::Set(di, step)), hn::Set(di, rest));
        // At most 17 · 65,536 blocks: the rounded quotient is the right one or one beside it.
        VI cells = hn::ConvertTo(di, hn::Mul(hn::ConvertTo(df, at), inverse));
        cells = hn::Sub(cells, hn::IfThenElseZero(hn::Lt(at, hn::Mul(cells, blocks)), one));
        VI inside = hn::Sub(at, hn::Mul(cells, blocks));
        const auto isBeyond = hn::Not(hn::Lt(inside, blocks));
        cells = hn::Add(cells, hn::IfThenElseZero(isBeyond, one));
        inside = hn::Sub(inside, hn::IfThenElseZero(isBeyond, blocks));
        const VF f = hn::Mul(hn::ConvertTo(df, inside), inverse);
        // f³(f(6f − 15) + 10)
        const VF cube = hn::Mul(hn::Mul(f, f), f);
        const VF square = hn::Add(hn::Mul(f, hn::Sub(hn::Mul(f, hn::Set(df, 6.0f)), hn::Set(df, 15.0f))),
                                  hn::Set(df, 10.0f));
        hn::StoreU(hn::Add(hn::BitCast(du, cells), hn::Set(du, cell)), du, axis.cell.data() + lane);
        hn::StoreU(f, df, axis.offset.data() + lane);
        hn::StoreU(hn::Mul(cube, square), df, axis.fadeOf.data() + lane);
    }
}

// Returns false if the gradients do not fit into a vector.
bool nodeRow2D(const AxisCells& x, std::uint32_t y, std::uint32_t seed, float* one, float* yFactor) {
    if (!fits(x)) return false;
    const VU h = mixBits(hn::Xor(mixHalf(nodeHash(x, seed)), hn::Set(du, y * shared::kHashY)));
    const VI kind = hn::BitCast(di, hn::ShiftRight<28>(h));
    const Columns columns = columnsOf(x);
    hn::Store(columns.blendAlong(lookUp(kGradient2X, kind)), df, one);
    hn::Store(columns.blend(lookUp(kGradient2Y, kind)), df, yFactor);
    return true;
}

bool nodeRow3D(const AxisCells& x, std::array<std::uint32_t, 2> yz, std::uint32_t seed, NodeRow3D row) {
    if (!fits(x)) return false;
    VU h = hn::Xor(mixHalf(nodeHash(x, seed)), hn::Set(du, yz[0] * shared::kHashY));
    h = mixBits(hn::Xor(mixHalf(h), hn::Set(du, yz[1] * shared::kHashZ)));
    const VU kinds = hn::ShiftRight<16>(hn::Mul(hn::ShiftRight<16>(h), hn::Set(du, 12)));
    const VI kind = hn::BitCast(di, kinds);
    const Columns columns = columnsOf(x);
    hn::Store(columns.blendAlong(lookUp(kGradient3X, kind)), df, row.one.data());
    hn::Store(columns.blend(lookUp(kGradient3Y, kind)), df, row.y.data());
    hn::Store(columns.blend(lookUp(kGradient3Z, kind)), df, row.z.data());
    return true;
}

}  // namespace HWY_NAMESPACE
}  // namespace terrane::gen
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace terrane::gen {

HWY_EXPORT(cellsAlong);
HWY_EXPORT(nodeRow2D);
HWY_EXPORT(nodeRow3D);

namespace {

float lerp(float a, float b, float t) {
    return a + t * (b - a);
}

// Calls lookup(node) once per node, and useAt(column, result of the node to its left, to its right).
template <class Lookup, class Use>
void forEachX(const std::array<std::uint32_t, kTileSize>& cells, Lookup lookup, Use useAt) {
    std::uint32_t left = lookup(cells[0]);
    std::uint32_t right = lookup(cells[0] + 1);
    for (std::size_t k = 0; k < kTileSize; ++k) {
        if (k > 0 && cells[k] != cells[k - 1]) {
            left = right;
            right = lookup(cells[k] + 1);
        }
        useAt(k, left, right);
    }
}

}  // namespace

AxisCells axisCells(std::int32_t first, std::int32_t step, std::int32_t size) {
    assert(size >= step && "from one column to the next at most one cell ends");
    // The start of a cell may lie before the first block of the world: no int32 holds it.
    const std::int32_t quotient = first / size, rest = first % size;
    const bool isBelow = rest < 0;
    AxisCells axis;
    HWY_DYNAMIC_DISPATCH(cellsAlong)
    (isBelow ? rest + size : rest, static_cast<std::uint32_t>(quotient) - (isBelow ? 1u : 0u), step, size,
     axis);
    return axis;
}

void fillNodeRow2D(const AxisCells& x, std::uint32_t y, std::uint32_t seed, TileRow& one, TileRow& yFactor) {
    if (HWY_DYNAMIC_DISPATCH(nodeRow2D)(x, y, seed, one.data(), yFactor.data())) return;
    const auto lookup = [&](std::uint32_t cell) { return shared::hash2(cell, y, seed) >> 28; };
    forEachX(x.cell, lookup, [&](std::size_t k, std::uint32_t left, std::uint32_t right) {
        const float f = x.offset[k], t = x.fadeOf[k];
        one[k] = lerp(kGradient2X[left] * f, kGradient2X[right] * (f - 1.0f), t);
        yFactor[k] = lerp(kGradient2Y[left], kGradient2Y[right], t);
    });
}

void fillNodeRow3D(const AxisCells& x, std::array<std::uint32_t, 2> yz, std::uint32_t seed, NodeRow3D row) {
    if (HWY_DYNAMIC_DISPATCH(nodeRow3D)(x, yz, seed, row)) return;
    const auto lookup = [&](std::uint32_t cell) {
        return ((shared::hash3(cell, yz[0], yz[1], seed) >> 16) * 12u) >> 16;
    };
    forEachX(x.cell, lookup, [&](std::size_t k, std::uint32_t left, std::uint32_t right) {
        const float f = x.offset[k], t = x.fadeOf[k];
        row.one[k] = lerp(kGradient3X[left] * f, kGradient3X[right] * (f - 1.0f), t);
        row.y[k] = lerp(kGradient3Y[left], kGradient3Y[right], t);
        row.z[k] = lerp(kGradient3Z[left], kGradient3Z[right], t);
    });
}

}  // namespace terrane::gen
#endif

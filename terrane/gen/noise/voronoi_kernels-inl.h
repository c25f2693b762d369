// Cells of random points over rows of a tile. It is included once for each instruction set by kernels.cpp.
#if defined(TERRANE_GEN_VORONOI_KERNELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TERRANE_GEN_VORONOI_KERNELS_INL_H
#undef TERRANE_GEN_VORONOI_KERNELS_INL_H
#else
#define TERRANE_GEN_VORONOI_KERNELS_INL_H
#endif

#include <cstdlib>
#include <limits>

#include "terrane/gen/noise/tile_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace terrane::gen {
namespace HWY_NAMESPACE {

// Offsets of more than this are not those of the two nearest points (1.81 cells), and the squares of two make
// 31 bits.
constexpr std::int32_t kMaxReach = 2 * kMaxVoronoiSize - 1;

// kIsFar: columns lie so far apart that most points of the tile are far from most of them.
template <bool kIsFar>
HWY_INLINE void voronoi2DColumns(const Instruction& i, TileContext& c, const RowList& rows) {
    const Voronoi2DTile& tile = c.voronoi2D[i.imm];
    const std::int32_t step = kIsFar ? tile.step : 1, reach = 2 * tile.size;
    const auto result = [&](std::uint32_t number, int row, std::size_t lane) {
        const Operand o{static_cast<std::uint16_t>(i.dst.row + number * kTileSize), 1};
        return rowOf(c.arena, o, row) + lane;
    };
    forEachCostlyVector(rows, i.dst, [&](int row, std::size_t lane) {
        const std::int32_t firstX = static_cast<std::int32_t>(lane) * step, rowY = row * step;
        const std::int32_t lastX = firstX + (static_cast<std::int32_t>(hn::Lanes(di)) - 1) * step;
        VI x = hn::Iota(di, static_cast<std::int32_t>(lane));
        if constexpr (kIsFar) x = hn::Mul(x, hn::Set(di, step));
        VI best = hn::Set(di, 0x7FFFFFFF), second = best, offsetX = hn::Zero(di), offsetY = offsetX;
        for (const VoronoiPoint p : tile.points) {
            VI dx = hn::Sub(hn::Set(di, p.x), x);
            const VI dy = hn::Set(di, p.y - rowY);
            if constexpr (kIsFar) {
                if (std::abs(p.y - rowY) > reach || p.x < firstX - reach || p.x > lastX + reach) continue;
                dx = hn::Max(hn::Min(dx, hn::Set(di, kMaxReach)), hn::Set(di, -kMaxReach));
            }
            const VI d = hn::Add(hn::Mul(dx, dx), hn::Mul(dy, dy));
            const auto nearer = hn::Lt(d, best);
            second = hn::IfThenElse(nearer, best, hn::Min(second, d));
            best = hn::IfThenElse(nearer, d, best);
            offsetX = hn::IfThenElse(nearer, dx, offsetX);
            offsetY = hn::IfThenElse(nearer, dy, offsetY);
        }
        const VF distance = squareRoot(hn::ConvertTo(df, best));
        const VF secondDistance = squareRoot(hn::ConvertTo(df, hn::Max(second, hn::Set(di, 1))));
        storeBits(distance, result(kVoronoiDistance, row, lane));
        storeBits(divide(distance, secondDistance), result(kVoronoiRatio, row, lane));
        storeBits(offsetX, result(kVoronoiOffsetX, row, lane));
        storeBits(offsetY, result(kVoronoiOffsetY, row, lane));
    });
}

void voronoi2D(const Instruction& i, TileContext& c, const RowList& rows) {
    if (c.voronoi2D[i.imm].step == 1) return voronoi2DColumns<false>(i, c, rows);
    voronoi2DColumns<true>(i, c, rows);
}

void voronoi3D(const Instruction& i, TileContext& c, const RowList& rows) {
    Voronoi3DTile& tile = c.voronoi3D[i.imm];
    if (tile.layer != c.z) moveToLayer(tile, c.z);
    const VF inverseSize = hn::Set(df, 1.0f / static_cast<float>(tile.call.size));
    // Points in cells beyond the search count for no column of the row.
    const std::int32_t step = tile.grid.step, reach = 3 * tile.call.size;
    const auto power = [&](VI blocks) HWY_ATTR {
        const VF d = hn::Mul(hn::ConvertTo(df, hn::Abs(blocks)), inverseSize);
        VF result = d;
        for (int k = 1; k < tile.call.exponent; ++k) result = hn::Mul(result, d);
        return result;
    };
    const auto result = [&](std::uint32_t number, int row, std::size_t lane) {
        const Operand o{static_cast<std::uint16_t>(i.dst.row + number * kTileSize), 1};
        return rowOf(c.arena, o, row) + lane;
    };
    forEachCostlyVector(rows, i.dst, [&](int row, std::size_t lane) HWY_ATTR {
        const VI x = hn::Mul(hn::Iota(di, static_cast<std::int32_t>(lane)), hn::Set(di, step));
        const std::int32_t rowY = row * step;
        VF best = hn::Set(df, std::numeric_limits<float>::max()), second = best;
        VI offsetX = hn::Zero(di), offsetY = offsetX, offsetZ = offsetX;
        for (const Voronoi3DPoint p : tile.points) {
            if (std::abs(p.y - rowY) > reach) continue;
            const VI dx = hn::Sub(hn::Set(di, p.x), x), dy = hn::Set(di, p.y - rowY);
            const VI dz = hn::Set(di, p.z - c.z);
            const VF d = hn::Add(hn::Add(power(dx), power(dy)), power(dz));
            const auto nearer = hn::Lt(d, best);
            const auto nearerI = hn::RebindMask(di, nearer);
            second = hn::IfThenElse(nearer, best, hn::IfThenElse(hn::Lt(d, second), d, second));
            best = hn::IfThenElse(nearer, d, best);
            offsetX = hn::IfThenElse(nearerI, dx, offsetX);
            offsetY = hn::IfThenElse(nearerI, dy, offsetY);
            offsetZ = hn::IfThenElse(nearerI, dz, offsetZ);
        }
        storeBits(best, result(kVoronoi3DNearest, row, lane));
        storeBits(second, result(kVoronoi3DSecond, row, lane));
        storeBits(offsetX, result(kVoronoi3DOffsetX, row, lane));
        storeBits(offsetY, result(kVoronoi3DOffsetY, row, lane));
        storeBits(offsetZ, result(kVoronoi3DOffsetZ, row, lane));
    });
}

}  // namespace HWY_NAMESPACE
}  // namespace terrane::gen
HWY_AFTER_NAMESPACE();
#endif

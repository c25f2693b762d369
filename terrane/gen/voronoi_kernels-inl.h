// Cells of random points over rows of a tile. Included once for each instruction set by kernels.cpp.
#if defined(TERRANE_GEN_VORONOI_KERNELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TERRANE_GEN_VORONOI_KERNELS_INL_H
#undef TERRANE_GEN_VORONOI_KERNELS_INL_H
#else
#define TERRANE_GEN_VORONOI_KERNELS_INL_H
#endif

#include <limits>

#include "terrane/gen/tile_rows-inl.h"

HWY_BEFORE_NAMESPACE();
namespace terrane::gen {
namespace HWY_NAMESPACE {

void voronoi2D(const Instruction& i, TileContext& c, const RowList& rows) {
    const auto& points = c.voronoi2D[i.imm];
    const auto result = [&](std::uint32_t number, int row, std::size_t lane) {
        const Operand o{static_cast<std::uint16_t>(i.dst.row + number * kTileSize), 1};
        return rowOf(c.arena, o, row) + lane;
    };
    forEachVector(rows, i.dst, [&](int row, std::size_t lane) {
        const VI x = hn::Iota(di, static_cast<std::int32_t>(lane)), y = hn::Set(di, row);
        VI best = hn::Set(di, 0x7FFFFFFF), second = best, offsetX = hn::Zero(di), offsetY = offsetX;
        for (const VoronoiPoint p : points) {
            const VI dx = hn::Sub(hn::Set(di, p.x), x), dy = hn::Sub(hn::Set(di, p.y), y);
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

void voronoi3D(const Instruction& i, TileContext& c, const RowList& rows) {
    Voronoi3DTile& tile = c.voronoi3D[i.imm];
    if (tile.layer != c.z) moveToLayer(tile, c.z);
    const VF inverseSize = hn::Set(df, 1.0f / static_cast<float>(tile.call.size));
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
    forEachVector(rows, i.dst, [&](int row, std::size_t lane) HWY_ATTR {
        const VI x = hn::Iota(di, static_cast<std::int32_t>(lane)), y = hn::Set(di, row);
        VF best = hn::Set(df, std::numeric_limits<float>::max()), second = best;
        VI offsetX = hn::Zero(di), offsetY = offsetX, offsetZ = offsetX;
        for (const Voronoi3DPoint p : tile.points) {
            const VI dx = hn::Sub(hn::Set(di, p.x), x), dy = hn::Sub(hn::Set(di, p.y), y);
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

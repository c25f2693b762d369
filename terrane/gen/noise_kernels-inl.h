// Noise and random numbers over rows of a tile. Included once for each instruction set by kernels.cpp.
#if defined(TERRANE_GEN_NOISE_KERNELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TERRANE_GEN_NOISE_KERNELS_INL_H
#undef TERRANE_GEN_NOISE_KERNELS_INL_H
#else
#define TERRANE_GEN_NOISE_KERNELS_INL_H
#endif

#include <limits>

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

// shared::hash2 or hash3 of the arguments.
void hash(const Instruction& i, TileContext& c, const RowList& rows) {
    constexpr std::uint32_t kFactors[] = {shared::kHashX, shared::kHashY, shared::kHashZ};
    const std::size_t argCount = i.op == Op::Hash2 ? 2 : 3;
    const VU seed = hn::Set(du, c.hashSeeds[hashSlot(i.imm)] + octaveSeedStep(hashOctave(i.imm)));
    forEachVector(rows, i.dst, [&](int row, std::size_t lane) {
        VU h = seed;
        for (std::size_t k = 0; k < argCount; ++k) {
            const VU v = hn::Load(du, rowOf(c.arena, i.args[k], row) + lane);
            if (k > 0) h = mixHalf(h);
            h = hn::Xor(h, hn::Mul(v, hn::Set(du, kFactors[k])));
        }
        storeBits(mixBits(h), rowOf(c.arena, i.dst, row) + lane);
    });
}

HWY_INLINE VF perlinSample(const PerlinOctave& o, int row, std::size_t lane) {
    const auto r = static_cast<std::size_t>(row);
    const std::size_t j = o.rows.node[r];
    const VF f = hn::Set(df, o.rows.offset[r]), f1 = hn::Set(df, o.rows.offset[r] - 1.0f);
    const VF low =
        hn::Add(hn::Load(df, o.a[j].data() + lane), hn::Mul(hn::Load(df, o.b[j].data() + lane), f));
    const VF high =
        hn::Add(hn::Load(df, o.a[j + 1].data() + lane), hn::Mul(hn::Load(df, o.b[j + 1].data() + lane), f1));
    return hn::Add(low, hn::Mul(hn::Set(df, o.rows.fade[r]), hn::Sub(high, low)));
}

void perlin2D(const Instruction& i, TileContext& c, const RowList& rows) {
    const auto& octaves = c.perlin2D[i.imm].octaves;
    forEachVector(rows, i.dst, [&](int row, std::size_t lane) {
        VF sum = hn::Mul(perlinSample(octaves[0], row, lane), hn::Set(df, octaves[0].weight));
        for (std::size_t o = 1; o < octaves.size(); ++o) {
            sum = hn::Add(sum, hn::Mul(perlinSample(octaves[o], row, lane), hn::Set(df, octaves[o].weight)));
        }
        storeBits(sum, rowOf(c.arena, i.dst, row) + lane);
    });
}

void perlin3D(const Instruction& i, TileContext& c, const RowList& rows) {
    Perlin3DTile& tile = c.perlin3D[i.imm];
    if (tile.layer != c.z) moveToLayer(tile, c.z);
    forEachVector(rows, i.dst, [&](int row, std::size_t lane) {
        const PerlinOctave& first = tile.octaves[0].layer;
        VF sum = hn::Mul(perlinSample(first, row, lane), hn::Set(df, first.weight));
        for (std::size_t n = 1; n < tile.octaves.size(); ++n) {
            const PerlinOctave& o = tile.octaves[n].layer;
            sum = hn::Add(sum, hn::Mul(perlinSample(o, row, lane), hn::Set(df, o.weight)));
        }
        storeBits(sum, rowOf(c.arena, i.dst, row) + lane);
    });
}

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

void noise(const Instruction& i, TileContext& c, const RowList& rows) {
    switch (c.noiseKinds[i.imm]) {
        case NoiseKind::Perlin2D:
            return perlin2D(i, c, rows);
        case NoiseKind::Perlin3D:
            return perlin3D(i, c, rows);
        case NoiseKind::Voronoi2D:
            return voronoi2D(i, c, rows);
        case NoiseKind::Voronoi3D:
            return voronoi3D(i, c, rows);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace terrane::gen
HWY_AFTER_NAMESPACE();
#endif

// Noise and random numbers over rows of a tile. It is included once for each instruction set by kernels.cpp.
#if defined(TERRANE_GEN_NOISE_KERNELS_INL_H) == defined(HWY_TARGET_TOGGLE)
#ifdef TERRANE_GEN_NOISE_KERNELS_INL_H
#undef TERRANE_GEN_NOISE_KERNELS_INL_H
#else
#define TERRANE_GEN_NOISE_KERNELS_INL_H
#endif

#include "terrane/gen/drainage/drainage_kernels-inl.h"
#include "terrane/gen/noise/simplex_kernels-inl.h"
#include "terrane/gen/noise/stripe_kernels-inl.h"
#include "terrane/gen/noise/voronoi_kernels-inl.h"

HWY_BEFORE_NAMESPACE();
namespace terrane::gen {
namespace HWY_NAMESPACE {

// Computes shared::hash2 or hash3 of the arguments.
void hash(const Instruction& i, TileContext& c, const RowList& rows) {
    constexpr std::uint32_t kFactors[] = {shared::kHashX, shared::kHashY, shared::kHashZ};
    const std::size_t argCount = i.op == Op::Hash2 ? 2 : 3;
    const VU seed = hn::Set(du, c.hashSeeds[hashSlot(i.imm)] + octaveSeedStep(hashOctave(i.imm)));
    forEachCostlyVector(rows, i.dst, [&](int row, std::size_t lane) {
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
    forEachCostlyVector(rows, i.dst, [&](int row, std::size_t lane) {
        VF sum = hn::Mul(perlinSample(octaves[0], row, lane), hn::Set(df, octaves[0].weight));
        for (std::size_t o = 1; o < octaves.size(); ++o) {
            sum = hn::Add(sum, hn::Mul(perlinSample(octaves[o], row, lane), hn::Set(df, octaves[o].weight)));
        }
        storeBits(sum, rowOf(c.arena, i.dst, row) + lane);
    });
}

HWY_INLINE VF lerp(VF a, VF b, VF t) {
    return hn::Add(a, hn::Mul(t, hn::Sub(b, a)));
}

// Makes the octave's levels into one for its layer, as noise.h has it.
void blendLevels(Perlin3DTile::Octave& o) {
    const PerlinLevel &low = o.levels[o.low], &high = o.levels[1 - o.low];
    const VF f = hn::Set(df, o.zOffset), f1 = hn::Set(df, o.zOffset - 1.0f), t = hn::Set(df, o.zFade);
    for (std::size_t j = 0; j < static_cast<std::size_t>(o.layer.nodeRows); ++j) {
        for (std::size_t lane = 0; lane < kRowLanes; lane += hn::Lanes(df)) {
            const auto load = [&](const std::array<TileRow, kMaxNodeRows>& rows)
                                  HWY_ATTR { return hn::Load(df, rows[j].data() + lane); };
            const VF below = hn::Add(load(low.one), hn::Mul(load(low.z), f));
            const VF above = hn::Add(load(high.one), hn::Mul(load(high.z), f1));
            hn::Store(lerp(below, above, t), df, o.layer.a[j].data() + lane);
            hn::Store(lerp(load(low.y), load(high.y), t), df, o.layer.b[j].data() + lane);
        }
    }
}

// Adds an octave. Rows between the same two node rows share their coefficients.
template <bool kIsFirst>
void addOctave(const PerlinOctave& o, Operand dst, TileContext& c, const RowList& rows) {
    const VF weight = hn::Set(df, o.weight), one = hn::Set(df, 1.0f);
    for (std::size_t lane = 0; lane < kRowLanes; lane += hn::Lanes(df)) {
        std::size_t node = kMaxNodeRows;
        VF a0 = weight, b0 = weight, a1 = weight, b1 = weight;
        for (int k = 0; k < rows.count; ++k) {
            const std::size_t r = rows.rows[k];
            if (o.rows.node[r] != node) {
                node = o.rows.node[r];
                a0 = hn::Load(df, o.a[node].data() + lane), b0 = hn::Load(df, o.b[node].data() + lane);
                a1 = hn::Load(df, o.a[node + 1].data() + lane),
                b1 = hn::Load(df, o.b[node + 1].data() + lane);
            }
            const VF f = hn::Set(df, o.rows.offset[r]);
            const VF low = hn::Add(a0, hn::Mul(b0, f)), high = hn::Add(a1, hn::Mul(b1, hn::Sub(f, one)));
            const VF value =
                hn::Mul(hn::Add(low, hn::Mul(hn::Set(df, o.rows.fade[r]), hn::Sub(high, low))), weight);
            Bits* sum = rowOf(c.arena, dst, rows.rows[k]) + lane;
            storeBits(kIsFirst ? value : hn::Add(loadF(sum), value), sum);
        }
    }
}

void perlin3D(const Instruction& i, TileContext& c, const RowList& rows) {
    Perlin3DTile& tile = c.perlin3D[i.imm];
    if (tile.layer != c.z) {
        moveToCellsOf(tile, c.z);
        for (Perlin3DTile::Octave& o : tile.octaves) blendLevels(o);
    }
    for (std::size_t n = 0; n < tile.octaves.size(); ++n) {
        const PerlinOctave& o = tile.octaves[n].layer;
        if (n == 0) {
            addOctave<true>(o, i.dst, c, rows);
        } else {
            addOctave<false>(o, i.dst, c, rows);
        }
    }
}

void noise(const Instruction& i, TileContext& c, const RowList& rows) {
    if (!c.isPrepared[i.imm]) {
        c.prepareNoise(i.imm);
        c.isPrepared[i.imm] = 1;
    }
    switch (c.noiseKinds[i.imm]) {
        case NoiseKind::Perlin2D:
            return perlin2D(i, c, rows);
        case NoiseKind::Perlin3D:
            return perlin3D(i, c, rows);
        case NoiseKind::Voronoi2D:
            return voronoi2D(i, c, rows);
        case NoiseKind::Voronoi3D:
            return voronoi3D(i, c, rows);
        case NoiseKind::Simplex2D:
            return simplex2D(i, c, rows);
        case NoiseKind::Stripes2D:
            return stripes2D(i, c, rows);
        case NoiseKind::Drainage:
            return drainage(i, c, rows);
        case NoiseKind::Valleys:
            return valleys(i, c, rows);
    }
}

}  // namespace HWY_NAMESPACE
}  // namespace terrane::gen
HWY_AFTER_NAMESPACE();
#endif

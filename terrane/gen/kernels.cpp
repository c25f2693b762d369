#include "terrane/gen/kernels.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <limits>

#include "terrane/gen/det_math.h"
#include "terrane/shared/hash.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "terrane/gen/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

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

Bits* rowOf(Bits* arena, Operand o, int row) {
    return arena + static_cast<std::size_t>(o.row + o.rowStep * row) * kRowLanes;
}

// Calls f(row, lane) for each vector of the destination's rows: one row where the value is the same in every
// column.
template <class Function>
HWY_INLINE void forEachVector(const RowList& rows, Operand dst, Function f) {
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

// A comparison's mask as lanes of 0 or ~0.
template <class D, class M>
HWY_INLINE auto maskBits(D d, M mask) {
    return hn::VecFromMask(d, mask);
}

template <class Function>
void unaryF(const Instruction& i, Bits* arena, const RowList& rows, Function f) {
    forEachVector(rows, i.dst, [&](int row, std::size_t lane) {
        storeBits(f(loadF(rowOf(arena, i.args[0], row) + lane)), rowOf(arena, i.dst, row) + lane);
    });
}

template <class Function>
void unaryI(const Instruction& i, Bits* arena, const RowList& rows, Function f) {
    forEachVector(rows, i.dst, [&](int row, std::size_t lane) {
        storeBits(f(loadI(rowOf(arena, i.args[0], row) + lane)), rowOf(arena, i.dst, row) + lane);
    });
}

template <class Function>
void binaryF(const Instruction& i, Bits* arena, const RowList& rows, Function f) {
    forEachVector(rows, i.dst, [&](int row, std::size_t lane) {
        storeBits(f(loadF(rowOf(arena, i.args[0], row) + lane), loadF(rowOf(arena, i.args[1], row) + lane)),
                  rowOf(arena, i.dst, row) + lane);
    });
}

template <class Function>
void binaryI(const Instruction& i, Bits* arena, const RowList& rows, Function f) {
    forEachVector(rows, i.dst, [&](int row, std::size_t lane) {
        storeBits(f(loadI(rowOf(arena, i.args[0], row) + lane), loadI(rowOf(arena, i.args[1], row) + lane)),
                  rowOf(arena, i.dst, row) + lane);
    });
}

void blend(Operand condition, const PhiMove& move, Bits* arena, const RowList& rows) {
    forEachVector(rows, move.dst, [&](int row, std::size_t lane) {
        const auto taken = hn::MaskFromVec(loadI(rowOf(arena, condition, row) + lane));
        const VI a = loadI(rowOf(arena, move.then, row) + lane);
        const VI b = loadI(rowOf(arena, move.otherwise, row) + lane);
        storeBits(hn::IfThenElse(taken, a, b), rowOf(arena, move.dst, row) + lane);
    });
}

// The same steps as detDivide in det_math.h.
HWY_INLINE VF divide(VF a, VF b) {
    const VF two = hn::Set(df, 2.0f);
    const VU sign = hn::And(hn::BitCast(du, b), hn::Set(du, 0x80000000u));
    const VF magnitude = hn::BitCast(df, hn::Xor(hn::BitCast(du, b), sign));
    const VU guess = hn::Sub(hn::Set(du, kReciprocalMagic), hn::BitCast(du, magnitude));
    VF r = hn::BitCast(df, guess);
    for (int step = 0; step < 3; ++step) r = hn::Mul(r, hn::Sub(two, hn::Mul(magnitude, r)));
    const VF signedA = hn::BitCast(df, hn::Xor(hn::BitCast(du, a), sign));
    const VF q = hn::Mul(signedA, r);
    return hn::Add(q, hn::Mul(r, hn::Sub(signedA, hn::Mul(magnitude, q))));
}

// The same steps as detSqrt in det_math.h.
HWY_INLINE VF squareRoot(VF x) {
    const VF half = hn::Mul(hn::Set(df, 0.5f), x);
    const VF threeHalves = hn::Set(df, 1.5f);
    const VU guess = hn::Sub(hn::Set(du, kInverseRootMagic), hn::ShiftRight<1>(hn::BitCast(du, x)));
    VF r = hn::BitCast(df, guess);
    for (int step = 0; step < 3; ++step) {
        r = hn::Mul(r, hn::Sub(threeHalves, hn::Mul(hn::Mul(half, r), r)));
    }
    const VF s = hn::Mul(x, r);
    return hn::Add(s, hn::Mul(hn::Mul(hn::Set(df, 0.5f), r), hn::Sub(x, hn::Mul(s, s))));
}

// As op.cpp has it: -2^31 for what does not fit and for NaN, where ConvertTo saturates by the sign.
HWY_INLINE VI truncate(VF v) {
    const auto fits = hn::Lt(hn::Abs(v), hn::Set(df, 2147483648.0f));
    return hn::IfThenElse(hn::RebindMask(di, fits), hn::ConvertTo(di, v),
                          hn::Set(di, std::numeric_limits<std::int32_t>::min()));
}

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

// shared::hash2 or hash3 of the arguments, its upper 24 bits as a fraction.
void random(const Instruction& i, TileContext& c, const RowList& rows) {
    constexpr std::uint32_t kFactors[] = {shared::kHashX, shared::kHashY, shared::kHashZ};
    const std::size_t argCount = i.op == Op::Random2D ? 2 : 3;
    const VU seed = hn::Set(du, c.randomSeeds[i.imm]);
    forEachVector(rows, i.dst, [&](int row, std::size_t lane) {
        VU h = seed;
        for (std::size_t k = 0; k < argCount; ++k) {
            const VU v = hn::Load(du, rowOf(c.arena, i.args[k], row) + lane);
            if (k > 0) h = mixHalf(h);
            h = hn::Xor(h, hn::Mul(v, hn::Set(du, kFactors[k])));
        }
        const VI top = hn::BitCast(di, hn::ShiftRight<8>(mixBits(h)));
        storeBits(hn::Mul(hn::ConvertTo(df, top), hn::Set(df, 0x1p-24f)), rowOf(c.arena, i.dst, row) + lane);
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

void noise(const Instruction& i, TileContext& c, const RowList& rows) {
    switch (c.noiseKinds[i.imm]) {
        case NoiseKind::Perlin2D:
            return perlin2D(i, c, rows);
        case NoiseKind::Perlin3D:
            return perlin3D(i, c, rows);
        case NoiseKind::Voronoi2D:
            return voronoi2D(i, c, rows);
    }
}

void field(const Instruction& i, TileContext& c, const RowList& rows) {
    const Bits* values = c.fields[i.imm];
    for (int k = 0; k < rows.count; ++k) {
        const int row = rows.rows[k];
        std::memcpy(rowOf(c.arena, i.dst, row), values + row * kRowLanes, kRowLanes * sizeof(Bits));
    }
}

void fieldAt(const Instruction& i, TileContext& c, const RowList& rows) {
    const Bits* window = c.windows[i.imm].data();
    for (int k = 0; k < rows.count; ++k) {
        const int row = rows.rows[k];
        const Bits* dx = rowOf(c.arena, i.args[0], row);
        const Bits* dy = rowOf(c.arena, i.args[1], row);
        Bits* out = rowOf(c.arena, i.dst, row);
        for (int lane = 0; lane < kRowLanes; ++lane) {
            const int ox = std::clamp(asInt(dx[lane]), -kMaxReadOffset, kMaxReadOffset);
            const int oy = std::clamp(asInt(dy[lane]), -kMaxReadOffset, kMaxReadOffset);
            out[lane] = window[(row + oy + kMaxReadOffset) * kWindowSize + lane + ox + kMaxReadOffset];
        }
    }
}

void blockHere(const Instruction& i, TileContext& c, const RowList& rows) {
    const hn::Rebind<std::uint16_t, DI> d16;
    const std::uint16_t* layer = c.blocks + static_cast<std::size_t>(c.z) * kTileLanes;
    forEachVector(rows, i.dst, [&](int row, std::size_t lane) {
        const auto ids = hn::LoadU(d16, layer + row * kRowLanes + lane);
        storeBits(hn::PromoteTo(di, ids), rowOf(c.arena, i.dst, row) + lane);
    });
}

void blockInColumn(const Instruction& i, TileContext& c, const RowList& rows) {
    for (int k = 0; k < rows.count; ++k) {
        const int row = rows.rows[k];
        const Bits* z = rowOf(c.arena, i.args[0], row);
        Bits* out = rowOf(c.arena, i.dst, row);
        for (int lane = 0; lane < kRowLanes; ++lane) {
            const int layer = std::clamp(asInt(z[lane]), 0, world::kChunkHeight - 1);
            out[lane] = c.blocks[layer * kTileLanes + row * kRowLanes + lane];
        }
    }
}

void run(const InstructionList& list, TileContext& c, const RowList& rows);

// Splits the rows by whether some lane takes the branch, and whether some lane does not.
void branch(const Instruction& i, TileContext& c, const RowList& rows) {
    const Branch& b = c.program->branches[i.imm];
    RowList taken{{}, 0}, notTaken{{}, 0};
    for (int k = 0; k < rows.count; ++k) {
        const Bits* condition = rowOf(c.arena, b.condition, rows.rows[k]);
        bool all = true, none = true;
        for (std::size_t lane = 0; lane < kRowLanes; lane += hn::Lanes(di)) {
            const auto mask = hn::MaskFromVec(loadI(condition + lane));
            all = all && hn::AllTrue(di, mask);
            none = none && hn::AllFalse(di, mask);
        }
        if (!none) taken.rows[taken.count++] = rows.rows[k];
        if (!all) notTaken.rows[notTaken.count++] = rows.rows[k];
    }
    if (taken.count > 0) run(b.then, c, taken);
    if (notTaken.count > 0) run(b.otherwise, c, notTaken);
    for (const PhiMove& move : b.phis) blend(b.condition, move, c.arena, rows);
}

#define TERRANE_BINARY_F(OP, EXPRESSION) \
    case Op::OP:                         \
        return binaryF(i, a, rows, [](VF p, VF q) HWY_ATTR { return EXPRESSION; })
#define TERRANE_BINARY_I(OP, EXPRESSION) \
    case Op::OP:                         \
        return binaryI(i, a, rows, [](VI p, VI q) HWY_ATTR { return EXPRESSION; })
#define TERRANE_UNARY_F(OP, EXPRESSION) \
    case Op::OP:                        \
        return unaryF(i, a, rows, [](VF p) HWY_ATTR { return EXPRESSION; })
#define TERRANE_UNARY_I(OP, EXPRESSION) \
    case Op::OP:                        \
        return unaryI(i, a, rows, [](VI p) HWY_ATTR { return EXPRESSION; })

void runOne(const Instruction& i, TileContext& c, const RowList& rows) {
    Bits* const a = c.arena;
    switch (i.op) {
        TERRANE_BINARY_F(AddF, hn::Add(p, q));
        TERRANE_BINARY_F(SubF, hn::Sub(p, q));
        TERRANE_BINARY_F(MulF, hn::Mul(p, q));
        TERRANE_BINARY_F(DivF, divide(p, q));
        TERRANE_BINARY_F(MinF, hn::IfThenElse(hn::Lt(q, p), q, p));
        TERRANE_BINARY_F(MaxF, hn::IfThenElse(hn::Lt(p, q), q, p));
        TERRANE_UNARY_F(AbsF, hn::Abs(p));
        // Without SSE4.1 Highway's floor of -0.0 is 0.0.
        TERRANE_UNARY_F(FloorF, hn::CopySign(hn::Floor(p), p));
        TERRANE_UNARY_F(SqrtF, squareRoot(p));
        TERRANE_BINARY_F(LessF, maskBits(df, hn::Lt(p, q)));
        TERRANE_BINARY_F(LessEqualF, maskBits(df, hn::Le(p, q)));
        TERRANE_BINARY_F(EqualF, maskBits(df, hn::Eq(p, q)));
        TERRANE_BINARY_I(AddI, hn::Add(p, q));
        TERRANE_BINARY_I(SubI, hn::Sub(p, q));
        TERRANE_BINARY_I(MulI, hn::Mul(p, q));
        TERRANE_BINARY_I(MinI, hn::Min(p, q));
        TERRANE_BINARY_I(MaxI, hn::Max(p, q));
        TERRANE_UNARY_I(AbsI, hn::Abs(p));
        TERRANE_BINARY_I(AndI, hn::And(p, q));
        TERRANE_BINARY_I(ShiftRightI, hn::Shr(p, hn::And(q, hn::Set(di, 31))));
        TERRANE_BINARY_I(LessI, maskBits(di, hn::Lt(p, q)));
        TERRANE_BINARY_I(LessEqualI, maskBits(di, hn::Not(hn::Lt(q, p))));
        TERRANE_BINARY_I(EqualI, maskBits(di, hn::Eq(p, q)));
        TERRANE_UNARY_I(IntToFloat, hn::ConvertTo(df, p));
        TERRANE_UNARY_F(FloatToInt, truncate(p));
        TERRANE_BINARY_I(And, hn::And(p, q));
        TERRANE_BINARY_I(Or, hn::Or(p, q));
        TERRANE_UNARY_I(Not, hn::Not(p));
        case Op::Select:
            return blend(i.args[0], {i.dst, i.args[1], i.args[2]}, a, rows);
        case Op::Phi:
            return branch(i, c, rows);
        case Op::Random2D:
        case Op::Random3D:
            return random(i, c, rows);
        case Op::Noise:
            return noise(i, c, rows);
        case Op::Field:
            return field(i, c, rows);
        case Op::FieldAt:
            return fieldAt(i, c, rows);
        case Op::BlockHere:
            return blockHere(i, c, rows);
        case Op::BlockInColumn:
            return blockInColumn(i, c, rows);
        case Op::Constant:
        case Op::PosX:
        case Op::PosY:
        case Op::PosZ:
        case Op::Component:
        case Op::Count:
            break;
    }
    assert(false && "leaves and components are operands, not instructions");
}

#undef TERRANE_BINARY_F
#undef TERRANE_BINARY_I
#undef TERRANE_UNARY_F
#undef TERRANE_UNARY_I

void run(const InstructionList& list, TileContext& c, const RowList& rows) {
    for (const Instruction& i : list) runOne(i, c, rows);
}

void runAll(const InstructionList& list, TileContext& c) {
    RowList rows{{}, kTileSize};
    for (int k = 0; k < kTileSize; ++k) rows.rows[k] = static_cast<std::uint8_t>(k);
    run(list, c, rows);
}

}  // namespace HWY_NAMESPACE
}  // namespace terrane::gen
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace terrane::gen {

HWY_EXPORT(runAll);

void runInstructions(const InstructionList& list, TileContext& context) {
    HWY_DYNAMIC_DISPATCH(runAll)(list, context);
}

namespace {

// Made before the first restriction: Highway then names only the target it is restricted to.
const std::vector<std::int64_t>& allTargets() {
    static const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
    return targets;
}

}  // namespace

std::vector<std::string> simdTargets() {
    std::vector<std::string> names;
    for (const std::int64_t target : allTargets()) names.emplace_back(hwy::TargetName(target));
    return names;
}

bool chooseSimdTarget(const std::string& name) {
    std::int64_t chosen = 0;  // all
    for (const std::int64_t target : allTargets()) {
        if (hwy::TargetName(target) == name) chosen = target;
    }
    if (chosen == 0 && !name.empty()) return false;
    hwy::SetSupportedTargetsForTest(chosen);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    return true;
}

}  // namespace terrane::gen
#endif

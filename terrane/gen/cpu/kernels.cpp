#include "terrane/gen/cpu/kernels.h"

#include <cassert>
#include <cmath>
#include <limits>

#include "terrane/world/coords.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "terrane/gen/cpu/kernels.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "terrane/gen/cpu/read_kernels-inl.h"
#include "terrane/gen/noise/noise_kernels-inl.h"
#include "terrane/gen/noise/tile_rows-inl.h"
#include "terrane/shared/generation.h"

HWY_BEFORE_NAMESPACE();
namespace terrane::gen {
namespace HWY_NAMESPACE {

// The operands are read before the loops: stores of vectors might change them, as far as the compiler knows.
template <class Function>
void unaryF(const Instruction& i, Bits* arena, const RowList& rows, Function f) {
    const RowsOf a(arena, i.args[0]), out(arena, i.dst);
    forEachVector(rows, i.dst, [=](int row, std::size_t lane) {
        storeBits(f(loadF(a.at(row, lane))), out.at(row, lane));
    });
}

template <class Function>
void unaryI(const Instruction& i, Bits* arena, const RowList& rows, Function f) {
    const RowsOf a(arena, i.args[0]), out(arena, i.dst);
    forEachVector(rows, i.dst, [=](int row, std::size_t lane) {
        storeBits(f(loadI(a.at(row, lane))), out.at(row, lane));
    });
}

template <class Function>
void binaryF(const Instruction& i, Bits* arena, const RowList& rows, Function f) {
    const RowsOf a(arena, i.args[0]), b(arena, i.args[1]), out(arena, i.dst);
    forEachVector(rows, i.dst, [=](int row, std::size_t lane) {
        storeBits(f(loadF(a.at(row, lane)), loadF(b.at(row, lane))), out.at(row, lane));
    });
}

template <class Function>
void binaryI(const Instruction& i, Bits* arena, const RowList& rows, Function f) {
    const RowsOf a(arena, i.args[0]), b(arena, i.args[1]), out(arena, i.dst);
    forEachVector(rows, i.dst, [=](int row, std::size_t lane) {
        storeBits(f(loadI(a.at(row, lane)), loadI(b.at(row, lane))), out.at(row, lane));
    });
}

void blend(Operand condition, const PhiMove& move, Bits* arena, const RowList& rows) {
    const RowsOf choice(arena, condition), a(arena, move.then), b(arena, move.otherwise),
        out(arena, move.dst);
    forEachVector(rows, move.dst, [=](int row, std::size_t lane) {
        const auto taken = hn::MaskFromVec(loadI(choice.at(row, lane)));
        storeBits(hn::IfThenElse(taken, loadI(a.at(row, lane)), loadI(b.at(row, lane))), out.at(row, lane));
    });
}

// As op.cpp has it: -2^31 for what does not fit and for NaN, where ConvertTo saturates by the sign.
HWY_INLINE VI truncate(VF v) {
    const auto fits = hn::Lt(hn::Abs(v), hn::Set(df, 2147483648.0f));
    return hn::IfThenElse(hn::RebindMask(di, fits), hn::ConvertTo(di, v),
                          hn::Set(di, std::numeric_limits<std::int32_t>::min()));
}

HWY_INLINE VI floatBits(VF v) {
    const VI bits = hn::BitCast(di, v);
    const auto isNaN = hn::Gt(hn::And(bits, hn::Set(di, 0x7FFFFFFF)), hn::Set(di, 0x7F800000));
    return hn::IfThenElse(isNaN, hn::Set(di, 0x7FC00000), bits);
}

// No instruction set divides integers in lanes. As doubles the quotient is rounded to a whole number only
// where it is one: others are at least 2^-31 away from those, relative to quotients below 2^31, and doubles
// round by 2^-53.
HWY_INLINE VI floorDivide(VI a, VI b) {
    const VI one = hn::Set(di, 1), divisor = hn::Max(b, one);
#if HWY_TARGET == HWY_SCALAR  // has no halves
    const double quotient = static_cast<double>(hn::GetLane(a)) / hn::GetLane(divisor);
    const VI whole = hn::Set(di, static_cast<std::int32_t>(std::floor(quotient)));
#else
    const hn::Half<DI> half;
    const hn::Rebind<double, hn::Half<DI> > wide;
    const auto divided = [&](auto p, auto q) HWY_ATTR {
        return hn::DemoteTo(half, hn::Floor(hn::Div(hn::PromoteTo(wide, p), hn::PromoteTo(wide, q))));
    };
    const VI whole = hn::Combine(di, divided(hn::UpperHalf(half, a), hn::UpperHalf(half, divisor)),
                                 divided(hn::LowerHalf(half, a), hn::LowerHalf(half, divisor)));
#endif
    return hn::IfThenZeroElse(hn::Lt(b, one), whole);
}

void run(const InstructionList& list, TileContext& c, const RowList& rows);

// Returns the rows with a lane for which the condition holds.
RowList rowsWithSome(Operand condition, Bits* arena, const RowList& rows) {
    RowList result{{}, 0};
    for (int k = 0; k < rows.count; ++k) {
        bool none = true;
        for (std::size_t lane = 0; lane < kRowLanes; lane += hn::Lanes(di)) {
            const VI bits = loadI(rowOf(arena, condition, rows.rows[k]) + lane);
            none = none && hn::AllFalse(di, hn::MaskFromVec(bits));
        }
        if (!none) result.rows[result.count++] = rows.rows[k];
    }
    return result;
}

void copyRows(Operand to, Operand from, Bits* arena, const RowList& rows) {
    const RowsOf in(arena, from), out(arena, to);
    forEachVector(rows, to,
                  [=](int row, std::size_t lane) { storeBits(loadI(in.at(row, lane)), out.at(row, lane)); });
}

// A lane whose condition does not hold keeps its variables, so its condition does not hold again either.
void loop(const Instruction& i, TileContext& c, const RowList& rows) {
    const ProgramLoop& l = c.program->loops[i.imm];
    for (const LoopMove& v : l.variables) copyRows(v.in, v.initial, c.arena, rows);
    RowList active = rows;
    for (int round = 0; round < shared::kMaxLoopRounds; ++round) {
        run(l.head, c, active);
        active = rowsWithSome(l.condition, c.arena, active);
        if (active.count == 0) return;
        run(l.body, c, active);
        for (const LoopMove& v : l.variables) blend(l.condition, {v.changed, v.next, v.in}, c.arena, active);
        for (const LoopMove& v : l.variables) copyRows(v.in, v.changed, c.arena, active);
    }
}

// Splits the rows by whether some lane takes the branch, and whether some lane does not. Lanes that are not
// requested count as neither.
void branch(const Instruction& i, TileContext& c, const RowList& rows) {
    const Branch& b = c.program->branches[i.imm];
    RowList taken{{}, 0}, notTaken{{}, 0};
    const RowsOf condition(c.arena, b.condition);
    for (int k = 0; k < rows.count; ++k) {
        const std::uint8_t row = rows.rows[k];
        bool all = true, none = true;
        for (std::size_t lane = 0; lane < kRowLanes; lane += hn::Lanes(di)) {
            const VI holds = loadI(condition.at(row, lane));
            const VI requested = c.requested ? loadI(c.requested + row * kRowLanes + lane) : hn::Set(di, -1);
            all = all && hn::AllFalse(di, hn::MaskFromVec(hn::AndNot(holds, requested)));
            none = none && hn::AllFalse(di, hn::MaskFromVec(hn::And(holds, requested)));
        }
        // Without branches, which would be mispredicted.
        taken.rows[taken.count] = row;
        notTaken.rows[notTaken.count] = row;
        taken.count += none ? 0 : 1;
        notTaken.count += all ? 0 : 1;
    }
    if (taken.count > 0) run(b.then, c, taken);
    if (notTaken.count > 0) run(b.otherwise, c, notTaken);
    // The allocator gives most results the rows of a value that ends here: rows that keep it need no
    // blending.
    for (const PhiMove& move : b.phis) {
        const RowList& changed = move.dst == move.otherwise ? taken : move.dst == move.then ? notTaken : rows;
        if (changed.count > 0) blend(b.condition, move, c.arena, changed);
    }
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
        TERRANE_BINARY_I(OrI, hn::Or(p, q));
        TERRANE_BINARY_I(XorI, hn::Xor(p, q));
        TERRANE_BINARY_I(ShiftLeftI, hn::Shl(p, hn::And(q, hn::Set(di, 31))));
        TERRANE_BINARY_I(ShiftRightI, hn::Shr(p, hn::And(q, hn::Set(di, 31))));
        TERRANE_BINARY_I(LessI, maskBits(di, hn::Lt(p, q)));
        TERRANE_BINARY_I(LessEqualI, maskBits(di, hn::Not(hn::Lt(q, p))));
        TERRANE_BINARY_I(EqualI, maskBits(di, hn::Eq(p, q)));
        TERRANE_UNARY_I(IntToFloat, hn::ConvertTo(df, p));
        TERRANE_UNARY_F(FloatToInt, truncate(p));
        TERRANE_UNARY_F(FloatBits, floatBits(p));
        TERRANE_UNARY_I(BitsFloat, p);
        TERRANE_BINARY_I(And, hn::And(p, q));
        TERRANE_BINARY_I(Or, hn::Or(p, q));
        TERRANE_UNARY_I(Not, hn::Not(p));
        case Op::Select:
            return blend(i.args[0], {i.dst, i.args[1], i.args[2]}, a, rows);
        case Op::Phi:
            return branch(i, c, rows);
        case Op::LoopOut:
            return loop(i, c, rows);
        case Op::FloorDivideI:
            return binaryI(i, a, rows, [](VI p, VI q) HWY_ATTR { return floorDivide(p, q); });
        case Op::Hash2:
        case Op::Hash3:
            return hash(i, c, rows);
        case Op::Noise:
        case Op::Stripes:
            return noise(i, c, rows);
        case Op::Field:
            return field(i, c, rows);
        case Op::FieldAt:
            return fieldAt(i, c, rows);
        case Op::Stamp:
            return stamp(i, c, rows);
        case Op::BlockHere:
            return blockHere(i, c, rows);
        case Op::BlockInColumn:
            return blockInColumn(i, c, rows);
        case Op::BlockAt:
            return blockAt(i, c, rows);
        case Op::Constant:
        case Op::PosX:
        case Op::PosY:
        case Op::PosZ:
        case Op::Component:
        case Op::LoopIn:
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
    RowList rows{{}, 0};
    for (int k = 0; k < kTileSize; ++k) {
        rows.rows[rows.count] = static_cast<std::uint8_t>(k);
        rows.count += c.rows >> k & 1;
    }
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

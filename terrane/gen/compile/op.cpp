#include "terrane/gen/compile/op.h"

#include <cassert>
#include <cmath>

#include "terrane/shared/det_math.h"

namespace terrane::gen {
namespace {

using Args = std::span<const Bits>;

constexpr Type B = Type::Bool, I = Type::Int, F = Type::Float;

std::uint32_t u(Bits b) {
    return b;
}
float f(Bits b) {
    return asFloat(b);
}
std::int32_t i(Bits b) {
    return asInt(b);
}

// Min and max as one comparison and a choice: the same for equal zeros and for NaN on every machine.
Bits select(bool c, Bits a, Bits b) {
    return c ? a : b;
}

// Returns the result of x86 for values outside the range, so that folding never differs from running.
Bits truncated(float v) {
    return v > -2147483904.0f && v < 2147483648.0f ? bitsOf(static_cast<std::int32_t>(v)) : 0x80000000u;
}

Bits floorDivided(std::int32_t a, std::int32_t b) {
    return b < 1 ? 0u : bitsOf(a / b - (a % b < 0 ? 1 : 0));
}

// NaN carries a payload that depends on the machine.
constexpr Bits kAnyNaN = 0x7FC00000u;

// clang-format off
constexpr OpRecord kRecords[] = {
    {Op::Constant, "constant", 0, {}, I, nullptr, ""},
    {Op::PosX, "x", 0, {}, I, nullptr, ""},
    {Op::PosY, "y", 0, {}, I, nullptr, ""},
    {Op::PosZ, "z", 0, {}, I, nullptr, ""},
    {Op::Field, "field", 0, {}, F, nullptr, ""},
    {Op::Noise, "noise", 0, {}, F, nullptr, ""},
    {Op::Stamp, "stamp", 0, {}, I, nullptr, ""},
    {Op::BlockHere, "block here", 0, {}, I, nullptr, "blockHere(z)"},
    {Op::FieldAt, "field at", 2, {I, I}, F, nullptr, ""},
    {Op::BlockInColumn, "block in column", 1, {I}, I, nullptr, "blockInColumn({0})"},
    {Op::BlockAt, "block at", 3, {I, I, I}, I, nullptr, "blockAt({0}, {1}, {2})"},
    {Op::Stripes, "stripes", 2, {F, F}, F, nullptr, ""},
    {Op::Component, "component", 1, {F}, F, nullptr, ""},
    {Op::Hash2, "hash 2D", 2, {I, I}, I, nullptr, ""},
    {Op::Hash3, "hash 3D", 3, {I, I, I}, I, nullptr, ""},

    {Op::AddF, "+", 2, {F, F}, F, [](Args a) { return bitsOf(f(a[0]) + f(a[1])); }, "{0} + {1}"},
    {Op::SubF, "-", 2, {F, F}, F, [](Args a) { return bitsOf(f(a[0]) - f(a[1])); }, "{0} - {1}"},
    {Op::MulF, "*", 2, {F, F}, F, [](Args a) { return bitsOf(f(a[0]) * f(a[1])); }, "{0} * {1}"},
    {Op::DivF, "/", 2, {F, F}, F, [](Args a) { return bitsOf(shared::detDivide(f(a[0]), f(a[1]))); }, "detDivide({0}, {1})"},
    {Op::MinF, "min", 2, {F, F}, F, [](Args a) { return select(f(a[1]) < f(a[0]), a[1], a[0]); }, "{1} < {0} ? {1} : {0}"},
    {Op::MaxF, "max", 2, {F, F}, F, [](Args a) { return select(f(a[0]) < f(a[1]), a[1], a[0]); }, "{0} < {1} ? {1} : {0}"},
    {Op::AbsF, "abs", 1, {F}, F, [](Args a) { return a[0] & 0x7FFFFFFFu; }, "abs({0})"},
    {Op::FloorF, "floor", 1, {F}, F, [](Args a) { return bitsOf(std::floor(f(a[0]))); }, "floor({0})"},
    {Op::SqrtF, "sqrt", 1, {F}, F, [](Args a) { return bitsOf(shared::detSqrt(f(a[0]))); }, "detSqrt({0})"},
    {Op::LessF, "<", 2, {F, F}, B, [](Args a) { return bitsOf(f(a[0]) < f(a[1])); }, "{0} < {1}"},
    {Op::LessEqualF, "<=", 2, {F, F}, B, [](Args a) { return bitsOf(f(a[0]) <= f(a[1])); }, "{0} <= {1}"},
    {Op::EqualF, "==", 2, {F, F}, B, [](Args a) { return bitsOf(f(a[0]) == f(a[1])); }, "{0} == {1}"},

    {Op::AddI, "+", 2, {I, I}, I, [](Args a) { return u(a[0]) + u(a[1]); }, "{0} + {1}"},
    {Op::SubI, "-", 2, {I, I}, I, [](Args a) { return u(a[0]) - u(a[1]); }, "{0} - {1}"},
    {Op::MulI, "*", 2, {I, I}, I, [](Args a) { return u(a[0]) * u(a[1]); }, "{0} * {1}"},
    {Op::MinI, "min", 2, {I, I}, I, [](Args a) { return select(i(a[1]) < i(a[0]), a[1], a[0]); }, "min({0}, {1})"},
    {Op::MaxI, "max", 2, {I, I}, I, [](Args a) { return select(i(a[0]) < i(a[1]), a[1], a[0]); }, "max({0}, {1})"},
    {Op::AbsI, "abs", 1, {I}, I, [](Args a) { return i(a[0]) < 0 ? 0u - a[0] : a[0]; }, "{0} < 0 ? 0 - {0} : {0}"},
    {Op::FloorDivideI, "floorDivide", 2, {I, I}, I, [](Args a) { return floorDivided(i(a[0]), i(a[1])); }, "floorDivideOr0({0}, {1})"},
    {Op::AndI, "&", 2, {I, I}, I, [](Args a) { return a[0] & a[1]; }, "{0} & {1}"},
    {Op::OrI, "|", 2, {I, I}, I, [](Args a) { return a[0] | a[1]; }, "{0} | {1}"},
    {Op::XorI, "^", 2, {I, I}, I, [](Args a) { return a[0] ^ a[1]; }, "{0} ^ {1}"},
    {Op::ShiftLeftI, "<<", 2, {I, I}, I, [](Args a) { return a[0] << (a[1] & 31u); }, "{0} << ({1} & 31)"},
    {Op::ShiftRightI, ">>", 2, {I, I}, I, [](Args a) { return bitsOf(i(a[0]) >> (a[1] & 31u)); }, "{0} >> ({1} & 31)"},
    {Op::LessI, "<", 2, {I, I}, B, [](Args a) { return bitsOf(i(a[0]) < i(a[1])); }, "{0} < {1}"},
    {Op::LessEqualI, "<=", 2, {I, I}, B, [](Args a) { return bitsOf(i(a[0]) <= i(a[1])); }, "{0} <= {1}"},
    {Op::EqualI, "==", 2, {I, I}, B, [](Args a) { return bitsOf(a[0] == a[1]); }, "{0} == {1}"},

    {Op::IntToFloat, "toFloat", 1, {I}, F, [](Args a) { return bitsOf(static_cast<float>(i(a[0]))); }, "float({0})"},
    {Op::FloatToInt, "toInt", 1, {F}, I, [](Args a) { return truncated(f(a[0])); }, "truncateToInt({0})"},

    {Op::FloatBits, "floatBits", 1, {F}, I, [](Args a) { return (a[0] & 0x7FFFFFFFu) > 0x7F800000u ? kAnyNaN : a[0]; }, "floatBits({0})"},
    {Op::BitsFloat, "bitsFloat", 1, {I}, F, [](Args a) { return a[0]; }, "intBitsToFloat({0})"},

    {Op::And, "&&", 2, {B, B}, B, [](Args a) { return a[0] & a[1]; }, "{0} && {1}"},
    {Op::Or, "||", 2, {B, B}, B, [](Args a) { return a[0] | a[1]; }, "{0} || {1}"},
    {Op::Not, "!", 1, {B}, B, [](Args a) { return ~a[0]; }, "!{0}"},

    {Op::Select, "select", 3, {B}, I, [](Args a) { return select(asBool(a[0]), a[1], a[2]); }, "{0} ? {1} : {2}"},
    {Op::Phi, "if", 3, {B}, I, [](Args a) { return select(asBool(a[0]), a[1], a[2]); }, ""},
    {Op::LoopIn, "loop in", 1, {}, I, nullptr, ""},
    {Op::LoopOut, "loop out", 1, {}, I, nullptr, ""},
};
// clang-format on

constexpr bool inOrder() {
    for (std::size_t n = 0; n < std::size(kRecords); ++n) {
        if (kRecords[n].op != static_cast<Op>(n)) return false;
    }
    return std::size(kRecords) == static_cast<std::size_t>(Op::Count);
}
static_assert(inOrder(), "the table has one record for each operation, in the order of the enumeration");

}  // namespace

const OpRecord& record(Op op) {
    assert(op < Op::Count && "every operation has a record");
    return kRecords[static_cast<std::size_t>(op)];
}

bool isCommutative(Op op) {
    switch (op) {
        case Op::AddF:
        case Op::MulF:
        case Op::AddI:
        case Op::MulI:
        case Op::And:
        case Op::Or:
        case Op::EqualF:
        case Op::EqualI:
        case Op::AndI:
        case Op::OrI:
        case Op::XorI:
            return true;
        default:
            return false;
    }
}

}  // namespace terrane::gen

#include "terrane/gen/compile/op.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <string>
#include <vector>

#include "terrane/shared/det_math.h"
#include "tests/gen/not_a_number.h"

namespace terrane::gen {
namespace {

using shared::detDivide;
using shared::detSqrt;

constexpr std::int32_t kMin = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kMax = std::numeric_limits<std::int32_t>::max();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

template <class... Args>
Bits evaluate(Op op, Args... args) {
    const std::array<Bits, sizeof...(Args)> bits = {bitsOf(args)...};
    EXPECT_EQ(record(op).argCount, bits.size());
    return record(op).evaluate(bits);
}

template <class... Args>
std::int32_t intOf(Op op, Args... args) {
    return asInt(evaluate(op, args...));
}

template <class... Args>
float floatOf(Op op, Args... args) {
    return asFloat(evaluate(op, args...));
}

// Comparisons must give a whole lane mask, not any non-zero value.
template <class... Args>
bool boolOf(Op op, Args... args) {
    const Bits bits = evaluate(op, args...);
    EXPECT_TRUE(bits == 0 || bits == ~Bits{0}) << bits;
    return asBool(bits);
}

TEST(OpRecord, EveryOperationHasItsOwnRecord) {
    for (std::size_t n = 0; n < static_cast<std::size_t>(Op::Count); ++n) {
        const OpRecord& r = record(static_cast<Op>(n));
        EXPECT_EQ(r.op, static_cast<Op>(n));
        EXPECT_FALSE(r.name.empty());
        EXPECT_LE(r.argCount, r.argTypes.size());
    }
}

// Values that depend on the position or the world's seed must never be folded.
TEST(OpRecord, OnlyFunctionsOfTheArgumentsAloneCanBeEvaluated) {
    const std::set<Op> notPure = {Op::Constant, Op::PosX,    Op::PosY,      Op::PosZ,          Op::Field,
                                  Op::Noise,    Op::FieldAt, Op::BlockHere, Op::BlockInColumn, Op::Component,
                                  Op::BlockAt,  Op::Stripes, Op::Hash2,     Op::Hash3,         Op::LoopIn,
                                  Op::LoopOut,  Op::Stamp};
    for (std::size_t n = 0; n < static_cast<std::size_t>(Op::Count); ++n) {
        const OpRecord& r = record(static_cast<Op>(n));
        EXPECT_EQ(r.evaluate == nullptr, notPure.contains(r.op)) << r.name;
    }
}

TEST(OpRecord, IntegersWrapModulo32Bits) {
    EXPECT_EQ(intOf(Op::AddI, kMax, 1), kMin);
    EXPECT_EQ(intOf(Op::SubI, kMin, 1), kMax);
    EXPECT_EQ(intOf(Op::MulI, 0x10001, 0x10001), 0x20001);
    EXPECT_EQ(intOf(Op::MulI, kMin, -1), kMin);
    EXPECT_EQ(intOf(Op::AbsI, kMin), kMin);
    EXPECT_EQ(intOf(Op::AbsI, -7), 7);
    EXPECT_EQ(intOf(Op::AbsI, 7), 7);
}

TEST(OpRecord, IntegerBitsAndOrder) {
    EXPECT_EQ(intOf(Op::MinI, kMin, kMax), kMin);
    EXPECT_EQ(intOf(Op::MaxI, kMin, kMax), kMax);
    EXPECT_EQ(intOf(Op::MinI, -1, 1), -1);
    EXPECT_EQ(intOf(Op::MaxI, -1, 1), 1);
    EXPECT_EQ(intOf(Op::AndI, -2, 0x7F), 0x7E);
    EXPECT_EQ(intOf(Op::ShiftRightI, -17, 4), -2) << "floors, like a division by 16 that floors";
    EXPECT_EQ(intOf(Op::ShiftRightI, kMin, 31), -1);
    EXPECT_EQ(intOf(Op::ShiftRightI, -17, 36), -2) << "the count is taken modulo 32";
    EXPECT_TRUE(boolOf(Op::LessI, kMin, kMax));
    EXPECT_FALSE(boolOf(Op::LessI, 3, 3));
    EXPECT_TRUE(boolOf(Op::LessEqualI, 3, 3));
    EXPECT_FALSE(boolOf(Op::LessEqualI, kMax, kMin));
    EXPECT_TRUE(boolOf(Op::EqualI, kMin, kMin));
    EXPECT_FALSE(boolOf(Op::EqualI, kMin, kMax));
}

TEST(OpRecord, FloatArithmeticIsIeee) {
    EXPECT_EQ(floatOf(Op::AddF, 0.1f, 0.2f), 0.1f + 0.2f);
    EXPECT_EQ(floatOf(Op::SubF, 1.0f, 0x1p-24f), 1.0f - 0x1p-24f);
    EXPECT_EQ(floatOf(Op::MulF, 1.1f, 1.1f), 1.1f * 1.1f);
    EXPECT_EQ(evaluate(Op::AddF, -0.0f, 0.0f), bitsOf(0.0f));
    EXPECT_EQ(evaluate(Op::MulF, -1.0f, 0.0f), bitsOf(-0.0f));
    EXPECT_TRUE(std::isnan(floatOf(Op::SubF, kInfinity, kInfinity)));
    EXPECT_EQ(floatOf(Op::DivF, 1.0f, 3.0f), detDivide(1.0f, 3.0f));
    EXPECT_EQ(floatOf(Op::SqrtF, 2.0f), detSqrt(2.0f));
    EXPECT_EQ(evaluate(Op::AbsF, -0.0f), bitsOf(0.0f));
    EXPECT_EQ(floatOf(Op::AbsF, -kInfinity), kInfinity);
}

TEST(OpRecord, FloorKeepsZerosInfinitiesAndLargeNumbers) {
    EXPECT_EQ(floatOf(Op::FloorF, -0.5f), -1.0f);
    EXPECT_EQ(floatOf(Op::FloorF, 2.9999998f), 2.0f);
    EXPECT_EQ(floatOf(Op::FloorF, -3.0f), -3.0f);
    EXPECT_EQ(evaluate(Op::FloorF, -0.0f), bitsOf(-0.0f));
    EXPECT_EQ(floatOf(Op::FloorF, 0x1.8p40f), 0x1.8p40f);
    EXPECT_EQ(floatOf(Op::FloorF, -kInfinity), -kInfinity);
    EXPECT_TRUE(std::isnan(floatOf(Op::FloorF, kNaN)));
}

// One comparison and a choice: the first argument wins unless the second is smaller (greater).
TEST(OpRecord, MinAndMaxAreDefinedForEqualZerosAndNaN) {
    EXPECT_EQ(evaluate(Op::MinF, 0.0f, -0.0f), bitsOf(0.0f));
    EXPECT_EQ(evaluate(Op::MinF, -0.0f, 0.0f), bitsOf(-0.0f));
    EXPECT_EQ(evaluate(Op::MaxF, 0.0f, -0.0f), bitsOf(0.0f));
    EXPECT_EQ(evaluate(Op::MaxF, -0.0f, 0.0f), bitsOf(-0.0f));
    EXPECT_TRUE(std::isnan(floatOf(Op::MinF, kNaN, 1.0f)));
    EXPECT_EQ(floatOf(Op::MinF, 1.0f, kNaN), 1.0f);
    EXPECT_TRUE(std::isnan(floatOf(Op::MaxF, kNaN, 1.0f)));
    EXPECT_EQ(floatOf(Op::MaxF, 1.0f, kNaN), 1.0f);
    EXPECT_EQ(floatOf(Op::MinF, -kInfinity, 3.0f), -kInfinity);
    EXPECT_EQ(floatOf(Op::MaxF, 2.0f, 3.0f), 3.0f);
}

TEST(OpRecord, FloatComparisonsAreFalseForNaN) {
    for (const Op op : {Op::LessF, Op::LessEqualF, Op::EqualF}) {
        EXPECT_FALSE(boolOf(op, kNaN, 1.0f));
        EXPECT_FALSE(boolOf(op, 1.0f, kNaN));
        EXPECT_FALSE(boolOf(op, kNaN, kNaN));
        EXPECT_EQ(boolOf(op, -0.0f, 0.0f), op != Op::LessF);
    }
    EXPECT_TRUE(boolOf(Op::LessF, -kInfinity, kInfinity));
    EXPECT_FALSE(boolOf(Op::LessEqualF, 2.0f, 1.0f));
}

TEST(OpRecord, ConversionsRoundAsTheirCommentsSay) {
    EXPECT_EQ(floatOf(Op::IntToFloat, 16777216), 16777216.0f);
    EXPECT_EQ(floatOf(Op::IntToFloat, 16777217), 16777216.0f) << "halves go to even";
    EXPECT_EQ(floatOf(Op::IntToFloat, 16777219), 16777220.0f);
    EXPECT_EQ(floatOf(Op::IntToFloat, kMin), -0x1p31f);
    EXPECT_EQ(floatOf(Op::IntToFloat, kMax), 0x1p31f);
    EXPECT_EQ(intOf(Op::FloatToInt, 2.99f), 2);
    EXPECT_EQ(intOf(Op::FloatToInt, -2.99f), -2);
    EXPECT_EQ(intOf(Op::FloatToInt, -0.5f), 0);
    EXPECT_EQ(intOf(Op::FloatToInt, 2147483520.0f), 2147483520);
    EXPECT_EQ(intOf(Op::FloatToInt, -0x1p31f), kMin);
    for (const float outside : {0x1p31f, -0x1.000002p31f, kInfinity, -kInfinity, kNaN, -kNaN}) {
        EXPECT_EQ(intOf(Op::FloatToInt, outside), kMin) << outside;
    }
}

TEST(OpRecord, LogicAndChoice) {
    for (const bool a : {false, true}) {
        EXPECT_EQ(boolOf(Op::Not, a), !a);
        for (const bool b : {false, true}) {
            EXPECT_EQ(boolOf(Op::And, a, b), a && b);
            EXPECT_EQ(boolOf(Op::Or, a, b), a || b);
        }
        EXPECT_EQ(intOf(Op::Select, a, 5, 7), a ? 5 : 7);
        EXPECT_EQ(evaluate(Op::Phi, a, -0.0f, 7.0f), a ? bitsOf(-0.0f) : bitsOf(7.0f));
    }
}

}  // namespace
}  // namespace terrane::gen

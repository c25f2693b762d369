#include "terrane/gen/language/expr.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

#include "terrane/shared/det_math.h"
#include "tests/gen/not_a_number.h"

namespace terrane::gen {
namespace {

using shared::detDivide;

float floatOf(Float v) {
    EXPECT_EQ(v.graph, nullptr) << "literals alone give a literal";
    return asFloat(v.bits);
}

std::int32_t intOf(Int v) {
    EXPECT_EQ(v.graph, nullptr) << "literals alone give a literal";
    return asInt(v.bits);
}

bool boolOf(Bool v) {
    EXPECT_EQ(v.graph, nullptr) << "literals alone give a literal";
    return asBool(v.bits);
}

TEST(Expr, IntLiterals) {
    const Int a = -7, b = 3;
    EXPECT_EQ(intOf(a + b), -4);
    EXPECT_EQ(intOf(a - b), -10);
    EXPECT_EQ(intOf(a * b), -21);
    EXPECT_EQ(intOf(-a), 7);
    EXPECT_EQ(intOf(a & b), 1);
    EXPECT_EQ(intOf(a >> 1), -4);
    EXPECT_EQ(intOf(min(a, b)), -7);
    EXPECT_EQ(intOf(max(a, b)), 3);
    EXPECT_EQ(intOf(abs(a)), 7);
    EXPECT_EQ(intOf(clamp(a, -5, 5)), -5);
    EXPECT_EQ(intOf(clamp(b, 4, 5)), 4);
    EXPECT_EQ(intOf(Int(Float(-2.75f))), -2);
}

TEST(Expr, FloorDivisionAndItsRest) {
    const auto expect = [](std::int32_t a, std::int32_t b, std::int32_t quotient, std::int32_t rest) {
        EXPECT_EQ(intOf(floorDivide(a, b)), quotient) << a << " / " << b;
        EXPECT_EQ(intOf(floorModulo(a, b)), rest) << a << " mod " << b;
    };
    expect(7, 3, 2, 1);
    expect(-7, 3, -3, 2);
    expect(-6, 3, -2, 0);
    expect(0, 5, 0, 0);
    expect(-1, 16, -1, 15);
    expect(INT32_MIN, 10, -214748365, 2);
    expect(INT32_MIN, 1, INT32_MIN, 0);
    expect(INT32_MAX, 16, INT32_MAX / 16, 15);
}

TEST(Expr, IntComparisons) {
    const Int a = -7, b = 3;
    EXPECT_TRUE(boolOf(a < b));
    EXPECT_TRUE(boolOf(a <= a));
    EXPECT_FALSE(boolOf(a > b));
    EXPECT_TRUE(boolOf(b >= a));
    EXPECT_FALSE(boolOf(a == b));
    EXPECT_TRUE(boolOf(a != b));
}

TEST(Expr, FloatLiterals) {
    const Float a = -2.5f, b = 0.75f;
    EXPECT_EQ(floatOf(a + b), -1.75f);
    EXPECT_EQ(floatOf(a - b), -3.25f);
    EXPECT_EQ(floatOf(a * b), -1.875f);
    EXPECT_EQ(floatOf(a / b), detDivide(-2.5f, 0.75f));
    EXPECT_EQ(floatOf(-a), 2.5f);
    EXPECT_EQ(floatOf(min(a, b)), -2.5f);
    EXPECT_EQ(floatOf(max(a, b)), 0.75f);
    EXPECT_EQ(floatOf(abs(a)), 2.5f);
    EXPECT_EQ(floatOf(clamp(a, 0.0f, 1.0f)), 0.0f);
    EXPECT_EQ(floatOf(Float(Int(-3))), -3.0f);
}

TEST(Expr, FloatRounding) {
    EXPECT_EQ(floatOf(floor(Float(-2.5f))), -3.0f);
    EXPECT_EQ(floatOf(ceil(Float(-2.5f))), -2.0f);
    EXPECT_EQ(floatOf(ceil(Float(2.25f))), 3.0f);
    EXPECT_EQ(floatOf(round(Float(2.5f))), 3.0f) << "halves upward";
    EXPECT_EQ(floatOf(round(Float(-2.5f))), -2.0f) << "halves upward";
    EXPECT_EQ(floatOf(round(Float(-2.6f))), -3.0f);
}

TEST(Expr, FloatFunctions) {
    EXPECT_EQ(floatOf(sqrt(Float(9.0f))), 3.0f);
    EXPECT_EQ(floatOf(sqrt(Float(0.0f))), 0.0f);
    EXPECT_EQ(floatOf(length({3.0f, -4.0f})), 5.0f);
    EXPECT_EQ(floatOf(lerp(2.0f, 6.0f, 0.25f)), 3.0f);
    EXPECT_EQ(floatOf(smoothstep(1.0f, 3.0f, 0.0f)), 0.0f);
    EXPECT_EQ(floatOf(smoothstep(1.0f, 3.0f, 2.0f)), 0.5f);
    EXPECT_EQ(floatOf(smoothstep(1.0f, 3.0f, 4.0f)), 1.0f);
    EXPECT_EQ(floatOf(smoothstep(3.0f, 1.0f, 2.5f)), 0.15625f) << "falls where low is above high";
}

TEST(Expr, FloatComparisons) {
    const Float a = -2.5f, b = 0.75f, nan = kNaN;
    EXPECT_TRUE(boolOf(a < b));
    EXPECT_TRUE(boolOf(b <= b));
    EXPECT_TRUE(boolOf(b > a));
    EXPECT_FALSE(boolOf(a >= b));
    EXPECT_TRUE(boolOf(a == a));
    EXPECT_FALSE(boolOf(nan == nan));
    EXPECT_TRUE(boolOf(nan != nan));
    EXPECT_FALSE(boolOf(nan >= a)) << "not the opposite of <";
    EXPECT_FALSE(boolOf(nan > a));
}

TEST(Expr, BoolLiterals) {
    EXPECT_TRUE(boolOf(Bool(true) && !Bool(false)));
    EXPECT_FALSE(boolOf(Bool(false) || Bool(false)));
    EXPECT_EQ(intOf(select(Bool(true), Int(4), Int(5))), 4);
    EXPECT_EQ(floatOf(select(Bool(false), Float(4.0f), Float(5.0f))), 5.0f);
    EXPECT_TRUE(boolOf(Block(7) == Block(7)));
    EXPECT_TRUE(boolOf(Block(7) != Block(8)));
}

TEST(Expr, LiteralsJoinTheGraphOfTheOtherSide) {
    Graph graph;
    const Int x(Value{&graph, graph.add(Op::PosX, Type::Int, {}, 0, kDependsColumn)});
    const Int sum = Int(5) + x;
    ASSERT_EQ(sum.graph, &graph);
    const Node& node = graph.node(sum.bits);
    EXPECT_EQ(node.op, Op::AddI);
    EXPECT_EQ(node.args[0], x.bits);
    EXPECT_EQ(graph.node(node.args[1]).imm, 5u);
    EXPECT_EQ(graph.node(node.args[1]).type, Type::Int);
}

TEST(Expr, SidesOfAChoiceHaveTheTypeOfItsResult) {
    Graph graph;
    const Bool c(Value{&graph, graph.add(Op::Field, Type::Bool, {}, 0, kDependsColumn)});
    const Float chosen = select(c, Float(1.0f), Float(2.0f));
    const Node& node = graph.node(chosen.bits);
    EXPECT_EQ(node.type, Type::Float);
    EXPECT_EQ(graph.node(node.args[1]).type, Type::Float);
    EXPECT_EQ(graph.node(node.args[2]).type, Type::Float);
}

TEST(Expr, TheSameExpressionIsRecordedOnce) {
    Graph graph;
    const Int x(Value{&graph, graph.add(Op::PosX, Type::Int, {}, 0, kDependsColumn)});
    const Int first = (x + 3) * (3 + x);
    const std::size_t size = graph.size();
    const Int second = (x + 3) * (3 + x);
    EXPECT_EQ(second.bits, first.bits);
    EXPECT_EQ(graph.size(), size);
}

}  // namespace
}  // namespace terrane::gen

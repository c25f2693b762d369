#include "terrane/gen/compile/graph.h"

#include <gtest/gtest.h>

#include <array>
#include <initializer_list>
#include <limits>
#include <vector>

#include "tests/gen/not_a_number.h"

namespace terrane::gen {
namespace {

class GraphTest : public testing::Test {
  protected:
    NodeId add(Op op, Type type, std::initializer_list<NodeId> args, std::uint32_t imm = 0,
               std::uint8_t dependence = kDependsNone) {
        return graph_.add(op, type, {args.begin(), args.size()}, imm, dependence);
    }
    NodeId constant(float v) { return graph_.constant(Type::Float, bitsOf(v)); }
    NodeId constant(std::int32_t v) { return graph_.constant(Type::Int, bitsOf(v)); }
    NodeId constant(bool v) { return graph_.constant(Type::Bool, bitsOf(v)); }

    NodeId x() { return add(Op::PosX, Type::Int, {}, 0, kDependsColumn); }
    NodeId y() { return add(Op::PosY, Type::Int, {}, 0, kDependsColumn); }
    NodeId z() { return add(Op::PosZ, Type::Int, {}, 0, kDependsZ); }
    NodeId f() { return add(Op::Field, Type::Float, {}, 0, kDependsColumn); }
    NodeId g() { return add(Op::Field, Type::Float, {}, 1, kDependsColumn); }
    NodeId c() { return add(Op::Field, Type::Bool, {}, 2, kDependsColumn); }
    NodeId d() { return add(Op::Field, Type::Bool, {}, 3, kDependsColumn); }

    void expectConstant(NodeId id, Type type, Bits bits) {
        ASSERT_TRUE(graph_.isConstant(id));
        EXPECT_EQ(graph_.node(id).type, type);
        EXPECT_EQ(graph_.node(id).imm, bits);
    }

    Graph graph_;
};

TEST_F(GraphTest, ConstantArgumentsAreFolded) {
    expectConstant(add(Op::AddI, Type::Int, {constant(3), constant(4)}), Type::Int, 7);
    expectConstant(add(Op::MulF, Type::Float, {constant(1.5f), constant(-2.0f)}), Type::Float, bitsOf(-3.0f));
    expectConstant(add(Op::LessF, Type::Bool, {constant(1.0f), constant(2.0f)}), Type::Bool, ~Bits{0});
    expectConstant(add(Op::Not, Type::Bool, {constant(true)}), Type::Bool, 0);
    expectConstant(add(Op::FloatToInt, Type::Int, {constant(-3.7f)}), Type::Int, bitsOf(-3));
    expectConstant(add(Op::Select, Type::Float, {constant(false), constant(1.0f), constant(2.0f)}),
                   Type::Float, bitsOf(2.0f));
}

// Every pure operation folds to what its record says.
TEST_F(GraphTest, FoldingUsesTheRecords) {
    constexpr std::array<float, 3> kFloats = {2.5f, -1.25f, 7.0f};
    constexpr std::array<std::int32_t, 3> kInts = {-9, 2, 77};
    for (std::size_t n = 0; n < static_cast<std::size_t>(Op::Count); ++n) {
        const OpRecord& r = record(static_cast<Op>(n));
        if (r.evaluate == nullptr) continue;
        std::vector<NodeId> args;
        std::vector<Bits> bits;
        for (std::size_t k = 0; k < r.argCount; ++k) {
            const bool isChoice = r.op == Op::Select || r.op == Op::Phi;
            const Type type = isChoice && k > 0 ? r.result : r.argTypes[k];
            if (type == Type::Float) bits.push_back(bitsOf(kFloats[k]));
            if (type == Type::Int) bits.push_back(bitsOf(kInts[k]));
            if (type == Type::Bool) bits.push_back(bitsOf(k == 0));
            args.push_back(graph_.constant(type, bits.back()));
        }
        SCOPED_TRACE(r.name);
        expectConstant(graph_.add(r.op, r.result, args), r.result, r.evaluate(bits));
    }
}

TEST_F(GraphTest, RandomNumbersOfConstantPositionsAreNotFolded) {
    const NodeId random = add(Op::Hash2, Type::Int, {constant(1), constant(2)}, 0);
    EXPECT_EQ(graph_.node(random).op, Op::Hash2);
    EXPECT_EQ(graph_.node(random).dependence, kDependsNone);
}

TEST_F(GraphTest, EqualNodesAreOne) {
    const NodeId first = add(Op::SubI, Type::Int, {x(), y()});
    const std::size_t size = graph_.size();
    EXPECT_EQ(add(Op::SubI, Type::Int, {x(), y()}), first);
    EXPECT_EQ(graph_.size(), size);
    EXPECT_NE(add(Op::SubI, Type::Int, {y(), x()}), first);
    EXPECT_NE(add(Op::MinI, Type::Int, {x(), y()}), first);
}

TEST_F(GraphTest, NodesThatDifferInImmediateOrTypeStayTwo) {
    EXPECT_NE(f(), g());
    EXPECT_NE(constant(0), constant(0.0f)) << "equal bits of different types";
    EXPECT_NE(constant(0.0f), constant(-0.0f));
    EXPECT_NE(add(Op::Hash2, Type::Int, {x(), y()}, 0), add(Op::Hash2, Type::Int, {x(), y()}, 1));
    EXPECT_EQ(constant(kNaN), constant(kNaN)) << "compared by bits";
}

TEST_F(GraphTest, SumsMeetInWhateverOrderTheyAreWritten) {
    EXPECT_EQ(add(Op::AddF, Type::Float, {f(), g()}), add(Op::AddF, Type::Float, {g(), f()}));
    EXPECT_EQ(add(Op::MulF, Type::Float, {f(), constant(2.0f)}),
              add(Op::MulF, Type::Float, {constant(2.0f), f()}));
    EXPECT_EQ(add(Op::AddI, Type::Int, {x(), y()}), add(Op::AddI, Type::Int, {y(), x()}));
    EXPECT_EQ(add(Op::AndI, Type::Int, {x(), constant(7)}), add(Op::AndI, Type::Int, {constant(7), x()}));
    EXPECT_EQ(add(Op::EqualF, Type::Bool, {f(), g()}), add(Op::EqualF, Type::Bool, {g(), f()}));
    EXPECT_EQ(add(Op::Or, Type::Bool, {c(), d()}), add(Op::Or, Type::Bool, {d(), c()}));
}

// Min and max choose their first argument where the two are equal zeros, or one is NaN.
TEST_F(GraphTest, WhatDependsOnTheOrderKeepsIt) {
    for (const Op op : {Op::SubF, Op::DivF, Op::MinF, Op::MaxF}) {
        EXPECT_NE(add(op, Type::Float, {f(), g()}), add(op, Type::Float, {g(), f()})) << record(op).name;
    }
    EXPECT_NE(add(Op::LessF, Type::Bool, {f(), g()}), add(Op::LessF, Type::Bool, {g(), f()}));
    EXPECT_NE(add(Op::ShiftRightI, Type::Int, {x(), y()}), add(Op::ShiftRightI, Type::Int, {y(), x()}));
}

TEST_F(GraphTest, NeutralElementsVanish) {
    EXPECT_EQ(add(Op::MulF, Type::Float, {f(), constant(1.0f)}), f());
    EXPECT_EQ(add(Op::MulF, Type::Float, {constant(1.0f), f()}), f());
    EXPECT_EQ(add(Op::AddI, Type::Int, {x(), constant(0)}), x());
    EXPECT_EQ(add(Op::AddI, Type::Int, {constant(0), x()}), x());
    EXPECT_EQ(add(Op::MulI, Type::Int, {constant(1), x()}), x());
    EXPECT_EQ(add(Op::And, Type::Bool, {c(), constant(true)}), c());
    EXPECT_EQ(add(Op::Or, Type::Bool, {constant(false), c()}), c());
    EXPECT_EQ(add(Op::And, Type::Bool, {c(), c()}), c());
    EXPECT_EQ(add(Op::Or, Type::Bool, {c(), c()}), c());
    expectConstant(add(Op::And, Type::Bool, {c(), constant(false)}), Type::Bool, 0);
    expectConstant(add(Op::Or, Type::Bool, {constant(true), c()}), Type::Bool, ~Bits{0});
}

// -0.0 + 0.0 is 0.0; NaN · 0.0 and infinity · 0.0 are NaN; NaN - NaN and infinity - infinity too.
TEST_F(GraphTest, WhatIsNotExactForEveryFloatStays) {
    const auto expectStays = [&](NodeId id, Op op) {
        EXPECT_EQ(graph_.node(id).op, op);
        EXPECT_NE(id, f());
    };
    expectStays(add(Op::AddF, Type::Float, {f(), constant(0.0f)}), Op::AddF);
    expectStays(add(Op::AddF, Type::Float, {f(), constant(-0.0f)}), Op::AddF);
    expectStays(add(Op::SubF, Type::Float, {f(), constant(0.0f)}), Op::SubF);
    expectStays(add(Op::MulF, Type::Float, {f(), constant(0.0f)}), Op::MulF);
    expectStays(add(Op::MulF, Type::Float, {f(), constant(-1.0f)}), Op::MulF);
    expectStays(add(Op::SubF, Type::Float, {f(), f()}), Op::SubF);
    expectStays(add(Op::EqualF, Type::Bool, {f(), f()}), Op::EqualF);
    expectStays(add(Op::LessEqualF, Type::Bool, {f(), f()}), Op::LessEqualF);
    expectStays(add(Op::DivF, Type::Float, {f(), f()}), Op::DivF);
}

TEST_F(GraphTest, ChoicesWithOneAnswerAreTheAnswer) {
    EXPECT_EQ(add(Op::Select, Type::Int, {c(), x(), x()}), x());
    EXPECT_EQ(add(Op::Select, Type::Int, {constant(true), x(), y()}), x());
    EXPECT_EQ(add(Op::Phi, Type::Int, {constant(false), x(), y()}, graph_.newIf()), y());
    EXPECT_EQ(add(Op::Phi, Type::Float, {c(), f(), f()}, graph_.newIf()), f());
    EXPECT_EQ(graph_.node(add(Op::Select, Type::Int, {c(), x(), y()})).op, Op::Select);
}

TEST_F(GraphTest, PhisOfDifferentIfsStayApart) {
    const std::uint32_t first = graph_.newIf(), second = graph_.newIf();
    EXPECT_NE(first, second);
    EXPECT_NE(add(Op::Phi, Type::Int, {c(), x(), y()}, first),
              add(Op::Phi, Type::Int, {c(), x(), y()}, second));
}

TEST_F(GraphTest, DependenceIsThatOfTheArguments) {
    const auto dependence = [&](NodeId id) { return graph_.node(id).dependence; };
    EXPECT_EQ(dependence(constant(1)), kDependsNone);
    EXPECT_EQ(dependence(add(Op::AddI, Type::Int, {x(), constant(1)})), kDependsColumn);
    EXPECT_EQ(dependence(add(Op::AddI, Type::Int, {z(), constant(1)})), kDependsZ);
    EXPECT_EQ(dependence(add(Op::AddI, Type::Int, {x(), z()})), kDependsVoxel);
    EXPECT_EQ(dependence(add(Op::Select, Type::Int, {c(), z(), constant(1)})), kDependsVoxel)
        << "the condition counts";
    EXPECT_EQ(dependence(add(Op::BlockInColumn, Type::Int, {z()}, 0, kDependsColumn)), kDependsVoxel);
}

}  // namespace
}  // namespace terrane::gen

#include "terrane/gen/cpu/kernels.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/gen/pass_runner.h"
#include "tests/gen/random_graph.h"

namespace terrane::gen {
namespace {

// Registers of a test: tiles of 16 rows, then single rows.
constexpr Operand tile(int n) {
    return {static_cast<std::uint16_t>(n * kTileSize), 1};
}
constexpr int kTiles = 6;
constexpr Operand single(int n) {
    return {static_cast<std::uint16_t>(kTiles * kTileSize + n), 0};
}
constexpr int kRows = kTiles * kTileSize + 6;

class KernelTest : public testing::Test {
  protected:
    KernelTest() : arena_(kRows) {
        context_.arena = arena_.front().lanes.data();
        context_.program = &program_;
    }

    Bits& at(Operand o, int lane) {
        const auto row = static_cast<std::size_t>(o.row + o.rowStep * (lane / kRowLanes));
        return arena_[row].lanes[static_cast<std::size_t>(lane % kRowLanes)];
    }

    void fill(Operand o, Type type) {
        const Bits same = randomBits(type, random_);
        for (int lane = 0; lane < kTileLanes; ++lane) {
            at(o, lane) = o.rowStep ? randomBits(type, random_) : same;
        }
    }

    struct Row {
        alignas(64) std::array<Bits, kRowLanes> lanes{};
    };
    std::vector<Row> arena_;
    Program program_;
    TileContext context_;
    std::mt19937 random_{7};
};

// Every way to mix arguments that vary with arguments that do not; the result may take an argument's place.
class OperationTest : public KernelTest {
  protected:
    void check(const OpRecord& r, Type result) {
        const std::uint32_t variants = 1u << r.argCount;
        for (std::uint32_t uniform = 0; uniform < variants; ++uniform) {
            const bool isUniform = uniform + 1 == variants;
            const Operand fresh = isUniform ? single(4) : tile(4);
            ASSERT_NO_FATAL_FAILURE(checkOne(r, result, uniform, fresh));
            for (int k = 0; k < r.argCount; ++k) {
                const bool fits = isUniform == ((uniform >> k & 1) != 0);
                if (!fits) continue;
                ASSERT_NO_FATAL_FAILURE(checkOne(r, result, uniform, place(uniform, k)));
            }
        }
    }

  private:
    static Operand place(std::uint32_t uniform, int argument) {
        return uniform >> argument & 1 ? single(argument) : tile(argument);
    }

    void checkOne(const OpRecord& r, Type result, std::uint32_t uniform, Operand dst) {
        Instruction instruction;
        instruction.op = r.op;
        instruction.dst = dst;
        for (int k = 0; k < r.argCount; ++k) {
            const bool isSide = r.op == Op::Select && k > 0;
            const auto number = static_cast<std::size_t>(k);
            instruction.args[number] = place(uniform, k);
            fill(instruction.args[number], isSide ? result : r.argTypes[number]);
        }
        std::vector<Bits> expected;
        for (int lane = 0; lane < kTileLanes; ++lane) {
            std::array<Bits, 3> args{};
            for (std::size_t k = 0; k < r.argCount; ++k) args[k] = at(instruction.args[k], lane);
            expected.push_back(r.evaluate({args.data(), r.argCount}));
        }
        runInstructions({instruction}, context_);
        for (int lane = 0; lane < kTileLanes; ++lane) {
            const Bits value = at(dst, lane), want = expected[static_cast<std::size_t>(lane)];
            const bool same = result == Type::Float ? sameFloat(value, want) : value == want;
            ASSERT_TRUE(same) << r.name << ", lane " << lane << ": " << value << ", not " << want;
        }
    }
};

TEST_F(OperationTest, EveryOperationIsThatOfItsRecord) {
    onEachTarget([this] {
        for (std::size_t n = 0; n < static_cast<std::size_t>(Op::Count); ++n) {
            const OpRecord& r = record(static_cast<Op>(n));
            if (r.evaluate == nullptr || r.op == Op::Phi || r.op == Op::Select) continue;
            for (int repeat = 0; repeat < 4; ++repeat) ASSERT_NO_FATAL_FAILURE(check(r, r.result));
        }
        for (const Type type : {Type::Bool, Type::Int, Type::Float}) {
            ASSERT_NO_FATAL_FAILURE(check(record(Op::Select), type));
        }
    });
}

TEST_F(KernelTest, AnArgumentMayStandTwice) {
    for (int lane = 0; lane < kTileLanes; ++lane) at(tile(0), lane) = bitsOf(lane - 100);
    runInstructions({{Op::MulI, tile(0), {tile(0), tile(0)}, 0}}, context_);
    for (int lane = 0; lane < kTileLanes; ++lane) {
        ASSERT_EQ(asInt(at(tile(0), lane)), (lane - 100) * (lane - 100));
    }
}

// Rows 0 to 3: no lane takes the branch; 4 to 7: all do; 8 to 15: lane 5 does (does not, in odd rows).
class BranchTest : public KernelTest {
  protected:
    static bool takes(int lane) {
        const int row = lane / kRowLanes;
        if (row < 4) return false;
        if (row < 8) return true;
        return (lane % kRowLanes == 5) == (row % 2 == 0);
    }

    BranchTest() {
        for (int lane = 0; lane < kTileLanes; ++lane) {
            at(tile(0), lane) = bitsOf(takes(lane));
            at(tile(1), lane) = bitsOf(lane);
            at(single(0), lane) = bitsOf(1000);
        }
    }
};

TEST_F(BranchTest, SidesRunOnlyForRowsOfWhichSomeLaneTakesThem) {
    Branch branch;
    branch.condition = tile(0);
    branch.then = {{Op::AddI, tile(2), {tile(1), single(0)}, 0}};
    branch.otherwise = {{Op::SubI, tile(3), {tile(1), single(0)}, 0}};
    branch.phis = {{tile(4), tile(2), tile(3)}};
    program_.branches = {branch};
    onEachTarget([this] {
        for (int lane = 0; lane < kTileLanes; ++lane) at(tile(2), lane) = at(tile(3), lane) = bitsOf(-1);
        runInstructions({{Op::Phi, {}, {}, 0}}, context_);
        for (int lane = 0; lane < kTileLanes; ++lane) {
            const int row = lane / kRowLanes;
            ASSERT_EQ(asInt(at(tile(4), lane)), takes(lane) ? lane + 1000 : lane - 1000);
            ASSERT_EQ(asInt(at(tile(2), lane)), row < 4 ? -1 : lane + 1000) << "row " << row;
            ASSERT_EQ(asInt(at(tile(3), lane)), row >= 4 && row < 8 ? -1 : lane - 1000) << "row " << row;
        }
    });
}

// A phi's result may take the place of a side or of the condition, and a later phi reads what is still there.
TEST_F(BranchTest, PhisAreMovedOneAfterTheOther) {
    Branch branch;
    branch.condition = tile(0);
    branch.then = {{Op::AddI, tile(2), {tile(1), single(0)}, 0}};
    branch.phis = {{tile(2), tile(2), tile(1)}, {tile(0), single(0), tile(2)}};
    program_.branches = {branch};
    runInstructions({{Op::Phi, {}, {}, 0}}, context_);
    for (int lane = 0; lane < kTileLanes; ++lane) {
        ASSERT_EQ(asInt(at(tile(2), lane)), takes(lane) ? lane + 1000 : lane);
        ASSERT_EQ(asInt(at(tile(0), lane)), takes(lane) ? 1000 : lane);
    }
}

TEST_F(BranchTest, NestedBranchesSeeOnlyTheirRows) {
    Branch outer, inner;
    for (int lane = 0; lane < kTileLanes; ++lane) at(tile(5), lane) = bitsOf(lane / kRowLanes >= 6);
    inner.condition = tile(5);
    inner.then = {{Op::AddI, tile(2), {tile(1), single(0)}, 0}};
    inner.otherwise = {{Op::SubI, tile(2), {tile(1), single(0)}, 0}};
    outer.condition = tile(0);
    outer.then = {{Op::Phi, {}, {}, 1}};
    outer.phis = {{tile(4), tile(2), tile(1)}};
    program_.branches = {outer, inner};
    onEachTarget([this] {
        for (int lane = 0; lane < kTileLanes; ++lane) at(tile(2), lane) = bitsOf(-1);
        runInstructions({{Op::Phi, {}, {}, 0}}, context_);
        for (int lane = 0; lane < kTileLanes; ++lane) {
            const int row = lane / kRowLanes, inside = row >= 6 ? lane + 1000 : lane - 1000;
            ASSERT_EQ(asInt(at(tile(2), lane)), row < 4 ? -1 : inside);
            ASSERT_EQ(asInt(at(tile(4), lane)), takes(lane) ? inside : lane);
        }
    });
}

TEST_F(KernelTest, BranchesOnTheSameConditionEverywhereRunOneSide) {
    Branch branch;
    branch.condition = single(0);
    branch.then = {{Op::AddI, single(2), {single(1), single(1)}, 0}};
    branch.otherwise = {{Op::SubI, single(3), {single(1), single(1)}, 0}};
    branch.phis = {{single(4), single(2), single(3)}};
    program_.branches = {branch};
    for (const bool taken : {true, false}) {
        for (int lane = 0; lane < kRowLanes; ++lane) {
            at(single(0), lane) = bitsOf(taken);
            at(single(1), lane) = bitsOf(21);
            at(single(2), lane) = at(single(3), lane) = bitsOf(-1);
        }
        runInstructions({{Op::Phi, {}, {}, 0}}, context_);
        EXPECT_EQ(asInt(at(single(4), 7)), taken ? 42 : 0);
        EXPECT_EQ(asInt(at(single(2), 7)), taken ? 42 : -1);
        EXPECT_EQ(asInt(at(single(3), 7)), taken ? -1 : 0);
    }
}

TEST(SimdTargets, CanBeChosenByName) {
    const std::vector<std::string> targets = simdTargets();
    ASSERT_FALSE(targets.empty());
    for (const std::string& target : targets) EXPECT_TRUE(chooseSimdTarget(target)) << target;
    EXPECT_TRUE(chooseSimdTarget(""));
    EXPECT_FALSE(chooseSimdTarget("abacus"));
}

TEST(SimdTargets, AreTheMachinesAlsoWhileOneIsChosen) {
    const std::vector<std::string> targets = simdTargets();
    ASSERT_TRUE(chooseSimdTarget(targets.back()));
    EXPECT_EQ(simdTargets(), targets);
    EXPECT_TRUE(chooseSimdTarget(""));
}

// Dividends and divisors at the edges of 32 bits, and around multiples of each other.
std::vector<std::pair<std::int32_t, std::int32_t>> divisions() {
    constexpr std::int32_t kLow = std::numeric_limits<std::int32_t>::min(),
                           kHigh = std::numeric_limits<std::int32_t>::max();
    const std::vector<std::int32_t> edges = {kLow, kLow + 1, kLow + 2, -65537, -3,      -2,        -1,   0,
                                             1,    2,        3,        65536,  1 << 30, kHigh - 1, kHigh};
    std::vector<std::pair<std::int32_t, std::int32_t>> result;
    for (const std::int32_t a : edges)
        for (const std::int32_t b : edges) result.emplace_back(a, b);
    std::mt19937 random(3);
    for (int k = 0; k < 3000; ++k) {
        const auto b = static_cast<std::int32_t>(random() >> random() % 32);
        const std::int32_t a =
            wrapped(static_cast<std::int32_t>(random() >> random() % 32) * std::int64_t{b});
        for (const int off : {-1, 0, 1}) result.emplace_back(wrapped(std::int64_t{a} + off), b);
        result.emplace_back(static_cast<std::int32_t>(random()), b);
    }
    while (result.size() % kTileLanes != 0) result.emplace_back(0, 1);
    return result;
}

TEST(FloorDivide, IsThatOfItsRecordAtTheEdges) {
    PassRunner runner(build([](GeneratorBuilder& g) {
        const auto a = g.field<Int>("a"), b = g.field<Int>("b"), quotient = g.field<Int>("quotient");
        g.pass2D("inputs", [&](Pass& p) {
            p.set(a, p.x());
            p.set(b, p.y());
        });
        g.pass2D("divide", [&](Pass& p) { p.set(quotient, floorDivide(p.read(a), p.read(b))); });
        g.pass3D("last", [&](Pass& p) { p.setBlock(Block(p.read(quotient))); });
    }));
    const auto pairs = divisions();
    onEachTarget([&] {
        for (std::size_t first = 0; first < pairs.size(); first += kTileLanes) {
            for (std::size_t k = 0; k < kTileLanes; ++k) {
                runner.fields[0][k] = bitsOf(pairs[first + k].first);
                runner.fields[1][k] = bitsOf(pairs[first + k].second);
            }
            const ColumnValues quotients = runner.run2D(1).front();
            for (std::size_t k = 0; k < kTileLanes; ++k) {
                const std::array<Bits, 2> args = {runner.fields[0][k], runner.fields[1][k]};
                ASSERT_EQ(asInt(quotients[k]), asInt(record(Op::FloorDivideI).evaluate(args)))
                    << asInt(args[0]) << " / " << asInt(args[1]);
            }
        }
    });
}

}  // namespace
}  // namespace terrane::gen

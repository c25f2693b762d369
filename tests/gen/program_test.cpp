#include "terrane/gen/compile/program.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "tests/gen/gen_fixture.h"
#include "tests/gen/random_graph.h"

namespace terrane::gen {
namespace {

Program compileLast(const GeneratorGraph& g) {
    return compile(g.passes.back(), g.noises);
}

Program compiled(const std::function<void(Pass&)>& pass) {
    return compileLast(build([&](GeneratorBuilder& g) { g.pass3D("pass", pass); }));
}

bool has(const InstructionList& list, Op op) {
    return std::any_of(list.begin(), list.end(), [&](const Instruction& i) { return i.op == op; });
}

// With the instructions of branches.
std::size_t countAll(const Program& program, Op op) {
    const auto in = [&](const InstructionList& list) {
        return std::count_if(list.begin(), list.end(), [&](const Instruction& i) { return i.op == op; });
    };
    auto count = in(program.column) + in(program.layer);
    for (const Branch& b : program.branches) count += in(b.then) + in(b.otherwise);
    for (const ProgramLoop& l : program.loops) count += in(l.head) + in(l.body);
    return static_cast<std::size_t>(count);
}

TEST(Program, WhatIsFreeOfZIsComputedOnceAChunk) {
    const Program program = compiled([](Pass& p) { p.setBlock(Block((p.x() * p.y() - 7) & p.z())); });
    EXPECT_TRUE(has(program.column, Op::MulI));
    EXPECT_TRUE(has(program.column, Op::SubI));
    EXPECT_FALSE(has(program.layer, Op::MulI));
    EXPECT_EQ(program.layer.size(), 1u);
    EXPECT_TRUE(has(program.layer, Op::AndI));
}

TEST(Program, WhatDependsOnlyOnZIsOneRow) {
    const Program program = compiled([](Pass& p) { p.setBlock(Block(p.z() * 3 + p.x())); });
    const auto isProduct = [](const Instruction& i) { return i.op == Op::MulI; };
    const auto product = std::find_if(program.layer.begin(), program.layer.end(), isProduct);
    ASSERT_NE(product, program.layer.end());
    EXPECT_EQ(product->dst.rowStep, 0);
    ASSERT_TRUE(program.block.has_value());
    EXPECT_EQ(program.block->rowStep, 1);
}

TEST(Program, ABlockThatIsTheSameEverywhereNeedsNoInstruction) {
    const Program program = compiled([](Pass& p) { p.setBlock(p.block("stone")); });
    EXPECT_TRUE(program.column.empty());
    EXPECT_TRUE(program.layer.empty());
    ASSERT_TRUE(program.block.has_value());
    EXPECT_EQ(program.constants[program.block->row], 1u);
}

TEST(Program, OnlyNoiseThatIsNeededIsCalled) {
    const Program program = compiled([](Pass& p) {
        const Float unused = p.perlin2D("unused", 8, {1.0f}) * 3.0f;
        static_cast<void>(unused);
        p.setBlock(Block(Int(p.perlin2D("used", 8, {1.0f}) * 9.0f) & p.z()));
    });
    EXPECT_EQ(countAll(program, Op::Noise), 1u);
}

TEST(Program, ResultsOfOneNoiseCallShareIt) {
    const Program program = compiled([](Pass& p) {
        const Voronoi2D v = p.voronoi2D("cells", 20, 1);
        p.setBlock(Block(Int(v.distance) + v.offset.x + v.offset.y + Int(v.ratio * 50.0f)));
    });
    EXPECT_EQ(countAll(program, Op::Noise), 1u);
}

TEST(Program, WhatABranchNeedsStandsInTheBranch) {
    const Program program = compiled([](Pass& p) {
        Var<Int> v = p.var(Int(0));
        p.if_(p.z() < 9, [&] { v = Int(p.perlin3D("inside", 8, {1.0f}) * 9.0f); });
        p.setBlock(Block(static_cast<Int>(v)));
    });
    ASSERT_EQ(program.branches.size(), 1u);
    EXPECT_TRUE(has(program.branches[0].then, Op::Noise));
    EXPECT_TRUE(program.branches[0].otherwise.empty());
    EXPECT_FALSE(has(program.layer, Op::Noise));
    EXPECT_TRUE(has(program.layer, Op::Phi));
}

TEST(Program, AnIfWithNothingToComputeIsAChoice) {
    const Program program = compiled([](Pass& p) {
        Var<Int> v = p.var(Int(4));
        p.if_(
            p.z() < 9, [&] { v = p.x(); }, [&] { v = p.y(); });
        p.setBlock(Block(static_cast<Int>(v)));
    });
    EXPECT_TRUE(program.branches.empty());
    EXPECT_TRUE(has(program.layer, Op::Select));
}

// 200 sums, of which never more than two are alive.
TEST(Program, RegistersAreUsedAgain) {
    const Program program = compiled([](Pass& p) {
        Int sum = p.x() * p.z();
        for (int k = 1; k <= 200; ++k) sum = (sum + k) * p.y();
        p.setBlock(Block(sum));
    });
    EXPECT_EQ(countAll(program, Op::AddI), 200u);
    const std::size_t constants = program.constants.size();
    EXPECT_LE(program.arenaRows, constants + 6 * kTileSize);
}

// Gathers the rows that an instruction list and its branches read and write.
class Rows {
  public:
    Rows(const Program& program, const std::vector<NoiseCall>& noises) : program_(program), noises_(noises) {}

    void add(const InstructionList& list) {
        for (const Instruction& i : list) {
            if (i.op == Op::Phi) {
                addBranch(program_.branches[i.imm]);
                continue;
            }
            if (i.op == Op::LoopOut) {
                addLoop(program_.loops[i.imm]);
                continue;
            }
            for (std::size_t k = 0; k < record(i.op).argCount; ++k) addRead(i.args[k]);
            addWritten(i.dst, makesNoise(i.op) ? resultCount(noises_[i.imm].kind) : 1);
        }
    }

    std::set<std::uint32_t> read, written;
    std::set<std::uint32_t> given;  // read before the list writes them

  private:
    void addBranch(const Branch& branch) {
        addRead(branch.condition);
        add(branch.then);
        add(branch.otherwise);
        for (const PhiMove& move : branch.phis) {
            addRead(move.then);
            addRead(move.otherwise);
            addWritten(move.dst, 1);
        }
    }

    void addLoop(const ProgramLoop& loop) {
        for (const LoopMove& v : loop.variables) {
            addRead(v.initial);
            addWritten(v.in, 1);
        }
        add(loop.head);
        addRead(loop.condition);
        add(loop.body);
        for (const LoopMove& v : loop.variables) {
            addRead(v.next);
            addWritten(v.changed, 1);
        }
    }

    void addRead(Operand o) {
        for (std::uint32_t r = 0; r < rowCount(o); ++r) {
            read.insert(o.row + r);
            if (!written.contains(o.row + r)) given.insert(o.row + r);
        }
    }
    void addWritten(Operand o, std::uint32_t results) {
        for (std::uint32_t r = 0; r < rowCount(o) * results; ++r) written.insert(o.row + r);
    }
    static std::uint32_t rowCount(Operand o) { return o.rowStep == 0 ? 1 : kTileSize; }

    const Program& program_;
    const std::vector<NoiseCall>& noises_;
};

// Rows that the executor fills once per chunk: constants and positions.
std::set<std::uint32_t> filledRows(const Program& program) {
    std::set<std::uint32_t> rows = {program.z.row};
    for (std::uint32_t k = 0; k < program.constants.size(); ++k) rows.insert(k);
    for (std::uint32_t r = 0; r < kTileSize; ++r) rows.insert({program.x.row + r, program.y.row + r});
    return rows;
}

TEST(ProgramRandom, RowsLieInTheArenaAndInputsStay) {
    std::size_t branches = 0;
    for (std::uint32_t seed = 0; seed < 400; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const GeneratorGraph g = RandomGraph(seed, seed % 2 == 0).take();
        const Program program = compileLast(g);
        branches += program.branches.size();
        Rows rows(program, g.noises);
        rows.add(program.column);
        rows.add(program.layer);
        const std::set<std::uint32_t> filled = filledRows(program);
        for (const std::uint32_t row : rows.written) {
            ASSERT_LT(row, program.arenaRows);
            ASSERT_FALSE(filled.contains(row)) << row;
        }
        for (const std::uint32_t row : rows.read) {
            ASSERT_TRUE(filled.contains(row) || rows.written.contains(row))
                << row << " is read but never set";
        }
    }
    EXPECT_GT(branches, 400u) << "random passes have branches in them";
}

// Layers run 256 times: each run must find the same inputs.
TEST(ProgramRandom, LayersDoNotWriteOverWhatTheyAreGiven) {
    for (std::uint32_t seed = 0; seed < 400; seed += 2) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const GeneratorGraph g = RandomGraph(seed, true).take();
        const Program program = compileLast(g);
        Rows rows(program, g.noises);
        rows.add(program.layer);
        for (const std::uint32_t row : rows.given) ASSERT_FALSE(rows.written.contains(row)) << row;
    }
}

// Each round must find the same inputs; only the loop's variables change.
TEST(ProgramRandom, RoundsDoNotWriteOverWhatTheyAreGiven) {
    std::size_t loops = 0;
    for (std::uint32_t seed = 0; seed < 400; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        const GeneratorGraph g = RandomGraph(seed, seed % 2 == 0).take();
        const Program program = compileLast(g);
        loops += program.loops.size();
        for (const ProgramLoop& loop : program.loops) {
            Rows rows(program, g.noises);
            rows.add(loop.head);
            rows.add(loop.body);
            for (const std::uint32_t row : rows.given) ASSERT_FALSE(rows.written.contains(row)) << row;
        }
    }
    EXPECT_GT(loops, 100u) << "random passes have loops in them";
}

}  // namespace
}  // namespace terrane::gen

#include "terrane/gen/compile/schedule.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <string>
#include <vector>

#include "tests/gen/random_graph.h"

namespace terrane::gen {
namespace {

class ScheduleTest : public testing::Test {
  protected:
    NodeId add(Op op, Type type, std::initializer_list<NodeId> args, std::uint32_t imm = 0) {
        return graph_.add(op, type, {args.begin(), args.size()}, imm, args.size() == 0 ? kDependsColumn : 0);
    }
    NodeId x() { return add(Op::PosX, Type::Int, {}); }
    NodeId y() { return add(Op::PosY, Type::Int, {}); }
    NodeId condition(std::uint32_t n) { return add(Op::Field, Type::Bool, {}, n); }
    NodeId plus(NodeId a, NodeId b) { return add(Op::AddI, Type::Int, {a, b}); }
    NodeId times(NodeId a, NodeId b) { return add(Op::MulI, Type::Int, {a, b}); }
    NodeId phi(std::uint32_t number, NodeId c, NodeId then, NodeId otherwise) {
        return add(Op::Phi, Type::Int, {c, then, otherwise}, number);
    }

    void run(std::initializer_list<NodeId> roots, std::initializer_list<NodeId> inputs = {}) {
        const std::vector<NodeId> given(inputs);
        const auto isInput = [&](NodeId id) {
            return std::find(given.begin(), given.end(), id) != given.end();
        };
        schedule_ = schedule(graph_, std::vector<NodeId>(roots), isInput);
    }

    // The basic block that holds a node, or -1.
    int basicBlockOf(NodeId id) const {
        for (std::size_t r = 0; r < schedule_.basicBlocks.size(); ++r) {
            const auto& nodes = schedule_.basicBlocks[r].nodes;
            if (std::find(nodes.begin(), nodes.end(), id) != nodes.end()) return static_cast<int>(r);
        }
        return -1;
    }
    int thenOf(std::uint32_t number) const { return schedule_.ifs[number].thenBlock; }
    int elseOf(std::uint32_t number) const { return schedule_.ifs[number].elseBlock; }

    Graph graph_;
    Schedule schedule_;
};

TEST_F(ScheduleTest, StraightCodeStandsInTheRootInOrder) {
    const NodeId first = x(), second = y(), sum = plus(first, second), product = times(sum, first);
    run({product});
    ASSERT_EQ(schedule_.basicBlocks.size(), 1u);
    const std::vector<NodeId> order = {first, second, sum, product};
    EXPECT_EQ(schedule_.basicBlocks[0].nodes, order);
}

TEST_F(ScheduleTest, WhatNobodyNeedsIsLeftOut) {
    const NodeId unused = times(x(), x()), sum = plus(x(), y());
    run({sum});
    EXPECT_EQ(basicBlockOf(unused), -1);
    EXPECT_EQ(basicBlockOf(sum), 0);
}

TEST_F(ScheduleTest, InputsEndTheSearch) {
    const NodeId sum = plus(x(), y()), product = times(sum, x());
    run({product}, {sum, x()});
    EXPECT_EQ(basicBlockOf(sum), -1);
    EXPECT_EQ(basicBlockOf(y()), -1);
    EXPECT_EQ(basicBlockOf(product), 0);
}

TEST_F(ScheduleTest, ARootThatIsAnInputNeedsNothing) {
    const NodeId sum = plus(x(), y());
    run({sum}, {sum});
    EXPECT_TRUE(schedule_.basicBlocks[0].nodes.empty());
}

TEST_F(ScheduleTest, WhatOneSideNeedsStandsInIt) {
    const NodeId left = times(x(), y()), right = plus(x(), y());
    const NodeId result = phi(graph_.newIf(), condition(0), left, right);
    run({result});
    EXPECT_EQ(basicBlockOf(left), thenOf(0));
    EXPECT_EQ(basicBlockOf(right), elseOf(0));
    EXPECT_EQ(basicBlockOf(result), 0);
    EXPECT_EQ(basicBlockOf(condition(0)), 0);
    EXPECT_EQ(basicBlockOf(x()), 0) << "both sides need it";
    EXPECT_EQ(schedule_.basicBlocks[static_cast<std::size_t>(thenOf(0))].parent, 0);
    EXPECT_EQ(schedule_.basicBlocks[static_cast<std::size_t>(thenOf(0))].depth, 1);
}

TEST_F(ScheduleTest, WhatBothSidesOrTheOutsideNeedStandsBeforeTheIf) {
    const NodeId shared = times(x(), y()), after = times(x(), x());
    const NodeId result = phi(graph_.newIf(), condition(0), plus(shared, x()), plus(shared, after));
    run({plus(result, after)});
    EXPECT_EQ(basicBlockOf(shared), 0);
    EXPECT_EQ(basicBlockOf(after), 0);
}

TEST_F(ScheduleTest, IfsNestByWhoNeedsThem) {
    const std::uint32_t inner = graph_.newIf(), outer = graph_.newIf();
    const NodeId deep = times(x(), y());
    const NodeId innerPhi = phi(inner, condition(0), deep, x());
    const NodeId result = phi(outer, condition(1), plus(innerPhi, y()), y());
    run({result});
    EXPECT_EQ(basicBlockOf(innerPhi), thenOf(outer));
    EXPECT_EQ(basicBlockOf(condition(0)), thenOf(outer)) << "the inner condition is needed only there";
    EXPECT_EQ(basicBlockOf(deep), thenOf(inner));
    EXPECT_EQ(schedule_.basicBlocks[static_cast<std::size_t>(thenOf(inner))].parent, thenOf(outer));
    EXPECT_EQ(schedule_.basicBlocks[static_cast<std::size_t>(thenOf(inner))].depth, 2);
}

TEST_F(ScheduleTest, ValuesOfSiblingsMeetAtTheirParent) {
    const std::uint32_t first = graph_.newIf(), second = graph_.newIf(), outer = graph_.newIf();
    const NodeId shared = times(x(), y());
    const NodeId a = phi(first, condition(0), plus(shared, x()), x());
    const NodeId b = phi(second, condition(1), plus(shared, y()), x());
    run({phi(outer, condition(2), plus(a, b), y())});
    EXPECT_EQ(basicBlockOf(shared), thenOf(outer));
}

// One if may join several values: it runs where all of them are needed, though some are needed deeper.
TEST_F(ScheduleTest, PhisOfAnIfStayTogether) {
    const std::uint32_t inner = graph_.newIf(), outer = graph_.newIf();
    const NodeId deep = times(x(), y()), other = plus(x(), y());
    const NodeId a = phi(inner, condition(0), deep, x()), b = phi(inner, condition(0), other, y());
    const NodeId result = phi(outer, condition(1), plus(a, x()), y());
    run({result, b});
    EXPECT_EQ(basicBlockOf(a), 0) << "b is wanted outside, so the whole if stands there";
    EXPECT_EQ(basicBlockOf(b), 0);
    EXPECT_EQ(basicBlockOf(deep), thenOf(inner));
    EXPECT_EQ(basicBlockOf(other), thenOf(inner));
    const std::vector<NodeId> both = {a, b};
    EXPECT_EQ(schedule_.ifs[inner].phis, both);
}

TEST_F(ScheduleTest, AnUnusedPhiDoesNotHoldItsIfOutside) {
    const std::uint32_t inner = graph_.newIf(), outer = graph_.newIf();
    const NodeId a = phi(inner, condition(0), times(x(), y()), x());
    const NodeId unused = phi(inner, condition(0), plus(x(), y()), y());
    run({phi(outer, condition(1), plus(a, x()), y())});
    EXPECT_EQ(basicBlockOf(a), thenOf(outer));
    EXPECT_EQ(basicBlockOf(unused), -1);
    EXPECT_EQ(schedule_.ifs[inner].phis, std::vector<NodeId>{a});
}

// Walks a schedule in the order in which it runs, and checks that every node's arguments were there.
class Walk {
  public:
    Walk(const Graph& graph, const Schedule& s) : graph_(graph), schedule_(s), seen_(graph.size()) {}

    // `available`: by node, what can be read in this basic block.
    void basicBlock(int number, std::vector<bool>& available) {
        for (const NodeId id : schedule_.basicBlocks[static_cast<std::size_t>(number)].nodes) {
            ASSERT_FALSE(seen_[id]) << "node " << id << " stands twice";
            seen_[id] = true;
            const Node& n = graph_.node(id);
            if (const Schedule::If* branch = schedule_.ifAt(graph_, id)) {
                ASSERT_NO_FATAL_FAILURE(branches(*branch, available));
            } else if (const Schedule::Loop* loop = schedule_.loopAt(graph_, id)) {
                ASSERT_NO_FATAL_FAILURE(rounds(*loop, available));
            } else if (n.op == Op::Phi || n.op == Op::LoopIn || n.op == Op::LoopOut) {
                ASSERT_TRUE(available[id]) << "it stands before its if or loop";
            } else {
                for (const NodeId arg : n.arguments()) ASSERT_TRUE(available[arg]) << id << " reads " << arg;
                available[id] = true;
            }
        }
    }

    bool hasSeen(NodeId id) const { return seen_[id]; }

  private:
    void branches(const Schedule::If& branch, std::vector<bool>& available) {
        std::vector<bool> then = available, otherwise = available;
        ASSERT_NO_FATAL_FAILURE(basicBlock(branch.thenBlock, then));
        ASSERT_NO_FATAL_FAILURE(basicBlock(branch.elseBlock, otherwise));
        for (const NodeId phi : branch.phis) {
            const Node& n = graph_.node(phi);
            ASSERT_TRUE(available[n.args[0]]);
            ASSERT_TRUE(then[n.args[1]]);
            ASSERT_TRUE(otherwise[n.args[2]]);
        }
        for (const NodeId phi : branch.phis) available[phi] = true;
    }

    void rounds(const Schedule::Loop& loop, std::vector<bool>& available) {
        std::vector<bool> inside = available;
        for (const std::uint32_t v : loop.variables) {
            ASSERT_TRUE(available[graph_.loopVariable(v).initial]);
            inside[graph_.loopVariable(v).in] = true;
        }
        ASSERT_NO_FATAL_FAILURE(basicBlock(loop.head, inside));
        const std::int32_t number = graph_.loopVariable(loop.variables.front()).loop;
        ASSERT_TRUE(inside[graph_.loops()[static_cast<std::size_t>(number)].condition]);
        ASSERT_NO_FATAL_FAILURE(basicBlock(loop.body, inside));
        for (const std::uint32_t v : loop.variables) ASSERT_TRUE(inside[graph_.loopVariable(v).next]);
        for (const NodeId out : loop.outs) available[out] = true;
    }

    const Graph& graph_;
    const Schedule& schedule_;
    std::vector<bool> seen_;
};

std::vector<bool> neededBy(const Graph& graph, std::vector<NodeId> stack) {
    std::vector<bool> needed(graph.size());
    while (!stack.empty()) {
        const NodeId id = stack.back();
        stack.pop_back();
        if (needed[id]) continue;
        needed[id] = true;
        const Node& n = graph.node(id);
        stack.insert(stack.end(), n.arguments().begin(), n.arguments().end());
        if (n.op != Op::LoopIn) continue;
        stack.push_back(graph.loopVariable(n.imm).next);
        stack.push_back(graph.loops()[static_cast<std::size_t>(n.loop)].condition);
    }
    return needed;
}

TEST(ScheduleRandom, EveryNeededNodeStandsOnceAndAfterItsArguments) {
    for (std::uint32_t seed = 0; seed < 500; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        RandomGraph random(seed, seed % 2 == 0);
        const std::vector<NodeId> roots = random.someNodes();
        const Graph& graph = random.graph();
        const Schedule s = schedule(graph, roots, [](NodeId) { return false; });
        Walk walk(graph, s);
        std::vector<bool> available(graph.size());
        ASSERT_NO_FATAL_FAILURE(walk.basicBlock(0, available));
        const std::vector<bool> needed = neededBy(graph, roots);
        for (NodeId id = 0; id < graph.size(); ++id) ASSERT_EQ(walk.hasSeen(id), needed[id]) << id;
        for (const NodeId root : roots) ASSERT_TRUE(available[root]);
    }
}

int commonBasicBlock(const Schedule& s, int a, int b) {
    const auto at = [&](int r) -> const BasicBlock& { return s.basicBlocks[static_cast<std::size_t>(r)]; };
    while (a != b) {
        if (at(a).depth >= at(b).depth) {
            a = at(a).parent;
        } else {
            b = at(b).parent;
        }
    }
    return a;
}

// By node: the innermost basic block that contains all of its uses.
std::vector<int> deepestBasicBlocks(const Graph& graph, const Schedule& s, const std::vector<NodeId>& roots) {
    std::vector<int> deepest(graph.size(), -1);
    const auto use = [&](NodeId id, int basicBlock) {
        deepest[id] = deepest[id] < 0 ? basicBlock : commonBasicBlock(s, deepest[id], basicBlock);
    };
    for (const NodeId root : roots) use(root, 0);
    for (std::size_t r = 0; r < s.basicBlocks.size(); ++r) {
        for (const NodeId id : s.basicBlocks[r].nodes) {
            const Node& n = graph.node(id);
            if (n.op == Op::Phi) {
                use(n.args[0], static_cast<int>(r));
                use(n.args[1], s.ifs[n.imm].thenBlock);
                use(n.args[2], s.ifs[n.imm].elseBlock);
            } else {
                for (const NodeId arg : n.arguments()) use(arg, static_cast<int>(r));
            }
        }
    }
    return deepest;
}

TEST(ScheduleRandom, EveryNodeStandsAsDeepAsItsUsesAllow) {
    for (std::uint32_t seed = 0; seed < 300; ++seed) {
        SCOPED_TRACE("seed " + std::to_string(seed));
        RandomGraph random(seed, false, false);
        const std::vector<NodeId> roots = random.someNodes();
        const Graph& graph = random.graph();
        const Schedule s = schedule(graph, roots, [](NodeId) { return false; });
        const std::vector<int> deepest = deepestBasicBlocks(graph, s, roots);
        for (std::size_t r = 0; r < s.basicBlocks.size(); ++r) {
            for (const NodeId id : s.basicBlocks[r].nodes) {
                if (graph.node(id).op == Op::Phi) continue;  // phis of an if wait for each other
                ASSERT_EQ(deepest[id], static_cast<int>(r)) << id;
            }
        }
    }
}

// A loop that counts `c` from zero while it is below x.
class LoopScheduleTest : public ScheduleTest {
  protected:
    // The count after the loop; `step` makes what is added from the count in the round.
    template <class Step>
    NodeId count(Step step) {
        loop_ = graph_.beginLoop();
        const std::uint32_t v =
            graph_.addLoopVariable(Type::Int, graph_.constant(Type::Int, 0), kDependsColumn);
        in_ = graph_.loopVariable(v).in;
        condition_ = add(Op::LessI, Type::Bool, {in_, x()});
        const std::array<NodeId, 1> next = {plus(in_, step(in_))};
        graph_.endLoop(condition_, next);
        return graph_.loopVariable(v).out;
    }
    const Schedule::Loop& loop() const { return schedule_.loops[static_cast<std::size_t>(loop_)]; }

    std::int32_t loop_ = kNoLoop;
    NodeId in_ = 0, condition_ = 0;
};

TEST_F(LoopScheduleTest, WhatDoesNotChangeStandsBeforeTheLoop) {
    const NodeId fixed = times(x(), y());
    NodeId changing = 0;
    const NodeId out = count([&](NodeId in) { return plus(fixed, changing = times(in, in)); });
    run({out});
    EXPECT_EQ(basicBlockOf(out), 0);
    EXPECT_EQ(basicBlockOf(fixed), 0);
    EXPECT_EQ(basicBlockOf(condition_), loop().head);
    EXPECT_EQ(basicBlockOf(in_), loop().head);
    EXPECT_EQ(basicBlockOf(changing), loop().body);
}

TEST_F(LoopScheduleTest, ALoopThatOneSideNeedsStandsInIt) {
    const NodeId out = count([&](NodeId) { return y(); });
    run({phi(graph_.newIf(), condition(0), out, x())});
    EXPECT_EQ(basicBlockOf(out), thenOf(0));
    EXPECT_EQ(schedule_.basicBlocks[static_cast<std::size_t>(loop().head)].parent, thenOf(0));
}

TEST_F(LoopScheduleTest, AnUnusedLoopIsLeftOut) {
    const NodeId out = count([&](NodeId) { return y(); });
    run({x()});
    EXPECT_EQ(basicBlockOf(out), -1);
    EXPECT_TRUE(loop().outs.empty());
}

// One phi changes from round to round and stays in the loop, the other one does not.
TEST_F(LoopScheduleTest, AnIfOfWhichOnePartChangesIsTwoIfs) {
    NodeId steady = 0, changing = 0;
    const NodeId out = count([&](NodeId in) {
        const std::uint32_t number = graph_.newIf();
        steady = phi(number, condition(0), times(x(), y()), y());
        changing = phi(number, condition(0), times(in, in), x());
        return plus(steady, changing);
    });
    run({out});
    EXPECT_EQ(basicBlockOf(steady), 0);
    EXPECT_EQ(basicBlockOf(changing), loop().body);
    EXPECT_EQ(schedule_.ifs.size(), 2u);
}

TEST_F(LoopScheduleTest, AValueThatLeavesOtherwiseThanThroughAVariableIsNoticed) {
    NodeId inside = 0;
    count([&](NodeId in) { return inside = times(in, in); });
    EXPECT_FALSE(graph_.leaksOutOfLoop());
    plus(inside, x());
    EXPECT_TRUE(graph_.leaksOutOfLoop());
}

}  // namespace
}  // namespace terrane::gen

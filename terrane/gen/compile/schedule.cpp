#include "terrane/gen/compile/schedule.h"

#include <algorithm>
#include <cassert>

namespace terrane::gen {
namespace {

constexpr int kNowhere = -1;

class Scheduler {
  public:
    Scheduler(const Graph& graph, const std::function<bool(NodeId)>& isInput)
        : graph_(graph), isInput_(isInput), live_(graph.size(), false) {
        result_.basicBlocks.push_back({});
        result_.basicBlockOf.assign(graph.size(), kNowhere);
        result_.ifOf.assign(graph.size(), 0);
        result_.ifs.resize(graph.ifCount());
        result_.loops.resize(graph.loops().size());
    }

    Schedule run(const std::vector<NodeId>& roots) {
        for (const NodeId root : roots) {
            markLive(root);
            use(root, 0);
        }
        collectBranches();
        // Users stand behind their arguments: backwards, every use of a node is known before the node is
        // placed.
        for (NodeId id = static_cast<NodeId>(graph_.size()); id-- > 0;) {
            if (live_[id]) placeArguments(id);
        }
        for (NodeId id = 0; id < graph_.size(); ++id) {
            if (live_[id]) basicBlock(result_.basicBlockOf[id]).nodes.push_back(id);
        }
        return std::move(result_);
    }

  private:
    BasicBlock& basicBlock(int number) { return result_.basicBlocks[static_cast<std::size_t>(number)]; }
    const Loop& loop(std::int32_t number) const { return graph_.loops()[static_cast<std::size_t>(number)]; }

    void markLive(NodeId root) {
        std::vector<NodeId> stack{root};
        while (!stack.empty()) {
            const NodeId id = stack.back();
            stack.pop_back();
            if (live_[id] || isInput_(id)) continue;
            live_[id] = true;
            const Node& n = graph_.node(id);
            stack.insert(stack.end(), n.arguments().begin(), n.arguments().end());
            if (n.op == Op::LoopIn) {
                stack.push_back(graph_.loopVariable(n.imm).next);
                stack.push_back(loop(n.loop).condition);
            }
        }
    }

    void collectBranches() {
        for (NodeId id = 0; id < graph_.size(); ++id) {
            if (!live_[id]) continue;
            const Node& n = graph_.node(id);
            if (n.op == Op::Phi) addPhi(id);
            if (n.op == Op::LoopIn)
                result_.loops[static_cast<std::size_t>(n.loop)].variables.push_back(n.imm);
            if (n.op == Op::LoopOut) loopOf(n).outs.push_back(id);
        }
    }

    Schedule::Loop& loopOf(const Node& out) {
        return result_.loops[static_cast<std::size_t>(graph_.loopVariable(out.imm).loop)];
    }

    void addPhi(NodeId id) {
        const auto sameLoop = [&](const Schedule::If& branch) {
            return branch.phis.empty() || graph_.node(branch.phis.front()).loop == graph_.node(id).loop;
        };
        std::uint32_t number = graph_.node(id).imm;
        if (!sameLoop(result_.ifs[number])) {
            // The phis of an if are made one after the other: its second half is the last entry or does not
            // exist yet.
            const bool isFirst = result_.ifs.size() == graph_.ifCount() ||
                                 graph_.node(result_.ifs.back().phis.front()).imm != number ||
                                 !sameLoop(result_.ifs.back());
            if (isFirst) result_.ifs.emplace_back();
            number = static_cast<std::uint32_t>(result_.ifs.size()) - 1;
        }
        result_.ifs[number].phis.push_back(id);
        result_.ifOf[id] = number;
    }

    void placeArguments(NodeId id) {
        const Node& n = graph_.node(id);
        const int here = result_.basicBlockOf[id];
        if (n.op == Op::Phi) {
            const Schedule::If& branch = openIf(result_.ifOf[id]);
            use(n.args[0], result_.basicBlockOf[id]);
            use(n.args[1], branch.thenBlock);
            use(n.args[2], branch.elseBlock);
        } else if (n.op == Op::LoopOut) {
            openLoop(graph_.loopVariable(n.imm).loop);
        } else if (n.op == Op::LoopIn) {
            use(n.args[0], basicBlock(here).parent);
        } else {
            for (const NodeId arg : n.arguments()) use(arg, here);
        }
    }

    // All phis of an if stand in one basic block: the innermost that holds the uses of all of them. Its phis
    // were made one after the other, before any use of one, so at the last of them the uses of all are known.
    const Schedule::If& openIf(std::uint32_t number) {
        Schedule::If& branch = result_.ifs[number];
        if (branch.thenBlock != kNowhere) return branch;
        const int around = gather(branch.phis);
        branch.thenBlock = newBasicBlock(around, basicBlock(around).loop);
        branch.elseBlock = newBasicBlock(around, basicBlock(around).loop);
        return branch;
    }

    // The same for a loop and the last values of its variables.
    void openLoop(std::int32_t number) {
        Schedule::Loop& result = result_.loops[static_cast<std::size_t>(number)];
        if (result.head != kNowhere) return;
        result.head = newBasicBlock(gather(result.outs), number);
        result.body = newBasicBlock(result.head, number);
        for (const std::uint32_t v : result.variables) {
            const LoopVariable& variable = graph_.loopVariable(v);
            result_.basicBlockOf[variable.in] = result.head;
            use(variable.next, result.body);
        }
        use(loop(number).condition, result.head);
    }

    // Puts nodes into the innermost basic block that holds the uses of all of them.
    int gather(const std::vector<NodeId>& nodes) {
        int common = kNowhere;
        for (const NodeId id : nodes) common = commonBasicBlock(common, result_.basicBlockOf[id]);
        for (const NodeId id : nodes) result_.basicBlockOf[id] = common;
        return common;
    }

    int newBasicBlock(int parent, std::int32_t loop) {
        result_.basicBlocks.push_back({parent, basicBlock(parent).depth + 1, loop, {}});
        return static_cast<int>(result_.basicBlocks.size()) - 1;
    }

    void use(NodeId id, int user) {
        assert(user != kNowhere && "a user is placed before its arguments");
        if (!live_[id]) return;
        // Values that do not change in a loop are computed before it.
        while (basicBlock(user).loop != graph_.node(id).loop) {
            assert(basicBlock(user).loop != kNoLoop && "values leave a loop through its variables");
            user = basicBlock(result_.loops[static_cast<std::size_t>(basicBlock(user).loop)].head).parent;
        }
        result_.basicBlockOf[id] = commonBasicBlock(result_.basicBlockOf[id], user);
    }

    int commonBasicBlock(int a, int b) {
        if (a == kNowhere) return b;
        if (b == kNowhere) return a;
        while (a != b) {
            if (basicBlock(a).depth >= basicBlock(b).depth) {
                a = basicBlock(a).parent;
            } else {
                b = basicBlock(b).parent;
            }
        }
        return a;
    }

    const Graph& graph_;
    const std::function<bool(NodeId)>& isInput_;
    std::vector<bool> live_;
    Schedule result_;
};

}  // namespace

const Schedule::If* Schedule::ifAt(const Graph& graph, NodeId id) const {
    if (graph.node(id).op != Op::Phi) return nullptr;
    const If& branch = ifs[ifOf[id]];
    return branch.phis.front() == id ? &branch : nullptr;
}

const Schedule::Loop* Schedule::loopAt(const Graph& graph, NodeId id) const {
    const Node& n = graph.node(id);
    if (n.op != Op::LoopOut) return nullptr;
    const Loop& loop = loops[static_cast<std::size_t>(graph.loopVariable(n.imm).loop)];
    return loop.outs.front() == id ? &loop : nullptr;
}

Schedule schedule(const Graph& graph, const std::vector<NodeId>& roots,
                  const std::function<bool(NodeId)>& isInput) {
    return Scheduler(graph, isInput).run(roots);
}

std::vector<NodeId> columnBoundary(const Graph& graph, const std::vector<NodeId>& outputs) {
    std::vector<NodeId> result, stack = outputs;
    std::vector<bool> seen(graph.size());
    while (!stack.empty()) {
        const NodeId id = stack.back();
        stack.pop_back();
        if (seen[id]) continue;
        seen[id] = true;
        if (!(graph.node(id).dependence & kDependsZ)) {
            result.push_back(id);
            continue;
        }
        const Node& n = graph.node(id);
        stack.insert(stack.end(), n.arguments().begin(), n.arguments().end());
        if (n.op != Op::LoopIn) continue;
        stack.push_back(graph.loopVariable(n.imm).next);
        stack.push_back(graph.loops()[static_cast<std::size_t>(n.loop)].condition);
    }
    std::sort(result.begin(), result.end());
    return result;
}

}  // namespace terrane::gen

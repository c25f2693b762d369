#include "terrane/gen/branch_depth.h"

#include <fmt/format.h>

#include <algorithm>

#include "terrane/gen/schedule.h"

namespace terrane::gen {

int branchDepth(const PassGraph& pass) {
    const Schedule whole = schedule(pass.graph, outputsOf(pass), [](NodeId) { return false; });
    int depth = 0;
    for (const BasicBlock& block : whole.basicBlocks) depth = std::max(depth, block.depth);
    return depth;
}

// Arguments stand before their users, and so do all nodes of a loop before its LoopOut nodes.
int branchChain(const PassGraph& pass) {
    const Graph& graph = pass.graph;
    std::vector<int> chain(graph.size(), 0);
    int longest = 0;
    for (NodeId id = 0; id < graph.size(); ++id) {
        const Node& node = graph.node(id);
        int& own = chain[id];
        for (const NodeId argument : node.arguments()) own = std::max(own, chain[argument]);
        if (node.op == Op::Phi) ++own;
        if (node.op == Op::LoopOut) {
            const auto number = static_cast<std::size_t>(graph.loopVariable(node.imm).loop);
            const Loop& loop = graph.loops()[number];
            own = std::max(own, chain[loop.condition]);
            for (const std::uint32_t v : loop.variables)
                own = std::max(own, chain[graph.loopVariable(v).next]);
            own += 2;  // head and body
        }
        longest = std::max(longest, own);
    }
    return longest;
}

std::string branchMistake(const PassGraph& pass) {
    const auto mistake = [&](int depth, int most) {
        return fmt::format(
            "pass \"{}\": its branches nest {} levels deep, at most {} are possible: an if_ whose variable "
            "only one "
            "side of the next if_ reads stands inside that side",
            pass.name, depth, most);
    };
    if (const int chain = branchChain(pass); chain > kMaxBranchChain) return mistake(chain, kMaxBranchChain);
    if (const int depth = branchDepth(pass); depth > kMaxBranchDepth) return mistake(depth, kMaxBranchDepth);
    return "";
}

}  // namespace terrane::gen

#include "terrane/gen/schedule.h"

#include <algorithm>
#include <cassert>

namespace terrane::gen {
namespace {

constexpr int kNowhere = -1;

class Scheduler {
  public:
    Scheduler(const Graph& graph, const std::function<bool(NodeId)>& isInput)
        : graph_(graph), isInput_(isInput), region_(graph.size(), kNowhere), live_(graph.size(), false) {
        result_.regions.push_back({});
    }

    Schedule run(const std::vector<NodeId>& roots) {
        for (const NodeId root : roots) {
            markLive(root);
            use(root, 0);
        }
        collectPhis();
        // Users stand behind their arguments: backwards, every use of a node is known before the node is
        // placed.
        for (NodeId id = static_cast<NodeId>(graph_.size()); id-- > 0;) {
            if (live_[id]) placeArguments(id);
        }
        for (NodeId id = 0; id < graph_.size(); ++id) {
            if (live_[id]) result_.regions[static_cast<std::size_t>(region_[id])].nodes.push_back(id);
        }
        return std::move(result_);
    }

  private:
    void markLive(NodeId root) {
        std::vector<NodeId> stack{root};
        while (!stack.empty()) {
            const NodeId id = stack.back();
            stack.pop_back();
            if (live_[id] || isInput_(id)) continue;
            live_[id] = true;
            const auto args = graph_.node(id).arguments();
            stack.insert(stack.end(), args.begin(), args.end());
        }
    }

    void collectPhis() {
        for (NodeId id = 0; id < graph_.size(); ++id) {
            const Node& n = graph_.node(id);
            if (!live_[id] || n.op != Op::Phi) continue;
            if (result_.ifs.size() <= n.imm) result_.ifs.resize(n.imm + 1);
            result_.ifs[n.imm].phis.push_back(id);
        }
    }

    void placeArguments(NodeId id) {
        const Node& n = graph_.node(id);
        if (n.op != Op::Phi) {
            for (const NodeId arg : n.arguments()) use(arg, region_[id]);
            return;
        }
        const Schedule::If& branch = openIf(n.imm);
        use(n.args[0], region_[id]);
        use(n.args[1], branch.thenRegion);
        use(n.args[2], branch.elseRegion);
    }

    // All phis of an if stand in one region: the innermost that holds the uses of all of them. Its phis were
    // made one after the other, before any use of one, so at the last of them the uses of all are known.
    const Schedule::If& openIf(std::uint32_t number) {
        Schedule::If& branch = result_.ifs[number];
        if (branch.thenRegion != kNowhere) return branch;
        int region = kNowhere;
        for (const NodeId phi : branch.phis) region = commonRegion(region, region_[phi]);
        for (const NodeId phi : branch.phis) region_[phi] = region;
        branch.thenRegion = newRegion(region);
        branch.elseRegion = newRegion(region);
        return branch;
    }

    int newRegion(int parent) {
        const int depth = result_.regions[static_cast<std::size_t>(parent)].depth + 1;
        result_.regions.push_back({parent, depth, {}});
        return static_cast<int>(result_.regions.size()) - 1;
    }

    void use(NodeId id, int region) {
        assert(region != kNowhere && "a user is placed before its arguments");
        if (live_[id]) region_[id] = commonRegion(region_[id], region);
    }

    int commonRegion(int a, int b) const {
        if (a == kNowhere) return b;
        if (b == kNowhere) return a;
        const auto at = [&](int r) -> const Region& { return result_.regions[static_cast<std::size_t>(r)]; };
        while (a != b) {
            if (at(a).depth >= at(b).depth) {
                a = at(a).parent;
            } else {
                b = at(b).parent;
            }
        }
        return a;
    }

    const Graph& graph_;
    const std::function<bool(NodeId)>& isInput_;
    std::vector<int> region_;  // by node
    std::vector<bool> live_;
    Schedule result_;
};

}  // namespace

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
        const auto args = graph.node(id).arguments();
        stack.insert(stack.end(), args.begin(), args.end());
    }
    std::sort(result.begin(), result.end());
    return result;
}

}  // namespace terrane::gen

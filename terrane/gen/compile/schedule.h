// Places the nodes of a graph in branches and loops: as deep in branches as all their uses allow, so that a
// value that only one side of an if needs is computed only there, and outside of loops whose variables they
// do not depend on. Unused nodes are left out. A step of compile() in program.h.
#pragma once

#include <functional>
#include <vector>

#include "terrane/gen/compile/graph.h"

namespace terrane::gen {

// A sequence of nodes. A phi stands for its whole if at the place of the if's first phi, a LoopOut for its
// loop in the same way.
struct BasicBlock {
    int parent = -1;
    int depth = 0;
    std::int32_t loop = kNoLoop;  // innermost one around it
    std::vector<NodeId> nodes;    // in order
};

struct Schedule {
    struct If {
        int thenBlock = -1, elseBlock = -1;
        std::vector<NodeId> phis;  // in order
    };
    // Each round runs the head, which gives the condition, and where that holds the body.
    struct Loop {
        int head = -1, body = -1;
        std::vector<std::uint32_t> variables;  // those that are needed
        std::vector<NodeId> outs;              // in order
    };
    std::vector<BasicBlock> basicBlocks;  // 0 is the root
    std::vector<int> basicBlockOf;        // by node; -1 where it is not needed
    // By number of the if, without phis where it is not needed. An if of which some phis belong to a loop and
    // others do not is two ifs; the second one stands behind all numbers.
    std::vector<If> ifs;
    std::vector<Loop> loops;  // by number; without outs where it is not needed

    // Returns the if or loop that stands at the place of this node, or null.
    const If* ifAt(const Graph& graph, NodeId id) const;
    const Loop* loopAt(const Graph& graph, NodeId id) const;

    std::vector<std::uint32_t> ifOf;  // by node: of phis
};

// Schedules the nodes that `roots` need. Nodes for which `isInput` holds have their values already.
Schedule schedule(const Graph& graph, const std::vector<NodeId>& roots,
                  const std::function<bool(NodeId)>& isInput);

// Returns the outermost nodes that `outputs` need and that do not depend on z: a 3D pass computes them once
// per column.
std::vector<NodeId> columnBoundary(const Graph& graph, const std::vector<NodeId>& outputs);

}  // namespace terrane::gen

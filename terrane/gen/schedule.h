// Places the nodes of a graph in branches: each as deep as all its uses allow, so that what only one side of
// an if needs is computed only there, and what nobody needs not at all. A step of compile() in program.h.
#pragma once

#include <functional>
#include <vector>

#include "terrane/gen/graph.h"

namespace terrane::gen {

// A sequence of nodes. A phi stands for its whole if at the place of the if's first phi.
struct Region {
    int parent = -1;
    int depth = 0;
    std::vector<NodeId> nodes;  // in order
};

struct Schedule {
    struct If {
        int thenRegion = -1, elseRegion = -1;
        std::vector<NodeId> phis;  // in order
    };
    std::vector<Region> regions;  // 0 is the root
    std::vector<If> ifs;          // by number of the if; without phis where it is not needed
};

// Schedules what `roots` need. Nodes for which `isInput` holds are there already and end the search.
Schedule schedule(const Graph& graph, const std::vector<NodeId>& roots,
                  const std::function<bool(NodeId)>& isInput);

// Of what `outputs` need, the outermost nodes that do not depend on z: a 3D pass computes them once a column.
std::vector<NodeId> columnBoundary(const Graph& graph, const std::vector<NodeId>& outputs);

}  // namespace terrane::gen

// Places and heights of a map's nodes: the author's expression run on the samples of each cell, of which the
// lowest becomes the cell's node. One DrainageHeights a map and seed; any thread may use it.
#pragma once

#include <cstdint>
#include <vector>

#include "terrane/gen/compile/generator_graph.h"
#include "terrane/gen/compile/program.h"
#include "terrane/gen/drainage/drainage_network.h"

namespace terrane::gen {

// A cell of a map: spacing · x … spacing · (x + 1) − 1 blocks. Wraps with the blocks of the world.
struct DrainageCell {
    std::int32_t x = 0, y = 0;
};

// 1/16 blocks from the corner of the cell.
struct NodePlace {
    std::int32_t x, y;
};
constexpr std::int32_t kPlaceUnits = 16;  // a block

struct DrainageNodes {
    std::vector<HeightKey> heights;  // by y, then x
    std::vector<float> gradients;    // likewise; empty if the map has no valleys
    std::vector<NodePlace> places;
};

// A cell has kCellSamples² samples, each for a square of its own. The generator that records the heights is
// of this level: its columns are those squares.
constexpr int kCellSamples = 2;
constexpr int kCellSamplesLog2 = 1;
int drainageLevel(const DrainageSpec& spec);

class DrainageHeights {
  public:
    DrainageHeights(const DrainageGraph& graph, std::uint64_t worldSeed);

    // Returns the nodes of side² cells from `corner` on. Corner and side are multiples of 16 / kCellSamples.
    DrainageNodes nodes(DrainageCell corner, int side) const;
    // Returns a hash of the cell, for random decisions.
    std::uint32_t hash(DrainageCell cell) const;
    const DrainageSpec& spec() const { return graph_.spec; }
    bool hasValleys() const { return graph_.hasValleys(); }

  private:
    DrainageGraph graph_;
    Seeds seeds_;
    std::uint32_t seed_;
    Program program_;
};

// Returns the same cell on the other side of the world's edge.
DrainageCell wrapped(DrainageCell cell, int spacing);

}  // namespace terrane::gen

// Statistics of drainage networks as geomorphologists compute them: where rivers end, the laws of Flint, Hack
// and Horton. Used by bench_land.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "terrane/gen/compile/generator_graph.h"

namespace terrane::bench {

// Sums over river nodes whose drainage areas are alike.
struct AreaBin {
    double nodes = 0, area = 0;    // of the logarithms of areas in km²
    double slope = 0, length = 0;  // slopes in blocks a block; logarithms of lengths in km
};

// Streams by their Strahler order, from 1 on.
struct StreamOrders {
    static constexpr int kMost = 12;
    std::array<double, kMost> streams{}, length{};  // number; km, of all together
};

// Streams whose orders are counted, in basins of order kLeastOrder and more: the many short rivers of coasts
// are no trees.
struct StreamKind {
    const char* name;
    double minNodes;  // upstream, of a stream; 0: of a river
};
constexpr std::array<StreamKind, 3> kStreamKinds = {
    {{"rivers", 0}, {"streams of 3 nodes and more, dry too,", 3}, {"streams of 1 node and more", 1}}};
constexpr int kLeastOrder = 3;

// Sums over seeds.
struct RiverStatistics {
    long rivers = 0, reachSea = 0, reachLake = 0, leave = 0, end = 0;  // nodes; `leave`: the area
    long rings = 0;                                                    // nodes
    // kBinsPerDoubling for each doubling of the nodes upstream, from 1 node on: of all streams, and of those
    // where streams of one node are steep and where they are gentle, in maps with valleys.
    std::vector<AreaBin> bins, steepBins, gentleBins;
    std::array<StreamOrders, kStreamKinds.size()> orders;
    double km2 = 0;
    double largestKm2 = 0, longestKm = 0;  // basin; river
    int minFlow = 0;                       // nodes that make a river
    double nodeKm2 = 0;
};
constexpr int kBinsPerDoubling = 2;
constexpr float kSteep = 0.2f, kGentle = 0.05f;  // gradients of streams of one node

// Adds the network of a square of 512² nodes in the middle of the world.
void addRivers(RiverStatistics& s, const gen::DrainageGraph& graph, std::uint64_t seed);

// y = factor · x^exponent, as a line through logarithms.
struct PowerLaw {
    double exponent = 0, factor = 0, r2 = 0;
};
// Over bins of rivers: S by A, L by A.
PowerLaw slopeLaw(const RiverStatistics& s, const std::vector<AreaBin>& bins);
PowerLaw lengthLaw(const RiverStatistics& s);
// Factor from one order to the next: of the number of streams, which falls, and of their mean length. Over
// the orders that every basin has, up to kLeastOrder.
double bifurcationRatio(const StreamOrders& orders);
double lengthRatio(const StreamOrders& orders);

// Whether there are enough nodes for a mean.
bool counts(const AreaBin& bin);

}  // namespace terrane::bench

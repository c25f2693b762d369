#include "bench/river_figures.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "terrane/gen/drainage/drainage_heights.h"
#include "terrane/gen/drainage/drainage_network.h"

namespace terrane::bench {
namespace {

constexpr int kInner = 512;  // nodes along x and y that count
constexpr int kMargin = 96;  // around them
constexpr int kSide = kInner + 2 * kMargin;
static_assert(kMargin >= gen::kNetworkMargin && kSide % 16 == 0, "nodes come in whole tiles from a corner");

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

gen::DrainageNetwork networkOf(const gen::DrainageHeights& heights) {
    gen::DrainageNodes nodes = heights.nodes({-kSide / 2, -kSide / 2}, kSide);
    gen::DrainageNetwork n;
    n.side = kSide;
    n.heights = std::move(nodes.heights);
    n.gradients = std::move(nodes.gradients);
    gen::findDrainage(n, heights.spec());
    return n;
}

// The network as a tree, by node.
struct Tree {
    std::vector<std::uint32_t> next;    // kNone at an end
    std::vector<std::uint32_t> order;   // every node after all nodes upstream of it; without nodes of rings
    std::vector<double> step, length;   // km: to the next node; the longest way upstream
    std::vector<double> nodes;          // upstream, itself among them
    std::vector<std::uint8_t> isWhole;  // all of its nodes upstream count
    std::vector<std::uint32_t> end;     // the last land node downstream
};

bool isInside(std::size_t node) {
    const int x = static_cast<int>(node) % kSide - kMargin, y = static_cast<int>(node) / kSide - kMargin;
    return std::min(x, y) >= 0 && std::max(x, y) < kInner;
}

bool isSea(const gen::DrainageNetwork& n, const gen::DrainageSpec& spec, std::size_t node) {
    return gen::heightOf(n.heights[node]) < spec.seaLevel;
}

// Follows drains; water that reaches the sea ends at its last land node.
void findNext(Tree& t, const gen::DrainageNetwork& n, const gen::DrainageSpec& spec) {
    const std::size_t count = n.heights.size();
    t.next.assign(count, kNone);
    t.step.assign(count, 0.0);
    std::vector<int> waiting(count, 0);
    for (std::size_t k = 0; k < count; ++k) {
        if (n.drains[k] == gen::kNoDrain) continue;
        const auto& [dx, dy] = gen::kDirections[n.drains[k]];
        t.step[k] = std::hypot(dx, dy) * spec.spacing / 1000.0;
        if (isSea(n, spec, n.drainOf(k))) continue;
        t.next[k] = static_cast<std::uint32_t>(n.drainOf(k));
        ++waiting[t.next[k]];
    }
    for (std::uint32_t k = 0; k < count; ++k) {
        if (waiting[k] == 0) t.order.push_back(k);
    }
    for (std::size_t k = 0; k < t.order.size(); ++k) {
        const std::uint32_t to = t.next[t.order[k]];
        if (to != kNone && --waiting[to] == 0) t.order.push_back(to);
    }
}

Tree treeOf(const gen::DrainageNetwork& n, const gen::DrainageSpec& spec) {
    Tree t;
    findNext(t, n, spec);
    const std::size_t count = n.heights.size();
    t.length.assign(count, 0.0);
    t.nodes.assign(count, 1.0);
    t.isWhole.resize(count);
    t.end.assign(count, kNone);
    for (std::size_t k = 0; k < count; ++k) t.isWhole[k] = isInside(k);
    for (const std::uint32_t k : t.order) {
        const std::uint32_t to = t.next[k];
        if (to == kNone) continue;
        t.nodes[to] += t.nodes[k];
        t.length[to] = std::max(t.length[to], t.length[k] + t.step[k]);
        t.isWhole[to] &= t.isWhole[k];
    }
    for (std::size_t k = t.order.size(); k-- > 0;) {
        const std::uint32_t node = t.order[k];
        t.end[node] = t.next[node] == kNone ? node : t.end[t.next[node]];
    }
    return t;
}

void addEnds(RiverStatistics& s, const gen::DrainageNetwork& n, const gen::DrainageSpec& spec,
             const Tree& t) {
    for (std::size_t k = 0; k < t.next.size(); ++k) {
        if (!isInside(k) || isSea(n, spec, k) || n.flows[k] < spec.minFlow) continue;
        ++s.rivers;
        const std::uint32_t end = t.end[k];
        if (end == kNone) {
            ++s.rings;
        } else if (n.drains[end] != gen::kNoDrain) {
            ++s.reachSea;
        } else if (n.lakeNodes[end] > 0) {
            ++s.reachLake;
        } else if (!isInside(end)) {
            ++s.leave;
        } else {
            ++s.end;
        }
    }
}

void addTo(std::vector<AreaBin>& bins, std::size_t number, const AreaBin& one) {
    if (number >= bins.size()) bins.resize(number + 1);
    AreaBin& bin = bins[number];
    bin.nodes += one.nodes;
    bin.area += one.area;
    bin.slope += one.slope;
    bin.length += one.length;
}

void addBins(RiverStatistics& s, const gen::DrainageNetwork& n, const gen::DrainageSpec& spec,
             const Tree& t) {
    const auto level = [&](std::size_t node) {
        return double{std::max(gen::heightOf(n.levels[node]), spec.seaLevel)};
    };
    for (std::size_t k = 0; k < t.next.size(); ++k) {
        if (t.isWhole[k] == 0 || t.step[k] == 0 || isSea(n, spec, k)) continue;
        s.largestKm2 = std::max(s.largestKm2, t.nodes[k] * s.nodeKm2);
        s.longestKm = std::max(s.longestKm, t.length[k] + t.step[k]);
        // A node's own way begins half a step before it.
        const AreaBin one = {1, std::log10(t.nodes[k] * s.nodeKm2),
                             (level(k) - level(n.drainOf(k))) / (t.step[k] * 1000),
                             std::log10(t.length[k] + t.step[k] / 2)};
        const auto number = static_cast<std::size_t>(std::log2(t.nodes[k]) * kBinsPerDoubling);
        addTo(s.bins, number, one);
        if (n.gradients.empty()) continue;
        if (n.gradients[k] > kSteep) addTo(s.steepBins, number, one);
        if (n.gradients[k] < kGentle) addTo(s.gentleBins, number, one);
    }
}

// Strahler: where two streams of the same order meet, the next one has one more.
std::vector<int> strahlerOrders(const Tree& t, double minNodes) {
    std::vector<int> orders(t.next.size(), 0), largest(t.next.size(), 0), number(t.next.size(), 0);
    for (const std::uint32_t k : t.order) {
        if (t.nodes[k] < minNodes) continue;
        orders[k] = number[k] > 1 ? largest[k] + 1 : std::max(largest[k], 1);
        const std::uint32_t to = t.next[k];
        if (to == kNone) continue;
        if (orders[k] > largest[to]) {
            largest[to] = orders[k];
            number[to] = 1;
        } else if (orders[k] == largest[to]) {
            ++number[to];
        }
    }
    return orders;
}

void addOrders(StreamOrders& s, const gen::DrainageNetwork& n, const gen::DrainageSpec& spec, const Tree& t,
               const StreamKind& kind) {
    const double minNodes = kind.minNodes > 0 ? kind.minNodes : spec.minFlow;
    const std::vector<int> orders = strahlerOrders(t, minNodes);
    for (std::size_t k = 0; k < orders.size(); ++k) {
        if (orders[k] == 0 || t.end[k] == kNone || isSea(n, spec, k)) continue;
        if (t.isWhole[t.end[k]] == 0 || orders[t.end[k]] < kLeastOrder) continue;
        const auto order = static_cast<std::size_t>(std::min(orders[k], StreamOrders::kMost) - 1);
        s.length[order] += t.step[k];
        s.streams[order] += t.next[k] == kNone || orders[t.next[k]] != orders[k];
    }
}

// A line through points, as a power law of the numbers whose logarithms they are.
PowerLaw fitted(std::span<const double> x, std::span<const double> y) {
    const auto count = static_cast<double>(x.size());
    double sumX = 0, sumY = 0, xx = 0, xy = 0, yy = 0;
    for (std::size_t k = 0; k < x.size(); ++k) {
        sumX += x[k];
        sumY += y[k];
    }
    const double meanX = sumX / count, meanY = sumY / count;
    for (std::size_t k = 0; k < x.size(); ++k) {
        xx += (x[k] - meanX) * (x[k] - meanX);
        xy += (x[k] - meanX) * (y[k] - meanY);
        yy += (y[k] - meanY) * (y[k] - meanY);
    }
    const double exponent = xy / xx;
    return {exponent, std::pow(10.0, meanY - exponent * meanX), xy * xy / (xx * yy)};
}

// Over bins from the least river on.
template <class Value>
PowerLaw lawOfRivers(const RiverStatistics& s, const std::vector<AreaBin>& bins, Value value) {
    std::vector<double> x, y;
    for (const AreaBin& bin : bins) {
        if (!counts(bin) || bin.area / bin.nodes < std::log10(s.minFlow * s.nodeKm2)) continue;
        x.push_back(bin.area / bin.nodes);
        y.push_back(value(bin));
    }
    return fitted(x, y);
}

template <class Value>
double ratioByOrder(const StreamOrders& orders, Value value) {
    std::vector<double> x, y;
    for (std::size_t k = 0; k < std::size_t{kLeastOrder} && orders.streams[k] > 0; ++k) {
        x.push_back(static_cast<double>(k));
        y.push_back(std::log10(value(k)));
    }
    return std::pow(10.0, fitted(x, y).exponent);
}

}  // namespace

void addRivers(RiverStatistics& s, const gen::DrainageGraph& graph, std::uint64_t seed) {
    const gen::DrainageHeights heights(graph, seed);
    const gen::DrainageSpec& spec = heights.spec();
    const double nodeKm = spec.spacing / 1000.0;
    s.minFlow = spec.minFlow;
    s.nodeKm2 = nodeKm * nodeKm;
    s.km2 += s.nodeKm2 * kInner * kInner;
    const gen::DrainageNetwork n = networkOf(heights);
    const Tree t = treeOf(n, spec);
    addEnds(s, n, spec, t);
    addBins(s, n, spec, t);
    for (std::size_t k = 0; k < kStreamKinds.size(); ++k) addOrders(s.orders[k], n, spec, t, kStreamKinds[k]);
}

PowerLaw slopeLaw(const RiverStatistics& s, const std::vector<AreaBin>& bins) {
    return lawOfRivers(s, bins, [](const AreaBin& b) { return std::log10(b.slope / b.nodes); });
}

PowerLaw lengthLaw(const RiverStatistics& s) {
    return lawOfRivers(s, s.bins, [](const AreaBin& b) { return b.length / b.nodes; });
}

double bifurcationRatio(const StreamOrders& orders) {
    return 1 / ratioByOrder(orders, [&](std::size_t k) { return orders.streams[k]; });
}

double lengthRatio(const StreamOrders& orders) {
    return ratioByOrder(orders, [&](std::size_t k) { return orders.length[k] / orders.streams[k]; });
}

bool counts(const AreaBin& bin) {
    return bin.nodes >= 20;
}

}  // namespace terrane::bench

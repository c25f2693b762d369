#include "terrane/gen/drainage/drainage_network.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstdlib>
#include <limits>

#include "terrane/shared/det_math.h"

namespace terrane::gen {
namespace {

constexpr float kMaxHeight = 8192.0f, kHeightUnit = 65536.0f;
constexpr int kTieBits = 24;

// A node counts as an outlet if it is lower by this: more than the steps of any way, so that heights along
// the cut fall by one or more.
constexpr HeightKey kMinFall = 1024;
static_assert((2 * kFloodReach + 1) * (2 * kFloodReach + 1) < kMinFall);

constexpr int kLakeDistance = 2;  // cells between lakes

constexpr std::uint8_t kPassed = 255;

// A way out of a pit, and what the water covered before it found it.
struct Flood {
    bool hasOutlet = false;
    HeightKey pass = 0;  // the highest node of the way
    int covered = 0;     // nodes below it, the pit among them
};

// Rises from pits of one window. Scratch memory is kept from pit to pit.
class Flooder {
  public:
    Flooder(const DrainageNetwork& network, const DrainageSpec& spec)
        : network_(network),
          maxCut_(static_cast<HeightKey>(spec.maxCut * kHeightUnit) << kTieBits),
          from_(network.heights.size()),
          seen_(network.heights.size(), 0) {}

    Flood rise(int x, int y) {
        const std::size_t pit = network_.at(x, y);
        const HeightKey bottom = network_.heights[pit];
        Flood flood;
        flood.pass = bottom;
        ++round_;
        popped_ = 0;
        shore_.clear();
        way.clear();
        reach(x, y, pit);
        while (!shore_.empty()) {
            std::pop_heap(shore_.begin(), shore_.end(), isHigher);
            const Shore lowest = shore_.back();
            shore_.pop_back();
            if (lowest.height - bottom > maxCut_) return flood;
            if (lowest.height > flood.pass) {
                flood.pass = lowest.height;
                flood.covered = popped_;
            }
            ++popped_;
            if (lowest.height <= bottom - kMinFall) {
                flood.hasOutlet = true;
                traceBack(lowest, pit);
                return flood;
            }
            spread(lowest, x, y);
        }
        return flood;
    }

    std::vector<std::size_t> way;  // from the pit to its outlet

  private:
    struct Shore {
        HeightKey height;
        std::int32_t x, y;
    };
    static bool isHigher(const Shore& a, const Shore& b) { return a.height > b.height; }

    void reach(int x, int y, std::size_t from) {
        const std::size_t node = network_.at(x, y);
        seen_[node] = round_;
        from_[node] = from;
        shore_.push_back({network_.heights[node], x, y});
        std::push_heap(shore_.begin(), shore_.end(), isHigher);
    }

    void spread(const Shore& node, int pitX, int pitY) {
        for (const auto& [dx, dy] : kDirections) {
            const int x = node.x + dx, y = node.y + dy;
            if (std::abs(x - pitX) > kFloodReach || std::abs(y - pitY) > kFloodReach) continue;
            if (seen_[network_.at(x, y)] != round_) reach(x, y, network_.at(node.x, node.y));
        }
    }

    void traceBack(const Shore& outlet, std::size_t pit) {
        std::size_t node = network_.at(outlet.x, outlet.y);
        for (; node != pit; node = from_[node]) way.push_back(node);
        way.push_back(pit);
        std::reverse(way.begin(), way.end());
    }

    const DrainageNetwork& network_;
    HeightKey maxCut_;
    std::vector<std::size_t> from_;
    std::vector<std::uint32_t> seen_;  // the round in which the water came here
    std::uint32_t round_ = 0;
    int popped_ = 0;
    std::vector<Shore> shore_;  // heap, the lowest first
};

std::uint8_t lowestNeighbor(const DrainageNetwork& n, const std::vector<HeightKey>& heights, int x, int y) {
    HeightKey lowest = heights[n.at(x, y)];
    std::uint8_t direction = kNoDrain;
    for (std::uint8_t k = 0; k < kDirections.size(); ++k) {
        const HeightKey height = heights[n.at(x + kDirections[k][0], y + kDirections[k][1])];
        if (height >= lowest) continue;
        lowest = height;
        direction = k;
    }
    return direction;
}

// Heights fall evenly from the pit to its outlet.
void cut(DrainageNetwork& n, const std::vector<std::size_t>& way) {
    const HeightKey top = n.heights[way.front()], fall = top - n.heights[way.back()];
    const auto steps = static_cast<HeightKey>(way.size()) - 1;
    for (HeightKey k = 1; k < steps; ++k) {
        HeightKey& level = n.levels[way[static_cast<std::size_t>(k)]];
        // Without overflow: fall has up to 55 bits, k and steps 9.
        level = std::min(level, top - (fall / steps * k + fall % steps * k / steps));
    }
}

void openPits(DrainageNetwork& n, const DrainageSpec& spec, HeightKey sea) {
    Flooder flooder(n, spec);
    const auto lakeDepth = static_cast<HeightKey>(spec.lakeDepth * kHeightUnit) << kTieBits;
    for (int y = kFloodReach; y < n.side - kFloodReach; ++y) {
        for (int x = kFloodReach; x < n.side - kFloodReach; ++x) {
            const std::size_t node = n.at(x, y);
            if (n.heights[node] < sea || lowestNeighbor(n, n.heights, x, y) != kNoDrain) continue;
            const Flood flood = flooder.rise(x, y);
            const bool isLake = flood.pass - n.heights[node] >= lakeDepth && flood.covered >= spec.lakeNodes;
            if (isLake || !flood.hasOutlet) {
                n.lakeNodes[node] = static_cast<std::uint8_t>(std::clamp(flood.covered, 1, 255));
            }
            if (flood.hasOutlet) cut(n, flooder.way);
        }
    }
}

void findDrains(DrainageNetwork& n, HeightKey sea) {
    for (int y = 1; y < n.side - 1; ++y) {
        for (int x = 1; x < n.side - 1; ++x) {
            const std::size_t node = n.at(x, y);
            if (n.heights[node] >= sea) n.drains[node] = lowestNeighbor(n, n.levels, x, y);
        }
    }
}

constexpr std::uint32_t kNoNode = std::numeric_limits<std::uint32_t>::max();

// By node: the node that it drains to, or kNoNode.
std::vector<std::uint32_t> nextNodes(const DrainageNetwork& n) {
    std::vector<std::uint32_t> next(n.drains.size(), kNoNode);
    for (std::size_t node = 0; node < next.size(); ++node) {
        if (n.drains[node] != kNoDrain) next[node] = static_cast<std::uint32_t>(n.drainOf(node));
    }
    return next;
}

// By node: the number of nodes upstream within the window, itself among them.
std::vector<std::uint32_t> countUpstream(const std::vector<std::uint32_t>& next) {
    std::vector<std::uint32_t> counts(next.size(), 1);
    std::vector<std::uint8_t> waiting(next.size(), 0);  // neighbors that drain here and are not counted yet
    for (const std::uint32_t to : next) {
        if (to != kNoNode) ++waiting[to];
    }
    for (std::uint32_t first = 0; first < next.size(); ++first) {
        // Goes downstream while all inflows of a node are counted. Passes each node once.
        std::uint32_t node = first;
        while (node != kNoNode && waiting[node] == 0) {
            waiting[node] = kPassed;
            const std::uint32_t to = next[node];
            if (to != kNoNode) {
                counts[to] += counts[node];
                --waiting[to];
            }
            node = to;
        }
    }
    return counts;
}

// Counts nodes up to kMaxUpstream steps upstream: from all nodes upstream it subtracts those farther away,
// which are upstream of the nodes kMaxUpstream + 1 steps away.
void countFlow(DrainageNetwork& n) {
    static_assert(std::has_single_bit(static_cast<unsigned>(kMaxUpstream)), "steps are doubled");
    const std::vector<std::uint32_t> next = nextNodes(n), counts = countUpstream(next);
    std::vector<std::uint32_t> ahead = next, doubled(next.size());
    for (int steps = 1; steps < kMaxUpstream; steps *= 2) {
        for (std::size_t k = 0; k < ahead.size(); ++k)
            doubled[k] = ahead[k] == kNoNode ? kNoNode : ahead[ahead[k]];
        ahead.swap(doubled);
    }
    std::vector<std::uint32_t> flows = counts;
    for (std::size_t k = 0; k < next.size(); ++k) {
        if (ahead[k] != kNoNode && next[ahead[k]] != kNoNode) flows[next[ahead[k]]] -= counts[k];
    }
    for (std::size_t k = 0; k < next.size(); ++k) n.flows[k] = static_cast<std::uint16_t>(flows[k]);
}

// Sets the levels of streams above trunks, the sea and lakes, from these up.
void raiseStreams(DrainageNetwork& n, const DrainageSpec& spec, HeightKey sea) {
    const std::vector<std::uint32_t> next = nextNodes(n);
    std::vector<std::uint8_t> isDone(next.size(), 0);
    std::vector<std::uint32_t> way;
    for (std::uint32_t first = 0; first < next.size(); ++first) {
        way.clear();
        std::uint32_t node = first;
        for (; next[node] != kNoNode && n.flows[node] < kTrunkFlow && isDone[node] == 0; node = next[node])
            way.push_back(node);
        for (; !way.empty(); way.pop_back()) {
            const std::uint32_t from = way.back(), to = next[from];
            const auto& [dx, dy] = kDirections[n.drains[from]];
            const float length = static_cast<float>(spec.spacing) * (dx != 0 && dy != 0 ? 1.41421356f : 1.0f);
            const float flow = static_cast<float>(n.flows[from]);
            const float rise = shared::detDivide(n.gradients[from] * length, shared::detSqrt(flow));
            // Not above what a key holds; a step of 1 / 65536 block keeps every stream falling.
            n.levels[from] = heightKey(heightOf(std::max(n.levels[to], sea)) + std::max(rise, 0.0f), 0) +
                             (HeightKey{1} << kTieBits);
            isDone[from] = 1;
        }
    }
}

// Removes lakes too near a lower lake or a lake without outlet. Lakes without outlet stay.
void thinLakes(DrainageNetwork& n) {
    const std::vector<std::uint8_t> found = n.lakeNodes;
    for (int y = kLakeDistance; y < n.side - kLakeDistance; ++y) {
        for (int x = kLakeDistance; x < n.side - kLakeDistance; ++x) {
            const std::size_t node = n.at(x, y);
            if (found[node] == 0 || n.drains[node] == kNoDrain) continue;
            for (int dy = -kLakeDistance; dy <= kLakeDistance; ++dy) {
                for (int dx = -kLakeDistance; dx <= kLakeDistance; ++dx) {
                    const std::size_t other = n.at(x + dx, y + dy);
                    if (found[other] == 0) continue;
                    if (n.drains[other] == kNoDrain && other != node) n.lakeNodes[node] = 0;
                    if (n.levels[other] < n.levels[node]) n.lakeNodes[node] = 0;
                }
            }
        }
    }
}

}  // namespace

HeightKey heightKey(float height, std::uint32_t hash) {
    float within = height > -kMaxHeight ? height : -kMaxHeight;
    within = within < kMaxHeight ? within : kMaxHeight;
    const auto units = static_cast<std::int64_t>(within * kHeightUnit);
    return (units << kTieBits) + (hash >> (32 - kTieBits));
}

float heightOf(HeightKey key) {
    return static_cast<float>(static_cast<std::int32_t>(key >> kTieBits)) * (1.0f / kHeightUnit);
}

std::size_t DrainageNetwork::drainOf(std::size_t node) const {
    const auto& [dx, dy] = kDirections[drains[node]];
    return node + static_cast<std::size_t>(dy * side + dx);
}

void findDrainage(DrainageNetwork& n, const DrainageSpec& spec) {
    assert(n.heights.size() == static_cast<std::size_t>(n.side) * static_cast<std::size_t>(n.side) &&
           "each node of the square has a height");
    const HeightKey sea = heightKey(spec.seaLevel, 0);
    n.levels = n.heights;
    n.drains.assign(n.heights.size(), kNoDrain);
    n.flows.assign(n.heights.size(), 1);
    n.lakeNodes.assign(n.heights.size(), 0);
    openPits(n, spec, sea);
    findDrains(n, sea);
    countFlow(n);
    if (!n.gradients.empty()) raiseStreams(n, spec, sea);
    thinLakes(n);
}

}  // namespace terrane::gen

// Computes the drainage of a window of nodes: cuts pits open, drains every node to its lowest neighbor and
// counts flow. Pure functions of heights; any thread may use it.
//
// Every step reads a bounded neighborhood, so a node has the same result in every window that includes
// kNetworkMargin cells around it:
//  1. A land node lower than its eight neighbors is a pit. From it water rises, always over the lowest node
//     at the shore (R. Barnes et al., Priority-Flood, 2014), at most kFloodReach cells away, until it finds a
//     node lower than the pit. The way there is cut: heights along it fall evenly. Where several cuts meet
//     the lowest one counts. Every node of a cut has a lower next one, so no new pits come of it.
//  2. Each land node drains to the lowest of its eight neighbors. Heights fall along every way, so there are
//     no rings; drains to the lowest neighbor never cross. Ways end in the sea or in a pit without outlet.
//  3. Flow is the number of nodes upstream within kMaxUpstream steps.
//  4. With gradients, heights follow from the drains: a node with less than kTrunkFlow nodes upstream is
//     higher than the next one by gradient · distance · flow^−½, the steady state of rivers that cut into
//     rising land (Flint's law; K. X. Whipple and G. E. Tucker, 1999). Rivers of that flow, the sea and
//     lakes without outlet keep their heights. Each step adds a node, so no way up from them is longer.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "terrane/gen/drainage/drainage.h"

namespace terrane::gen {

constexpr int kFloodReach = 10;   // cells
constexpr int kMaxUpstream = 64;  // steps
constexpr int kTrunkFlow = 32;    // nodes
static_assert(2 * kTrunkFlow <= kMaxUpstream,
              "heights read flows that many steps down, counted from as many up");
// Flow reads drains kMaxUpstream cells away, drains at their neighbors, cuts at pits and pits at nodes
// kFloodReach away, each flood at one more neighbor. Curves need flow two cells farther.
constexpr int kNetworkMargin = kMaxUpstream + 1 + 2 * kFloodReach + 1 + 2;

// A node's height with a hash that breaks ties, so that no two neighbors are equal: 2^40 a block. Differences
// of neighbors are 40 bits or so; 2^63 holds ±2^23 blocks.
using HeightKey = std::int64_t;
// Returns the key of a height within ±8192 blocks; NaN becomes the lowest height.
HeightKey heightKey(float height, std::uint32_t hash);
float heightOf(HeightKey key);  // blocks, to within 1/65536

constexpr std::uint8_t kNoDrain = 8;
// Neighbor `direction`, by y, then x, without the node itself.
constexpr std::array<std::array<int, 2>, 8> kDirections = {
    {{-1, -1}, {0, -1}, {1, -1}, {-1, 0}, {1, 0}, {-1, 1}, {0, 1}, {1, 1}}};

// A square of nodes by y, then x. The caller sets `side`, `heights` and, for valleys, `gradients`;
// findDrainage() computes the rest.
struct DrainageNetwork {
    int side = 0;
    std::vector<HeightKey> heights;
    std::vector<float> gradients;  // of streams of one node, blocks a block, 0 or more; empty: no valleys

    std::vector<HeightKey> levels;     // heights with the cuts, or those that follow from the gradients
    std::vector<std::uint8_t> drains;  // number of a direction, or kNoDrain: sea, pit without outlet, margin
    std::vector<std::uint16_t> flows;  // at most (2 · kMaxUpstream + 1)²
    std::vector<std::uint8_t> lakeNodes;  // nodes that the lake here would cover; 0 where there is none

    std::size_t at(int x, int y) const {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(side) + static_cast<std::size_t>(x);
    }
    std::size_t drainOf(std::size_t node) const;  // the node that it drains to
};

// Computes all members after `gradients`. Correct for nodes at least kNetworkMargin − 2 cells inside the
// window.
void findDrainage(DrainageNetwork& network, const DrainageSpec& spec);

}  // namespace terrane::gen

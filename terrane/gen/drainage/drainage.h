// Drainage networks: rivers and lakes over a coarse graph of nodes, found from heights that the generator's
// author records. Plain values; GeneratorBuilder::drainage declares a map, Pass::drainage reads it.
//
// The world is divided into square cells of `spacing` blocks with a node in each. drainage_network.h
// describes how nodes drain, drainage_curves.h the course of the water between them.
//
// A map with gradients also has *valleys*: every node above the sea has a stream, dry where fewer than
// minFlow nodes drain through it, and the streams' heights follow from the sea up (drainage_network.h). The
// land between them is the generator's: Pass::valleys says how high the streams around a column are and how
// far it is from them.
#pragma once

#include <cstdint>

#include "terrane/gen/language/expr.h"
#include "terrane/shared/drainage.h"

namespace terrane::gen {

struct DrainageSpec {
    int spacing = 256;           // blocks from node to node: a power of two, 64…1024
    float seaLevel = 62.0f;      // a node whose height is below is sea; no water's level is below
    int minFlow = 8;             // nodes upstream, itself among them, that make a node a river: 1…64
    float halfWidth = 2.0f;      // blocks, of a river of that flow; grows with the square root of the flow…
    float maxHalfWidth = 14.0f;  // …up to this, at most 64
    float reach = 128.0f;        // blocks: rivers and lakes farther away do not count. 1…spacing
    float bend = 0.25f;          // how far courses are bent, in spacings: 0…0.25
    float lakeDepth = 12.0f;     // a pit so many blocks below the lowest way out of it…
    int lakeNodes = 3;           // …with so many nodes below that way out holds a lake
    float maxCut = 64.0f;        // blocks: water from deeper pits stays, in a lake without outlet
};

// A map of a generator, from GeneratorBuilder::drainage.
struct Drainage {
    std::uint32_t index;
};

using shared::kNoRiver;  // distance where nothing is within reach

// The river and the lake that count at a column. Of several rivers the one with the smallest distance² −
// halfWidth² counts, so that confluences have no gaps.
struct DrainageSample {
    Float distance;      // blocks, to the middle of the river; kNoRiver where none is within reach
    Float halfWidth;     // blocks, there; the column is water where distance < halfWidth
    Float level;         // z of the water's surface there; never rises downstream
    Float flow;          // nodes upstream, as far as kMaxUpstream steps
    Float lakeDistance;  // blocks to the shore of the nearest lake, below 0 in it; kNoRiver likewise
    Float lakeLevel;     // z of its surface
    Float fall;          // of the river there: blocks that its water falls a block of its course
};

// The streams around a column, dry or not: means over all pieces of streams within valleyReach(),
// weighted by (1 / distance² − 1 / reach²)², so that they change smoothly and are a stream's own at the
// stream.
struct ValleySample {
    Float distance;  // blocks: 1 at a stream, largest half way between streams; kNoRiver where none is near
    Float level;     // z
    Float flow;      // nodes upstream
};

// Columns wider than this see no rivers. Of valleys they see one straight stream a node, as far as
// kMaxValleyStep.
constexpr int kMaxDrainageStep = 32, kMaxValleyStep = 64;
// Blocks within which streams count.
constexpr float valleyReach(const DrainageSpec& spec) {
    return 1.5f * static_cast<float>(spec.spacing);
}

}  // namespace terrane::gen

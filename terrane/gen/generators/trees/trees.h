// Kinds of trees, bushes and stones as shapes that generators stamp, several variants of each. Grown once a
// process, the same on every machine.
//
// clang-format off
//   const trees::TreeKinds kinds = trees::record(g);
//   p.set(foot, select(point.isHere, trees::shapeOf(of(kinds, trees::Kind::Oak), point.hash), Int(-1)));
// clang-format on
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "terrane/gen/language/builder.h"

namespace terrane::gen::trees {

enum class Kind : std::uint8_t {
    Oak,
    OldOak,
    Birch,
    Spruce,
    Pine,
    Larch,
    Acacia,
    Willow,
    Palm,
    Baobab,
    Cypress,
    DeadTree,
    Bush,
    Boulder,
    FallenLog,
    GiantMushroom,
    Count
};

struct KindRecord {
    std::string_view name;
    int first = 0, count = 0;       // numbers of its shapes: first … first + count − 1
    float cover = 0, height = 0;    // means: blocks seen from above, and the highest voxel above the foot
    std::string_view wood, leaves;  // blocks for columns that are too wide for shapes
};

using TreeKinds = std::array<KindRecord, static_cast<std::size_t>(Kind::Count)>;

// Grows the shapes of a kind. shapesOf() caches them.
std::vector<VoxelShape> growShapes(Kind kind);
const std::vector<VoxelShape>& shapesOf(Kind kind);

// Adds the shapes of all kinds to the generator. They have the same numbers at every level.
TreeKinds record(GeneratorBuilder& g);

inline const KindRecord& of(const TreeKinds& kinds, Kind kind) {
    return kinds[static_cast<std::size_t>(kind)];
}

// Returns one of a kind's shapes by a hash in 0…2^24−1, as ScatterPoint has it.
Int shapeOf(const KindRecord& kind, Int hash);

}  // namespace terrane::gen::trees

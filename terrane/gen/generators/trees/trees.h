// Kinds of trees, bushes and stones as shapes that generators stamp, several variants of each. Each kind is
// grown once a process, on first use, the same on every machine. Any thread may call these functions.
//
// clang-format off
//   const trees::TreeKinds kinds = trees::record(g);
//   p.set(foot, select(point.isHere, trees::shapeOf(of(kinds, trees::Kind::Oak), point.hash), Int(-1)));
// clang-format on
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "terrane/gen/language/builder.h"

namespace terrane::gen::trees {

// New kinds are added at the end: generators keep the numbers of their shapes.
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
    Beech,
    Maple,
    Aspen,
    Poplar,
    Cherry,
    Fir,
    YoungFir,
    Sequoia,
    Cedar,
    StonePine,
    Krummholz,
    Juniper,
    Olive,
    Eucalyptus,
    JoshuaTree,
    Kapok,
    Fig,
    Mangrove,
    TreeFern,
    Bamboo,
    YoungOak,
    YoungBirch,
    YoungSpruce,
    Hazel,
    DwarfPalm,
    DryShrub,
    Thicket,
    Snag,
    Stump,
    UprootedTree,
    GiantTree,
    Count
};

struct KindRecord {
    std::string_view name;
    int first = -1, count = 0;  // numbers of its shapes: first … first + count − 1; none if not recorded
    float cover = 0, height = 0;    // means: blocks seen from above, and the highest voxel above the foot
    std::string_view wood, leaves;  // blocks for columns that are too wide for shapes
};

using TreeKinds = std::array<KindRecord, static_cast<std::size_t>(Kind::Count)>;

// Grows the shapes of a kind. shapesOf() caches them.
std::vector<VoxelShape> growShapes(Kind kind);
const std::vector<VoxelShape>& shapesOf(Kind kind);

std::vector<Kind> allKinds();
std::string_view nameOf(Kind kind);

// Adds the shapes of kinds to the generator, in the order of the enumeration, so that they have the same
// numbers at every level. Without a list, of all kinds: 0.64 MB for the GPU, and stamps reach as high as the
// highest tree.
TreeKinds record(GeneratorBuilder& g, std::span<const Kind> kinds);
TreeKinds record(GeneratorBuilder& g);

inline const KindRecord& of(const TreeKinds& kinds, Kind kind) {
    return kinds[static_cast<std::size_t>(kind)];
}

// Returns one of a kind's shapes by a hash in 0…2^24−1, as ScatterPoint has it; -1 if the kind is not
// recorded.
Int shapeOf(const KindRecord& kind, Int hash);

}  // namespace terrane::gen::trees

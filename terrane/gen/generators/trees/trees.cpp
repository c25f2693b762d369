#include "terrane/gen/generators/trees/trees.h"

#include <cassert>
#include <string>

#include "terrane/gen/generators/trees/kinds_internal.h"

namespace terrane::gen::trees {
namespace {

struct KindEntry {
    Kind kind;
    std::string_view name, wood, leaves;
    int variants;
    void (*draw)(Canvas& canvas, Random& random);
};

constexpr KindEntry kKinds[] = {
    {Kind::Oak, "oak", "oak_log", "oak_leaves", 6, drawOak},
    {Kind::OldOak, "old oak", "oak_log", "oak_leaves", 4, drawOldOak},
    {Kind::Birch, "birch", "birch_log", "birch_leaves", 6, drawBirch},
    {Kind::Spruce, "spruce", "spruce_log", "spruce_leaves", 6, drawSpruce},
    {Kind::Pine, "pine", "pine_log", "pine_leaves", 6, drawPine},
    {Kind::Larch, "larch", "pine_log", "pine_leaves", 5, drawLarch},
    {Kind::Acacia, "acacia", "acacia_log", "acacia_leaves", 6, drawAcacia},
    {Kind::Willow, "willow", "willow_log", "willow_leaves", 5, drawWillow},
    {Kind::Palm, "palm", "palm_log", "palm_leaves", 6, drawPalm},
    {Kind::Baobab, "baobab", "acacia_log", "acacia_leaves", 4, drawBaobab},
    {Kind::Cypress, "cypress", "spruce_log", "spruce_leaves", 5, drawCypress},
    {Kind::DeadTree, "dead tree", "dead_log", "dead_log", 5, drawDeadTree},
    {Kind::Bush, "bush", "oak_log", "oak_leaves", 6, drawBush},
    {Kind::Boulder, "boulder", "mossy_stone", "mossy_stone", 6, drawBoulder},
    {Kind::FallenLog, "fallen log", "oak_log", "oak_log", 6, drawFallenLog},
    {Kind::GiantMushroom, "giant mushroom", "mushroom_stem", "mushroom_cap", 5, drawGiantMushroom},
};

constexpr bool kindsAreInOrder() {
    for (std::size_t n = 0; n < std::size(kKinds); ++n) {
        if (kKinds[n].kind != static_cast<Kind>(n)) return false;
    }
    return std::size(kKinds) == static_cast<std::size_t>(Kind::Count);
}
static_assert(kindsAreInOrder(), "the table has one entry for each kind, in the order of the enumeration");

const KindEntry& entryOf(Kind kind) {
    return kKinds[static_cast<std::size_t>(kind)];
}

KindRecord meansOf(const KindEntry& entry) {
    KindRecord kind = {entry.name, 0, entry.variants, 0, 0, entry.wood, entry.leaves};
    ShapeStatistics sum;
    for (const VoxelShape& shape : shapesOf(entry.kind)) {
        const ShapeStatistics statistics = statisticsOf(shape);
        sum.cover += statistics.cover;
        sum.height += statistics.height;
    }
    kind.cover = static_cast<float>(sum.cover) / static_cast<float>(entry.variants);
    kind.height = static_cast<float>(sum.height) / static_cast<float>(entry.variants);
    return kind;
}

}  // namespace

std::vector<VoxelShape> growShapes(Kind kind) {
    const KindEntry& entry = entryOf(kind);
    std::vector<VoxelShape> shapes;
    for (int variant = 0; variant < entry.variants; ++variant) {
        Canvas canvas;
        Random random(static_cast<std::uint32_t>(1000 * static_cast<int>(kind) + variant));
        entry.draw(canvas, random);
        canvas.removeDisconnected();
        shapes.push_back(canvas.shape(std::string(entry.name) + " " + std::to_string(variant)));
    }
    return shapes;
}

const std::vector<VoxelShape>& shapesOf(Kind kind) {
    static const auto all = [] {
        std::array<std::vector<VoxelShape>, static_cast<std::size_t>(Kind::Count)> shapes;
        for (std::size_t n = 0; n < shapes.size(); ++n) shapes[n] = growShapes(static_cast<Kind>(n));
        return shapes;
    }();
    return all[static_cast<std::size_t>(kind)];
}

TreeKinds record(GeneratorBuilder& g) {
    static const auto means = [] {
        TreeKinds kinds;
        for (std::size_t n = 0; n < kinds.size(); ++n) kinds[n] = meansOf(kKinds[n]);
        return kinds;
    }();
    TreeKinds kinds = means;
    for (std::size_t n = 0; n < kinds.size(); ++n) {
        const std::vector<VoxelShape>& shapes = shapesOf(static_cast<Kind>(n));
        assert(static_cast<int>(shapes.size()) == kinds[n].count && "the table of kinds counts its shapes");
        for (std::size_t k = 0; k < shapes.size(); ++k) {
            const int number = g.shape(shapes[k]);
            if (k == 0) kinds[n].first = number;
        }
    }
    return kinds;
}

Int shapeOf(const KindRecord& kind, Int hash) {
    return (((hash >> 8) & 0xFFFF) * kind.count >> 16) + kind.first;
}

}  // namespace terrane::gen::trees

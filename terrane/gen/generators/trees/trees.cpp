#include "terrane/gen/generators/trees/trees.h"

#include <algorithm>
#include <cassert>
#include <mutex>
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
    {Kind::Beech, "beech", "pale_log", "birch_leaves", 5, drawBeech},
    {Kind::Maple, "maple", "oak_log", "maple_leaves", 6, drawMaple},
    {Kind::Aspen, "aspen", "pale_log", "aspen_leaves", 6, drawAspen},
    {Kind::Poplar, "poplar", "willow_log", "oak_leaves", 5, drawPoplar},
    {Kind::Cherry, "cherry", "spruce_log", "cherry_leaves", 6, drawCherry},
    {Kind::Fir, "fir", "spruce_log", "fir_leaves", 6, drawFir},
    {Kind::YoungFir, "young fir", "spruce_log", "fir_leaves", 6, drawYoungFir},
    {Kind::Sequoia, "sequoia", "pine_log", "pine_leaves", 4, drawSequoia},
    {Kind::Cedar, "cedar", "spruce_log", "fir_leaves", 5, drawCedar},
    {Kind::StonePine, "stone pine", "pine_log", "pine_leaves", 5, drawStonePine},
    {Kind::Krummholz, "krummholz", "dead_log", "pine_leaves", 8, drawKrummholz},
    {Kind::Juniper, "juniper", "acacia_log", "fir_leaves", 6, drawJuniper},
    {Kind::Olive, "olive", "acacia_log", "olive_leaves", 6, drawOlive},
    {Kind::Eucalyptus, "eucalyptus", "pale_log", "olive_leaves", 6, drawEucalyptus},
    {Kind::JoshuaTree, "joshua tree", "palm_log", "palm_leaves", 6, drawJoshuaTree},
    {Kind::Kapok, "kapok", "pale_log", "kapok_leaves", 4, drawKapok},
    {Kind::Fig, "fig", "willow_log", "kapok_leaves", 4, drawFig},
    {Kind::Mangrove, "mangrove", "acacia_log", "kapok_leaves", 6, drawMangrove},
    {Kind::TreeFern, "tree fern", "spruce_log", "palm_leaves", 6, drawTreeFern},
    {Kind::Bamboo, "bamboo", "bamboo", "willow_leaves", 6, drawBamboo},
    {Kind::YoungOak, "young oak", "oak_log", "oak_leaves", 6, drawYoungOak},
    {Kind::YoungBirch, "young birch", "birch_log", "birch_leaves", 6, drawYoungBirch},
    {Kind::YoungSpruce, "young spruce", "spruce_log", "spruce_leaves", 6, drawYoungSpruce},
    {Kind::Hazel, "hazel", "oak_log", "birch_leaves", 6, drawHazel},
    {Kind::DwarfPalm, "dwarf palm", "palm_log", "palm_leaves", 5, drawDwarfPalm},
    {Kind::DryShrub, "dry shrub", "dead_log", "olive_leaves", 6, drawDryShrub},
    {Kind::Thicket, "thicket", "willow_log", "kapok_leaves", 6, drawThicket},
    {Kind::Snag, "snag", "dead_log", "dead_log", 6, drawSnag},
    {Kind::Stump, "stump", "oak_log", "oak_log", 6, drawStump},
    {Kind::UprootedTree, "uprooted tree", "oak_log", "oak_log", 6, drawUprootedTree},
    {Kind::GiantTree, "giant tree", "oak_log", "oak_leaves", 4, drawGiantTree},
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

// The shapes of a kind and their means, grown on first use.
struct GrownKind {
    std::once_flag once;
    std::vector<VoxelShape> shapes;
    float cover = 0, height = 0;
};

const GrownKind& grown(Kind kind) {
    static std::array<GrownKind, static_cast<std::size_t>(Kind::Count)> all;
    GrownKind& result = all[static_cast<std::size_t>(kind)];
    std::call_once(result.once, [&] {
        result.shapes = growShapes(kind);
        ShapeStatistics sum;
        for (const VoxelShape& shape : result.shapes) {
            const ShapeStatistics statistics = statisticsOf(shape);
            sum.cover += statistics.cover;
            sum.height += statistics.height;
        }
        result.cover = static_cast<float>(sum.cover) / static_cast<float>(result.shapes.size());
        result.height = static_cast<float>(sum.height) / static_cast<float>(result.shapes.size());
    });
    return result;
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
    return grown(kind).shapes;
}

std::vector<Kind> allKinds() {
    std::vector<Kind> kinds;
    for (const KindEntry& entry : kKinds) kinds.push_back(entry.kind);
    return kinds;
}

std::string_view nameOf(Kind kind) {
    return entryOf(kind).name;
}

TreeKinds record(GeneratorBuilder& g, std::span<const Kind> kinds) {
    TreeKinds records;
    for (const KindEntry& entry : kKinds) {
        KindRecord& kind = records[static_cast<std::size_t>(entry.kind)];
        kind = {entry.name, -1, 0, 0, 0, entry.wood, entry.leaves};
        if (std::find(kinds.begin(), kinds.end(), entry.kind) == kinds.end()) continue;
        const GrownKind& shapes = grown(entry.kind);
        kind.count = static_cast<int>(shapes.shapes.size());
        kind.cover = shapes.cover;
        kind.height = shapes.height;
        for (const VoxelShape& shape : shapes.shapes) {
            const int number = g.shape(shape);
            if (kind.first < 0) kind.first = number;
        }
    }
    return records;
}

TreeKinds record(GeneratorBuilder& g) {
    return record(g, allKinds());
}

Int shapeOf(const KindRecord& kind, Int hash) {
    return (((hash >> 8) & 0xFFFF) * kind.count >> 16) + kind.first;
}

}  // namespace terrane::gen::trees

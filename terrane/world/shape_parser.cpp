#include "terrane/world/shape_parser.h"

#include <optional>
#include <unordered_set>

namespace terrane::world {
namespace {

constexpr std::size_t kMaxDescribedShapes = 256;
constexpr std::array<std::string_view, 6> kShapeKeys{"name", "facing", "half", "boxes", "other", "arms"};

std::optional<ShapeBox> readBox(const toml::node& node) {
    const toml::array* numbers = node.as_array();
    if (!numbers || numbers->size() != 6) return std::nullopt;
    ShapeBox box;
    for (int k = 0; k < 6; ++k) {
        const auto number = (*numbers)[static_cast<std::size_t>(k)].value_exact<std::int64_t>();
        if (!number || *number < 0 || *number > kSixteenths) return std::nullopt;
        (k < 3 ? box.min : box.max)[k % 3] = static_cast<int>(*number);
    }
    const bool hasVolume = box.min.x < box.max.x && box.min.y < box.max.y && box.min.z < box.max.z;
    return hasVolume ? std::optional(box) : std::nullopt;
}

std::vector<ShapeBox> readBoxes(ContentTable& table, std::string_view key) {
    const toml::node* value = table.node(key);
    if (!value) return {};
    const toml::array* list = value->as_array();
    std::vector<ShapeBox> boxes;
    for (std::size_t k = 0; list && k < list->size() && k < kMaxShapeBoxes; ++k)
        if (const auto box = readBox((*list)[k])) boxes.push_back(*box);
    if (!list || list->empty() || boxes.size() != list->size())
        table.expected(*value, key,
                       fmt::format("1 to {} boxes [x, y, z, x, y, z] in sixteenths of a block, the lower "
                                   "corner first",
                                   kMaxShapeBoxes));
    return boxes;
}

// Meshers draw a full cell as a cube, which merges with its neighbors.
bool fillsCell(const ShapeDescription& shape) {
    const std::uint16_t mask = formMask(shape);
    for (unsigned state = 0; state <= mask; ++state)
        if (filledParts(boxesOf(shape, static_cast<std::uint16_t>(state & mask))) == kCellParts) return true;
    return false;
}

ShapePtr readShape(ContentTable& table) {
    auto shape = std::make_shared<ShapeDescription>();
    shape->line = table.line();
    table.rejectUnknown(kShapeKeys);
    if (const toml::node* name = table.node("name"))
        shape->name = table.nameOf(*name, "name");
    else
        table.missing("name");
    shape->hasFacing = table.boolean("facing", false);
    shape->hasHalf = table.boolean("half", false);
    if (!table.node("boxes")) table.missing("boxes");
    shape->boxes = readBoxes(table, "boxes");
    shape->other = readBoxes(table, "other");
    shape->arms = readBoxes(table, "arms");
    if (!shape->boxes.empty() && fillsCell(*shape))
        table.wrong(shape->line, "boxes", "fill the whole cell: such a block has the shape cube");
    return shape;
}

}  // namespace

std::vector<ShapePtr> readShapes(const toml::array* tables, std::span<const std::string_view> taken,
                                 std::string_view file, std::optional<std::string>& error) {
    std::vector<ShapePtr> shapes;
    std::unordered_set<std::string_view> names(taken.begin(), taken.end());
    for (std::size_t i = 0; tables && !error && i < tables->size(); ++i) {
        ContentTable table(*(*tables)[i].as_table(), file, error);
        if (i == kMaxDescribedShapes)
            table.wrong(table.line(), "shape",
                        fmt::format("expected at most {}, got more", kMaxDescribedShapes));
        shapes.push_back(readShape(table));
        if (!names.insert(shapes.back()->name).second && !error)
            table.expected(*table.node("name"), "name", "a name not used before");
    }
    return shapes;
}

}  // namespace terrane::world

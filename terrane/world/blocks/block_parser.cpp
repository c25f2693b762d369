#include "terrane/world/blocks/block_parser.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <optional>
#include <unordered_set>
#include <utility>
#include <vector>

#include "terrane/base/text.h"
#include "terrane/world/blocks/content_table.h"
#include "terrane/world/blocks/inventory.h"

namespace terrane::world {

namespace {

std::vector<std::string_view> templateNames(const BehaviorTable& behaviors) {
    std::vector<std::string_view> names = behaviors.names();
    std::erase_if(names, [&](std::string_view name) { return !behaviors.findTemplate(name); });
    return names;
}

BehaviorCall readCall(ContentTable& table, const toml::table& node, const BehaviorTable& behaviors) {
    const auto name = node["name"].value_exact<std::string>();
    BehaviorCall call;
    call.line = static_cast<int>(node.source().begin.line);
    call.behavior = name ? behaviors.findTemplate(*name) : nullptr;
    if (!call.behavior) {
        const toml::node* given = node.get("name");
        table.expected(given ? *given : node, "behaviors.name",
                       fmt::format("one of {}", fmt::join(templateNames(behaviors), ", ")));
        return call;
    }
    std::vector<std::string> known{"name"};
    for (const BehaviorParameter& parameter : call.behavior->parameters) {
        const std::string key = fmt::format("behaviors.{}", parameter.name);
        known.push_back(parameter.name);
        const toml::node* value = node.get(parameter.name);
        if (!value) {
            table.wrong(call.line, key, fmt::format("missing ({} requires it)", *name));
        } else if (parameter.kind == BehaviorParameter::Kind::Number) {
            call.arguments.numbers[parameter.name] = table.realOf(*value, key, parameter.min, parameter.max);
        } else {
            const auto block = value->value_exact<std::string>();
            if (!block) table.expected(*value, key, "the name of a block");
            call.arguments.blocks[parameter.name] = block.value_or("");
        }
    }
    table.inner(node).rejectUnknown(known, "behaviors.");
    return call;
}

}  // namespace

void readBehaviors(ContentTable& table, BlockDescription& block, const BehaviorTable& behaviors) {
    const auto add = [&](const BehaviorPtr& behavior) {
        auto& own = block.type.behaviors;
        if (behavior && std::ranges::find(own, behavior) == own.end()) own.push_back(behavior);
    };
    const Shape shape = block.type.shape;
    const bool isPlant = shape == Shape::Cross || shape == Shape::Hash || shape == Shape::Inset;
    if (table.boolean("needs_ground", isPlant)) add(behaviors.find("plant"));
    if (!block.growth.empty()) add(behaviors.find("crop"));
    if (block.type.slots > 0) add(behaviors.find("container"));

    const toml::node* value = table.node("behaviors");
    if (!value) return;
    const toml::array* names = value->as_array();
    if (!names) return table.expected(*value, "behaviors", "an array of names and tables");
    for (const toml::node& name : *names) {
        if (const toml::table* call = name.as_table()) {
            block.calls.push_back(readCall(table, *call, behaviors));
            if (!block.calls.back().behavior) return;
            continue;
        }
        const auto text = name.value_exact<std::string>();
        const BehaviorPtr behavior = text ? behaviors.find(*text) : nullptr;
        if (!behavior)
            return table.expected(name, "behaviors",
                                  text && behaviors.findTemplate(*text)
                                      ? fmt::format("{{ name = \"{}\", ... }}", *text)
                                      : fmt::format("one of {}", fmt::join(behaviors.names(), ", ")));
        add(behavior);
    }
}

namespace {

constexpr std::size_t kMaxDescribedShapes = 256;
constexpr std::array<std::string_view, 8> kShapeKeys{"name",  "facing",    "half",  "boxes",
                                                     "quads", "collision", "other", "arms"};
constexpr std::array<std::string_view, 3> kPartKeys{"boxes", "quads", "collision"};
constexpr std::array<std::string_view, 5> kQuadKeys{"corners", "uv", "texture", "two_sided", "hidden_by"};

// Looks of a block's faces; all sides have the same.
constexpr std::array<EnumName<Face>, 3> kQuadLooks{
    {{"top", kFacePosZ}, {"bottom", kFaceNegZ}, {"side", kFaceNegX}}};
constexpr std::array<EnumName<Face>, 7> kHidingSides{{{"none", kFaceCount},
                                                      {"-x", kFaceNegX},
                                                      {"+x", kFacePosX},
                                                      {"-y", kFaceNegY},
                                                      {"+y", kFacePosY},
                                                      {"-z", kFaceNegZ},
                                                      {"+z", kFacePosZ}}};

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

// `prefix`: the path of the table in errors, here and below.
std::vector<ShapeBox> readBoxes(ContentTable& table, std::string_view key, std::string_view prefix) {
    const toml::node* value = table.node(key);
    if (!value) return {};
    const toml::array* list = value->as_array();
    std::vector<ShapeBox> boxes;
    for (std::size_t k = 0; list && k < list->size() && k < kMaxShapeBoxes; ++k)
        if (const auto box = readBox((*list)[k])) boxes.push_back(*box);
    if (!list || list->empty() || boxes.size() != list->size())
        table.expected(*value, fmt::format("{}{}", prefix, key),
                       fmt::format("1 to {} boxes [x, y, z, x, y, z] in sixteenths of a block, the lower "
                                   "corner first",
                                   kMaxShapeBoxes));
    return boxes;
}

// A list of as many numbers as a point has axes, 0 to kSixteenths each, in steps of kQuadUnits.
template <class Point>
std::optional<Point> readPoint(const toml::node& node) {
    const toml::array* numbers = node.as_array();
    if (!numbers || numbers->size() != static_cast<std::size_t>(Point::length())) return std::nullopt;
    Point point;
    for (int k = 0; k < Point::length(); ++k) {
        const toml::node& value = (*numbers)[static_cast<std::size_t>(k)];
        const auto number = value.is_number() ? value.value<double>() : std::nullopt;
        if (!number || !(*number >= 0 && *number <= kSixteenths)) return std::nullopt;
        point[k] = static_cast<int>(std::lround(*number * kQuadUnits / kSixteenths));
    }
    return point;
}

template <class Point>
std::optional<std::array<Point, 4>> readPoints(const toml::node& node) {
    const toml::array* list = node.as_array();
    if (!list || list->size() != 4) return std::nullopt;
    std::array<Point, 4> points;
    for (std::size_t k = 0; k < 4; ++k) {
        const auto point = readPoint<Point>((*list)[k]);
        if (!point) return std::nullopt;
        points[k] = *point;
    }
    return points;
}

void readCorners(ContentTable& table, ShapeQuad& quad, std::string_view key) {
    const toml::node* value = table.node("corners");
    if (!value) return table.wrong(table.line(), key, "missing (required)");
    const auto corners = readPoints<glm::ivec3>(*value);
    if (corners) quad.corners = *corners;
    if (!corners)
        table.expected(
            *value, key,
            fmt::format("four corners [x, y, z] from 0 to {}, in sixteenths of a block", kSixteenths));
    else if (!isConvex(quad))
        table.wrong(table.line(), key,
                    "expected corners of a convex area, counterclockwise as seen from its front");
}

ShapeQuad readQuad(ContentTable table, std::string_view prefix) {
    const auto path = [&](std::string_view key) { return fmt::format("{}{}", prefix, key); };
    table.rejectUnknown(kQuadKeys, prefix);
    ShapeQuad quad;
    readCorners(table, quad, path("corners"));
    if (const toml::node* uv = table.node("uv")) {
        quad.texels = readPoints<glm::ivec2>(*uv);
        if (!quad.texels)
            table.expected(
                *uv, path("uv"),
                fmt::format("four points [u, v] from 0 to {}, in sixteenths of the texture from its "
                            "upper left corner",
                            kSixteenths));
    }
    if (const toml::node* look = table.node("texture"))
        quad.look = table.enumOf(*look, path("texture"), kQuadLooks);
    if (const toml::node* twoSided = table.node("two_sided"))
        quad.isTwoSided = table.booleanOf(*twoSided, path("two_sided"));
    if (const toml::node* side = table.node("hidden_by"))
        quad.hiddenBy = table.enumOf(*side, path("hidden_by"), kHidingSides);
    return quad;
}

std::vector<ShapeQuad> readQuads(ContentTable& table, std::string_view prefix) {
    const toml::node* value = table.node("quads");
    if (!value) return {};
    const std::string path = fmt::format("{}quads", prefix);
    const toml::array* list = value->as_array();
    std::vector<ShapeQuad> quads;
    if (!list || list->empty() || list->size() > kMaxShapeQuads || !list->is_homogeneous<toml::table>()) {
        table.expected(*value, path, fmt::format("1 to {} quads {{ corners = ... }}", kMaxShapeQuads));
        return quads;
    }
    for (const toml::node& quad : *list) quads.push_back(readQuad(table.inner(*quad.as_table()), path + "."));
    return quads;
}

ShapePart readPart(ContentTable& table, std::string_view prefix) {
    return {.boxes = readBoxes(table, "boxes", prefix),
            .quads = readQuads(table, prefix),
            .collision = readBoxes(table, "collision", prefix)};
}

// A part that is a list of boxes, or a table of the keys that the shape itself has.
ShapePart readInnerPart(ContentTable& table, std::string_view key) {
    const toml::node* value = table.node(key);
    const toml::table* keys = value ? value->as_table() : nullptr;
    if (!keys) return {.boxes = readBoxes(table, key, ""), .quads = {}, .collision = {}};
    ContentTable inner = table.inner(*keys);
    const std::string prefix = fmt::format("{}.", key);
    inner.rejectUnknown(kPartKeys, prefix);
    ShapePart part = readPart(inner, prefix);
    if (part.isEmpty()) table.expected(*value, key, "boxes or quads");
    return part;
}

// Meshers draw a full cell as a cube, which merges with its neighbors.
bool fillsCell(const ShapeDescription& shape) {
    const std::uint16_t mask = formMask(shape);
    for (unsigned state = 0; state <= mask; ++state)
        if (filledParts(shapeAt(shape, static_cast<std::uint16_t>(state & mask)).boxes) == kCellParts)
            return true;
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
    shape->main = readPart(table, "");
    if (!table.firstOf({"boxes", "quads"})) table.missing("boxes", "or quads");
    shape->other = readInnerPart(table, "other");
    shape->arm = readInnerPart(table, "arms");
    if (!shape->main.boxes.empty() && fillsCell(*shape))
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

SoundMaterial readSound(ContentTable& table, Shape shape) {
    const toml::node* value = table.node("sound");
    if (!value && shape == Shape::Liquid) return SoundMaterial::Water;
    if (!value)
        return shape == Shape::Cross || shape == Shape::Hash ? SoundMaterial::Grass : SoundMaterial::Stone;
    const auto found = std::ranges::find(kSoundMaterialNames, value->value_exact<std::string>().value_or(""));
    if (found != kSoundMaterialNames.end())
        return static_cast<SoundMaterial>(found - kSoundMaterialNames.begin());
    table.expected(*value, "sound", fmt::format("one of {}", fmt::join(kSoundMaterialNames, ", ")));
    return SoundMaterial::None;
}

namespace {

constexpr int kMaxLight = 15;

// Faces are described in three groups.
enum Group : std::uint8_t { kTop, kBottom, kSide, kGroupCount };
constexpr std::array<std::string_view, kGroupCount> kGroupNames{"top", "bottom", "side"};
constexpr std::array<Group, kFaceCount> kGroupOfFace{kSide, kSide, kSide, kSide, kBottom, kTop};

template <class T>
using Groups = std::array<T, kGroupCount>;

constexpr std::array<EnumName<Shape>, 5> kShapes{{{"cube", Shape::Cube},
                                                  {"liquid", Shape::Liquid},
                                                  {"cross", Shape::Cross},
                                                  {"hash", Shape::Hash},
                                                  {"inset", Shape::Inset}}};

constexpr std::array<EnumName<AlphaMode>, 6> kAlphaModes{{{"unused", AlphaMode::Unused},
                                                          {"test", AlphaMode::Test},
                                                          {"blend", AlphaMode::Blend},
                                                          {"glow", AlphaMode::Glow},
                                                          {"test_glow", AlphaMode::TestGlow},
                                                          {"tint", AlphaMode::Tint}}};

constexpr std::array<EnumName<Animation>, 4> kAnimations{{{"none", Animation::None},
                                                          {"top_waves", Animation::TopWaves},
                                                          {"whole_waves", Animation::WholeWaves},
                                                          {"liquid_surface", Animation::LiquidSurface}}};

constexpr std::array<EnumName<Wrap>, 3> kWraps{
    {{"quad", Wrap::Quad}, {"repeat", Wrap::Repeat}, {"clamp", Wrap::Clamp}}};

constexpr std::array<std::string_view, 32> kBlockKeys{
    "name",        "like",       "shape",        "texture",     "textures",    "alpha",    "animation",
    "two_sided",   "wrap",       "sharp",        "inner_faces", "opacity",     "emission", "collides",
    "selection",   "selectable", "needs_ground", "generated",   "growth",      "slots",    "surface_height",
    "wave_height", "behaviors",  "tint",         "climbable",   "replaceable", "group",    "sound",
    "hardness",    "tool",       "tool_level",   "drops"};

// `texture` for all faces or `textures` with one a group: exactly one of them.
Groups<std::string> readTextures(ContentTable& table) {
    const auto read = [&](const toml::node& value, std::string_view key) { return table.nameOf(value, key); };
    if (const toml::node* several = table.own("textures"); several && table.own("texture"))
        table.expected(*several, "textures", "only one of texture and textures");
    const toml::node* found = table.firstOf({"texture", "textures"});
    if (!found) table.missing("texture", "or textures");
    const toml::node* several = table.node("textures") == found ? found : nullptr;
    const toml::node* one = several ? nullptr : found;
    if (one && one->is_table()) table.expected(*one, "texture", "a name of a-z, 0-9 and _");
    if (several && !several->is_table())
        table.expected(*several, "textures", "a table of top, bottom and side");

    Groups<std::string> textures =
        table.valueEach<std::string>(one ? "texture" : "textures", kGroupNames, "", read);
    for (std::size_t g = 0; g < kGroupCount; ++g)
        if (textures[g].empty()) table.missing(fmt::format("textures.{}", kGroupNames[g]));
    return textures;
}

void readFaces(ContentTable& table, BlockDescription& block) {
    const Groups<std::string> textures = readTextures(table);
    const auto alpha = table.valueEach<AlphaMode>(
        "alpha", kGroupNames, AlphaMode::Unused,
        [&](const toml::node& value, auto key) { return table.enumOf(value, key, kAlphaModes); });
    const auto twoSided =
        table.valueEach<bool>("two_sided", kGroupNames, false,
                              [&](const toml::node& value, auto key) { return table.booleanOf(value, key); });
    const auto wrap = table.valueEach<Wrap>(
        "wrap", kGroupNames, Wrap::Quad,
        [&](const toml::node& value, auto key) { return table.enumOf(value, key, kWraps); });
    const auto filtering = table.valueEach<Filtering>(
        "sharp", kGroupNames, Filtering::Option, [&](const toml::node& value, auto key) {
            return table.booleanOf(value, key) ? Filtering::Sharp : Filtering::Nearest;
        });
    const auto tinted =
        table.valueEach<bool>("tint", kGroupNames, false,
                              [&](const toml::node& value, auto key) { return table.booleanOf(value, key); });
    for (std::size_t face = 0; face < kFaceCount; ++face) {
        const Group g = kGroupOfFace[face];
        block.faces[face] = {textures[g], alpha[g], twoSided[g], wrap[g], filtering[g], tinted[g]};
        if (alpha[g] == AlphaMode::Tint && !tinted[g])
            table.expected(*table.node("alpha"), "alpha", "tint = true for faces with alpha = \"tint\"");
    }
    if (const toml::node* value = table.node("animation"))
        block.animation = table.enumOf(*value, "animation", kAnimations);
    block.type.innerFaces = table.boolean("inner_faces", false);
}

// Height and waves of a liquid's surface. Waves sink by 4/3 of their height: they stay above the bottom.
void readSurface(ContentTable& table, BlockDescription& block) {
    constexpr double kMinHeight = 0.125, kMaxWave = 0.25;
    LiquidSurface& surface = block.type.surface;
    if (const toml::node* value = table.node("surface_height")) {
        if (block.type.shape != Shape::Liquid)
            return table.expected(*value, "surface_height", "surface_height only for the shape liquid");
        const double height = table.realOf(*value, "surface_height", kMinHeight, 1);
        surface.heightUnits = static_cast<std::uint16_t>(std::lround(height * shared::kSurfaceUnits));
    }
    const double highest = std::min(kMaxWave, 0.75 * surface.heightUnits / shared::kSurfaceUnits);
    if (const toml::node* value = table.node("wave_height")) {
        if (block.type.shape != Shape::Liquid || block.animation != Animation::LiquidSurface)
            return table.expected(
                *value, "wave_height",
                "wave_height only with the shape liquid and animation = \"liquid_surface\"");
        const double wave = table.realOf(*value, "wave_height", 0, highest);
        surface.waveUnits = static_cast<std::uint16_t>(std::lround(wave * shared::kWaveUnits));
    }
}

std::uint8_t lightOf(ContentTable& table, const toml::node& value, std::string_view key) {
    return static_cast<std::uint8_t>(table.numberOf(value, key, 0, kMaxLight));
}

void readLight(ContentTable& table, BlockDescription& block) {
    if (const toml::node* value = table.node("opacity"))
        block.type.opacity = lightOf(table, *value, "opacity");
    else if (isOpaqueCube(block))
        block.type.opacity = kMaxLight;
    else
        table.missing("opacity", "only opaque cubes have a default");

    const toml::node* value = table.node("emission");
    if (!value) return;
    const toml::array* levels = value->as_array();
    if (!levels || levels->size() != 3) return table.expected(*value, "emission", "[red, green, blue]");
    for (std::size_t i = 0; i < 3; ++i) block.type.emission[i] = lightOf(table, (*levels)[i], "emission");
}

// A corner of a box: three numbers inside the cell.
std::optional<glm::vec3> readCorner(const toml::node& node) {
    const toml::array* numbers = node.as_array();
    if (!numbers || numbers->size() != 3) return std::nullopt;
    glm::vec3 corner{};
    for (int i = 0; i < 3; ++i) {
        const auto number = (*numbers)[static_cast<std::size_t>(i)].value<double>();
        if (!number || !(*number >= 0 && *number <= 1)) return std::nullopt;
        corner[i] = static_cast<float>(*number);
    }
    return corner;
}

Box readBox(ContentTable& table, std::string_view key, const Box& fallback) {
    const toml::node* value = table.node(key);
    if (!value) return fallback;
    const toml::array* corners = value->as_array();
    if (corners && corners->size() == 2) {
        const auto min = readCorner((*corners)[0]), max = readCorner((*corners)[1]);
        if (min && max && min->x < max->x && min->y < max->y && min->z < max->z) return {*min, *max};
    }
    table.expected(*value, key, "[[x, y, z], [x, y, z]] from 0 to 1, the lower corner first");
    return fallback;
}

// Textures of the stages before a plant is grown.
void readGrowth(ContentTable& table, BlockDescription& block) {
    const toml::node* value = table.node("growth");
    if (!value) return;
    const toml::array* names = value->as_array();
    const bool isPlant = block.type.shape == Shape::Cross || block.type.shape == Shape::Hash;
    if (!isPlant) return table.expected(*value, "growth", "growth only for the shapes cross and hash");
    if (!names || names->empty() || names->size() > kMaxGrowthStages) {
        return table.expected(*value, "growth", fmt::format("1 to {} textures", kMaxGrowthStages));
    }
    for (const toml::node& name : *names) {
        block.growth.push_back(block.faces[kFacePosX]);
        block.growth.back().texture = table.nameOf(name, "growth");
    }
}

// A built-in shape, or one that the file describes.
void readShapeName(ContentTable& table, BlockDescription& block, std::span<const ShapePtr> shapes) {
    const toml::node* node = table.node("shape");
    if (!node) return table.missing("shape");
    const auto name = node->value_exact<std::string>();
    const auto found = std::ranges::find_if(shapes, [&](const ShapePtr& s) { return name == s->name; });
    if (found != shapes.end()) {
        block.type.shape = Shape::Model;
        block.shape = *found;
        return;
    }
    std::string expected = listed(kShapes);
    for (const EnumName<Shape>& entry : kShapes) {
        if (name != entry.name) continue;
        block.type.shape = entry.value;
        return;
    }
    for (const ShapePtr& shape : shapes) expected += ", " + shape->name;
    table.expected(*node, "shape", "one of " + expected);
}

struct MaterialHardness {
    SoundMaterial sound;
    double seconds;
    ToolKind tool;
    int toolLevel;
};
// How hard blocks are that say nothing about it, by what they sound like.
constexpr MaterialHardness kHardness[] = {
    {SoundMaterial::Stone, 6, ToolKind::Pick, 1},    {SoundMaterial::Metal, 8, ToolKind::Pick, 1},
    {SoundMaterial::Wood, 2.5, ToolKind::Axe, 0},    {SoundMaterial::Earth, 0.8, ToolKind::Shovel, 0},
    {SoundMaterial::Sand, 0.7, ToolKind::Shovel, 0}, {SoundMaterial::Grass, 0.4, ToolKind::None, 0},
    {SoundMaterial::Snow, 0.4, ToolKind::Shovel, 0}, {SoundMaterial::Glass, 0.5, ToolKind::None, 0},
    {SoundMaterial::Wool, 0.8, ToolKind::None, 0}};

bool isPlantShape(Shape shape) {
    return shape == Shape::Cross || shape == Shape::Hash;
}

void readDrop(ContentTable& table, Drop& drop) {
    const toml::node* value = table.own("drops");  // ore like stone gives no cobble
    if (!value) return;
    if (const toml::table* several = value->as_table()) {
        ContentTable inner = table.inner(*several);
        inner.rejectUnknown(std::initializer_list<std::string_view>{"item", "count"}, "drops.");
        if (const toml::node* item = inner.own("item")) drop.item = item->value_or(std::string());
        if (const toml::node* count = inner.own("count"))
            drop.count = table.numberOf(*count, "drops.count", 0, kMaxStack);
        return;
    }
    const auto name = value->value_exact<std::string>();
    if (!name) return table.expected(*value, "drops", "the name of an item, \"none\", or { item, count }");
    drop = *name == "none" ? Drop{{}, 0} : Drop{*name, 1};
}

// Survival: how long breaking the block takes, and what it gives.
void readBreaking(ContentTable& table, BlockDescription& block) {
    BlockType& type = block.type;
    for (const MaterialHardness& material : kHardness) {
        if (material.sound != type.sound || isPlantShape(type.shape)) continue;
        type.hardness = material.seconds;
        type.tool = material.tool;
        type.toolLevel = material.toolLevel;
    }
    if (const toml::node* value = table.node("hardness"))
        type.hardness = table.realOf(*value, "hardness", 0, kMaxHardness);
    if (const toml::node* value = table.node("tool")) {
        type.tool = table.enumOf(*value, "tool", kToolKinds);
        if (type.tool == ToolKind::None) type.toolLevel = 0;
    }
    if (const toml::node* value = table.node("tool_level"))
        type.toolLevel = table.numberOf(*value, "tool_level", 0, kMaxToolLevel);
    readDrop(table, type.drop);
}

BlockDescription readBlock(ContentTable& table, const BehaviorTable& behaviors,
                           std::span<const ShapePtr> shapes) {
    BlockDescription block;
    block.line = table.line();
    table.rejectUnknown(kBlockKeys);
    if (const toml::node* name = table.own("name"))
        block.type.name = table.nameOf(*name, "name");
    else
        table.missing("name");
    readShapeName(table, block, shapes);

    readFaces(table, block);
    readSurface(table, block);
    readLight(table, block);
    const Box box = shapeBox(block.type.shape);
    if (table.boolean("collides", true)) block.type.collision = {box};
    block.type.selection = readBox(table, "selection", box);
    block.type.selectable = table.boolean("selectable", true);
    block.type.generated = table.boolean("generated", true);
    block.type.climbable = table.boolean("climbable", false);
    block.type.replaceable = table.boolean("replaceable", false);
    const toml::node* group = table.node("group");
    block.type.group = group ? table.nameOf(*group, "group") : "other";
    block.type.sound = readSound(table, block.type.shape);
    readBreaking(table, block);
    readGrowth(table, block);
    if (const toml::node* slots = table.node("slots"))
        block.type.slots = table.numberOf(*slots, "slots", 0, kMaxSlots);
    readBehaviors(table, block, behaviors);
    return block;
}

// The tables of a kind; null if there are none.
const toml::array* tablesOf(ContentTable& top, std::string_view kind) {
    const toml::node* found = top.node(kind);
    const toml::array* tables = found ? found->as_array() : nullptr;
    if (found && !(tables && tables->is_homogeneous<toml::table>()))
        top.expected(*found, kind, fmt::format("tables that begin with [[{}]]", kind));
    return tables;
}

// The tables of blocks above, by name: a block's own first, then those that it is like.
using BlockTables = std::map<std::string, std::vector<const toml::table*>, std::less<>>;

std::vector<const toml::table*> tablesAlike(ContentTable table, const BlockTables& above) {
    const toml::node* like = table.own("like");
    if (!like) return {};
    const auto found = above.find(like->value_exact<std::string>().value_or(""));
    if (found != above.end() && !found->second.empty()) return found->second;
    table.expected(*like, "like", "the name of a block above, in the same file");
    return {};
}

base::Result<BlockFile> readBlocks(const toml::table& root, std::string_view file,
                                   const BehaviorTable& behaviors, std::span<const ShapePtr> givenShapes) {
    std::optional<std::string> error;
    BlockFile read;
    std::vector<BlockDescription>& blocks = read.blocks;
    BlockTables tablesOfBlock{{"air", {}}, {"missing", {}}};

    ContentTable top(root, file, error);
    top.rejectUnknown(std::initializer_list<std::string_view>{"block", "shape"});
    std::vector<std::string_view> builtIn;
    for (const EnumName<Shape>& entry : kShapes) builtIn.push_back(entry.name);
    for (const ShapePtr& shape : givenShapes) builtIn.push_back(shape->name);
    read.shapes = readShapes(tablesOf(top, "shape"), builtIn, file, error);
    std::vector<ShapePtr> shapes(givenShapes.begin(), givenShapes.end());
    shapes.insert(shapes.end(), read.shapes.begin(), read.shapes.end());
    const toml::array* tables = tablesOf(top, "block");
    for (std::size_t i = 0; tables && !error && i < tables->size(); ++i) {
        const toml::table& own = *(*tables)[i].as_table();
        std::vector<const toml::table*> like = tablesAlike(ContentTable(own, file, error), tablesOfBlock);
        ContentTable table(own, file, error, like);
        if (i == kMaxDescribedBlocks)
            table.wrong(table.line(), "block",
                        fmt::format("expected at most {}, got more", kMaxDescribedBlocks));
        blocks.push_back(readBlock(table, behaviors, shapes));
        blocks.back().file = file;
        like.insert(like.begin(), &own);
        if (!tablesOfBlock.emplace(blocks.back().type.name, std::move(like)).second && !error)
            table.expected(*table.own("name"), "name", "a name not used before");
    }
    if (error) return base::fail(base::ErrorCode::BadInput, "{}", base::inOneLine(std::move(*error)));
    return read;
}

}  // namespace

base::Result<BlockFile> parseBlocks(std::string_view toml, std::string_view file,
                                    const BehaviorTable& behaviors, std::span<const ShapePtr> shapes) {
    return readBlocks(TERRANE_TRY(base::parseToml(toml, file)), file, behaviors, shapes);
}

bool isOpaqueCube(const BlockDescription& block) {
    const auto opaque = [](const FaceDescription& face) {
        return face.alpha == AlphaMode::Unused || face.alpha == AlphaMode::Glow ||
               face.alpha == AlphaMode::Tint;
    };
    return block.type.shape == Shape::Cube && std::all_of(block.faces.begin(), block.faces.end(), opaque);
}

Box shapeBox(Shape shape) {
    if (shape != Shape::Inset) return {};
    return {.min = {1 / 16.f, 1 / 16.f, 0}, .max = {15 / 16.f, 15 / 16.f, 1}};
}

}  // namespace terrane::world

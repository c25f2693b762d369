#include "apps/terrane/record/script.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <span>

#include "apps/terrane/options.h"
#include "apps/terrane/record/title_painter.h"
#include "apps/terrane/settings.h"

namespace terrane::app {

namespace {

constexpr double kMaxNumber = 1e15;  // of a place or an angle: floats of it are finite

}  // namespace

double numberOf(world::ContentTable& table, std::string_view key, double fallback, double min, double max) {
    const toml::node* node = table.node(key);
    if (!node) return fallback;
    const auto value = node->is_number() ? node->value<double>() : std::nullopt;
    if (value && *value >= min && *value <= max) return *value;
    table.expected(*node, key, fmt::format("a number from {} to {}", min, max));
    return fallback;
}

std::optional<std::vector<double>> numbersOf(world::ContentTable& table, std::string_view key,
                                             std::size_t count, std::string_view form) {
    const toml::node* node = table.node(key);
    if (!node) return std::nullopt;
    std::vector<double> numbers;
    if (const toml::array* array = node->as_array()) {
        for (const toml::node& element : *array) {
            const auto value = element.is_number() ? element.value<double>() : std::nullopt;
            if (value && std::abs(*value) <= kMaxNumber) numbers.push_back(*value);
        }
        if (numbers.size() == count && array->size() == count) return numbers;
    }
    table.expected(*node, key, form);
    return std::vector<double>(count, 0.0);
}

std::optional<world::BlockPos> blockPosOf(world::ContentTable& table, std::string_view key) {
    constexpr std::string_view kForm =
        "[x, y, z] of a block in the world, whole numbers, z from -2048 to 2047";
    constexpr world::Heights kAnyHeights{world::kLowestBottom, world::kHighestTop};
    const auto n = numbersOf(table, key, 3, kForm);
    if (!n) return std::nullopt;
    const bool areBlocks = std::ranges::all_of(
        *n, [](double v) { return v == std::floor(v) && v >= INT32_MIN && v <= INT32_MAX; });
    if (!areBlocks || !kAnyHeights.contains(static_cast<int>((*n)[2]))) {
        table.expected(*table.node(key), key, kForm);
        return world::BlockPos{};
    }
    return world::BlockPos{static_cast<std::int32_t>((*n)[0]), static_cast<std::int32_t>((*n)[1]),
                           static_cast<std::int32_t>((*n)[2])};
}

void applyFlags(world::ContentTable& table, CLI::App& flags, const Names& names, const Names& given) {
    for (const std::string& name : names) {
        const toml::node* value = table.node(name);
        if (!value || std::ranges::find(given, name) != given.end()) continue;
        if (const auto set = setFromToml(*flags.get_option("--" + name), *value); !set)
            table.wrong(static_cast<int>(value->source().begin.line), name, set.error().message);
    }
}

namespace {

using world::ContentTable;

constexpr double kMaxSeconds = 24 * 3600;           // of a shot
constexpr std::int64_t kMaxBlocksOfEdit = 1 << 18;  // about a second of work

Names with(Names names, std::span<const render::GraphicsRow> rows) {
    for (const render::GraphicsRow& row : rows) names.emplace_back(row.name);
    return names;
}

// Flags for drawing, with the preset before the flags that change it.
Names drawingFlags() {
    return with({"preset", "view-distance", "view"}, render::graphicsTable());
}

// A preset on the command line overrides the file's graphics options, as with settings of the window.
Names passedOver(Names given) {
    const bool hasPreset = std::ranges::find(given, "preset") != given.end();
    if (hasPreset) std::ranges::copy(render::namesOfPreset(), std::back_inserter(given));
    return given;
}

Names with(Names names, std::initializer_list<const char*> more) {
    names.insert(names.end(), more.begin(), more.end());
    return names;
}

// Reads one file. Results after the first error are unusable.
class ScriptReader {
  public:
    ScriptReader(std::string_view file, const ScriptDefaults& defaults, const world::BlockRegistry& blocks)
        : file_(file), defaults_(defaults), passedOver_(passedOver(defaults.given)), blocks_(blocks) {}

    base::Result<Script> read(const toml::table& root);

  private:
    ContentTable open(const toml::table& table) { return {table, file_, error_}; }

    io::WorldOptions worldOf(ContentTable& table);
    GraphicsOptions graphicsAfter(GraphicsOptions graphics, ContentTable& table);

    template <class Read>
    void each(ContentTable& table, std::string_view key, Read read);

    view::CameraKey keyOf(ContentTable& table, const view::CameraKey& before, bool isFirst);
    std::vector<view::CameraKey> keysOf(ContentTable& table);
    std::string textOf(ContentTable& table, std::string_view key);
    view::TitleCue titleOf(ContentTable& table, double shotSeconds);
    view::PlayerCue playerOf(ContentTable& table);
    view::EditCue editOf(ContentTable& table, const view::Shot& shot);
    void readBox(ContentTable& table, view::EditCue& edit);
    void readOptions(ContentTable& shot, view::Shot& into, const GraphicsOptions& atFirst);
    void readShot(ContentTable& table, const GraphicsOptions& graphics, std::vector<view::Shot>& shots);

    std::string_view file_;
    const ScriptDefaults& defaults_;
    const Names passedOver_;
    const world::BlockRegistry& blocks_;
    std::optional<std::string> error_;
};

io::WorldOptions ScriptReader::worldOf(ContentTable& table) {
    io::WorldOptions world = defaults_.world;
    CLI::App flags;
    addWorldOptions(flags, world);
    applyFlags(table, flags, {"seed", "generator", "bottom", "top"}, passedOver_);
    return world;
}

GraphicsOptions ScriptReader::graphicsAfter(GraphicsOptions graphics, ContentTable& table) {
    CLI::App flags;
    addGraphicsOptions(flags, graphics, graphics.choices.preset);
    applyFlags(table, flags, drawingFlags(), passedOver_);
    return graphics;
}

// Reads each table of an array of tables.
template <class Read>
void ScriptReader::each(ContentTable& table, std::string_view key, Read read) {
    const toml::node* node = table.node(key);
    if (!node) return;
    const toml::array* array = node->as_array();
    if (!array) return table.expected(*node, key, "an array of tables");
    for (const toml::node& element : *array) {
        if (!element.is_table()) return table.expected(element, key, "a table");
        ContentTable inner = open(*element.as_table());
        read(inner);
    }
}

view::CameraKey ScriptReader::keyOf(ContentTable& table, const view::CameraKey& before, bool isFirst) {
    table.rejectUnknown(Names{"time", "at", "look", "look-at", "day", "fov"});
    view::CameraKey key = before;
    key.time = numberOf(table, "time", 0, 0, kMaxSeconds);
    if (!table.node("time") && !isFirst) table.missing("time");
    const auto at = numbersOf(table, "at", 3, "[x, y, z] in blocks");
    if (at) key.position = {(*at)[0], (*at)[1], (*at)[2]};
    if (!at && isFirst) table.missing("at");
    const auto look = numbersOf(table, "look", 2, "[yaw, pitch] in degrees");
    const auto lookAt = numbersOf(table, "look-at", 3, "[x, y, z] in blocks");
    if (look && lookAt) table.wrong(table.line(), "look-at", "only one of look and look-at");
    if (!look && !lookAt && isFirst) table.missing("look", "or look-at");
    if (!isFirst && (look ? before.lookAt.has_value() : lookAt && !before.lookAt))
        table.wrong(table.line(), "look", "the keys of a shot either all have look or all have look-at");
    if (look) {
        key.yaw = (*look)[0];
        key.pitch = (*look)[1];
        if (std::abs(key.pitch) > 90) table.expected(*table.node("look"), "look", "a pitch from -90 to 90");
    }
    if (lookAt) key.lookAt = glm::dvec3((*lookAt)[0], (*lookAt)[1], (*lookAt)[2]);
    if (key.lookAt == key.position) table.wrong(table.line(), "look-at", "is where the camera is");
    key.timeDay = numberOf(table, "day", before.timeDay, 0, 1000);
    key.fieldOfView = numberOf(table, "fov", before.fieldOfView, 10, 120);
    if (!world::isInWorld(render::cameraChunk({key.position, 0, 0})))
        table.wrong(table.line(), "at", "outside the world");
    return key;
}

// The keys of a shot or of a player.
std::vector<view::CameraKey> ScriptReader::keysOf(ContentTable& table) {
    std::vector<view::CameraKey> keys;
    each(table, "key", [&](ContentTable& inner) {
        const view::CameraKey key =
            keyOf(inner, keys.empty() ? view::CameraKey{} : keys.back(), keys.empty());
        if (!keys.empty() && key.time <= keys.back().time)
            inner.wrong(inner.line(), "time",
                        fmt::format("must be after {}, the key before", keys.back().time));
        keys.push_back(key);
    });
    if (keys.empty()) table.missing("key", "at least one");
    return keys;
}

// A required text; empty after an error.
std::string ScriptReader::textOf(ContentTable& table, std::string_view key) {
    const toml::node* node = table.node(key);
    const auto value = node ? node->value_exact<std::string>() : std::nullopt;
    if (!node) {
        table.missing(key);
    } else if (!value || value->empty()) {
        table.expected(*node, key, "a text");
    }
    return value.value_or("");
}

view::TitleCue ScriptReader::titleOf(ContentTable& table, double shotSeconds) {
    table.rejectUnknown(Names{"time", "seconds", "text", "place"});
    view::TitleCue title;
    title.time = numberOf(table, "time", 0, 0, shotSeconds);
    title.seconds = numberOf(table, "seconds", title.seconds, 0.1, kMaxSeconds);
    title.text = textOf(table, "text");
    if (const std::string missing = TitlePainter::missingLetter(title.text); !missing.empty())
        table.expected(*table.node("text"), "text", fmt::format("letters of ISO 8859-1 (not {})", missing));
    const toml::node* place = table.node("place");
    constexpr std::array<world::EnumName<bool>, 2> kPlaces = {{{"bottom", false}, {"middle", true}}};
    if (place) title.isLarge = table.enumOf(*place, "place", kPlaces);
    return title;
}

// The block `at`, or the box between two corners.
void ScriptReader::readBox(ContentTable& table, view::EditCue& edit) {
    const auto at = blockPosOf(table, "at"), from = blockPosOf(table, "from"), to = blockPosOf(table, "to");
    if (at ? from || to : !from || !to)
        return table.wrong(table.line(), "at", "needs either at, or from and to");
    const world::BlockPos a = at ? *at : *from, b = at ? *at : *to;
    edit.box.low = {std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)};
    edit.box.high = {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
    const auto& [low, high] = edit.box;
    const double columns = (0.0 + high.x - low.x + 1) * (0.0 + high.y - low.y + 1);
    if (columns * (high.z - low.z + 1) > kMaxBlocksOfEdit)
        table.wrong(table.line(), "to", fmt::format("more than {} blocks at once", kMaxBlocksOfEdit));
}

view::PlayerCue ScriptReader::playerOf(ContentTable& table) {
    table.rejectUnknown(Names{"name", "number", "key"});
    const std::string name = textOf(table, "name");
    const double number = numberOf(table, "number", 0, 0, 1000);
    if (number != std::floor(number)) table.expected(*table.node("number"), "number", "a whole number");
    std::vector<view::CameraKey> keys = keysOf(table);
    if (keys.empty()) keys.emplace_back();  // after an error
    return {name, static_cast<std::uint32_t>(number), view::CameraPath(std::move(keys))};
}

view::EditCue ScriptReader::editOf(ContentTable& table, const view::Shot& shot) {
    table.rejectUnknown(Names{"time", "seconds", "at", "from", "to", "block", "player"});
    view::EditCue edit;
    edit.time = numberOf(table, "time", 0, 0, shot.seconds);
    edit.seconds = numberOf(table, "seconds", 0, 0, kMaxSeconds);
    readBox(table, edit);
    if (const toml::node* player = table.node("player")) {
        edit.player = textOf(table, "player");
        if (std::ranges::find(shot.players, edit.player, &view::PlayerCue::name) == shot.players.end())
            table.expected(*player, "player", "the name of a player of the shot");
    }
    const toml::node* node = table.node("block");
    if (!node) {
        table.missing("block");
        return edit;
    }
    const auto name = node->value_exact<std::string>();
    const world::BlockType* type = name ? blocks_.find(*name) : nullptr;
    if (type) edit.block = type->id;
    if (!type && name != "air") table.expected(*node, "block", "a name that terrane blocks lists, or air");
    return edit;
}

void ScriptReader::readOptions(ContentTable& shot, view::Shot& into, const GraphicsOptions& atFirst) {
    std::multimap<double, ContentTable> changes;  // by time
    each(shot, "set", [&](ContentTable& table) {
        table.rejectUnknown(with(drawingFlags(), {"time"}));
        changes.emplace(numberOf(table, "time", 0, 0, into.seconds), table);
    });
    GraphicsOptions graphics = atFirst;
    into.options.push_back({0, graphics.choices, graphics.view});
    for (auto& [time, table] : changes) {
        graphics = graphicsAfter(std::move(graphics), table);
        into.options.push_back({time, graphics.choices, graphics.view});
    }
}

void ScriptReader::readShot(ContentTable& table, const GraphicsOptions& graphics,
                            std::vector<view::Shot>& shots) {
    table.rejectUnknown(Names{"name", "seconds", "key", "title", "set", "edit", "player"});
    const std::vector<view::CameraKey> keys = keysOf(table);
    if (error_) return;
    view::Shot shot{
        .name = "", .path = view::CameraPath(keys), .options = {}, .titles = {}, .edits = {}, .players = {}};
    if (!shots.empty()) shot.start = shots.back().start + shots.back().seconds;
    shot.seconds = numberOf(table, "seconds", keys.back().time, 0, kMaxSeconds);
    if (shot.seconds <= 0) table.wrong(table.line(), "seconds", "a shot takes more than 0");
    if (shot.seconds < keys.back().time)
        table.wrong(table.line(), "seconds", fmt::format("the shot has a key at {}", keys.back().time));
    if (const toml::node* name = table.node("name")) shot.name = name->value_or(std::string());
    readOptions(table, shot, graphics);
    each(table, "title", [&](ContentTable& inner) { shot.titles.push_back(titleOf(inner, shot.seconds)); });
    each(table, "player", [&](ContentTable& inner) { shot.players.push_back(playerOf(inner)); });
    each(table, "edit", [&](ContentTable& inner) { shot.edits.push_back(editOf(inner, shot)); });
    std::ranges::stable_sort(shot.edits, std::less<>(), &view::EditCue::time);
    shots.push_back(std::move(shot));
}

base::Result<Script> ScriptReader::read(const toml::table& root) {
    ContentTable table = open(root);
    table.rejectUnknown(Names{"seed", "generator", "options", "shot"});
    Script script;
    script.world = worldOf(table);
    GraphicsOptions graphics = defaults_.graphics;
    if (const toml::node* options = table.node("options")) {
        if (const toml::table* inner = options->as_table()) {
            ContentTable drawing = open(*inner);
            drawing.rejectUnknown(drawingFlags());
            graphics = graphicsAfter(graphics, drawing);
        } else {
            table.expected(*options, "options", "a table");
        }
    }
    each(table, "shot", [&](ContentTable& shot) { readShot(shot, graphics, script.shots); });
    if (script.shots.empty()) table.missing("shot", "a video has at least one");
    if (error_) return base::fail("{}", *error_);
    return script;
}

}  // namespace

base::Result<Script> parseScript(std::string_view toml, std::string_view name, const ScriptDefaults& defaults,
                                 const world::BlockRegistry& blocks) {
    toml::table root = TERRANE_TRY(base::parseToml(toml, name));
    useCurrentNames(root);
    return ScriptReader(name, defaults, blocks).read(root);
}

}  // namespace terrane::app

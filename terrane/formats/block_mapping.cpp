#include "terrane/formats/block_mapping.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include "terrane/base/files.h"
#include "terrane/base/toml.h"
#include "terrane/world/blocks/block_behavior.h"
#include "terrane/world/blocks/block_model.h"
#include "terrane/world/changes/liquid_flow.h"

namespace terrane::formats {

const std::string* NamedState::property(std::string_view property) const {
    for (const auto& entry : properties)
        if (entry.first == property) return &entry.second;
    return nullptr;
}

void NamedState::set(std::string_view property, std::string value) {
    const auto place = std::ranges::lower_bound(
        properties, property, {}, [](const auto& entry) { return std::string_view(entry.first); });
    if (place != properties.end() && place->first == property)
        place->second = std::move(value);
    else
        properties.insert(place, {std::string(property), std::move(value)});
}

std::string textOf(const NamedState& state) {
    std::string text = state.name;
    for (std::size_t k = 0; k < state.properties.size(); ++k) {
        text += k == 0 ? '[' : ',';
        text += state.properties[k].first;
        text += '=';
        text += state.properties[k].second;
    }
    if (!state.properties.empty()) text += ']';
    return text;
}

std::optional<NamedState> namedState(std::string_view text) {
    NamedState state;
    const std::size_t bracket = text.find('[');
    const std::string_view name = text.substr(0, bracket);
    if (name.empty()) return std::nullopt;
    state.name =
        name.find(':') == std::string_view::npos ? "minecraft:" + std::string(name) : std::string(name);
    if (bracket == std::string_view::npos) return state;
    std::string_view rest = text.substr(bracket + 1);
    if (!rest.ends_with(']')) return std::nullopt;
    rest.remove_suffix(1);
    while (!rest.empty()) {
        const std::string_view pair = rest.substr(0, rest.find(','));
        const std::size_t equals = pair.find('=');
        if (equals == std::string_view::npos || equals == 0) return std::nullopt;
        state.set(pair.substr(0, equals), std::string(pair.substr(equals + 1)));
        rest.remove_prefix(std::min(pair.size() + 1, rest.size()));
    }
    return state;
}

namespace {

constexpr int kLegacyIds = 4096, kLegacyData = 16;

int lineOf(const toml::node& node) {
    return static_cast<int>(node.source().begin.line);
}

// States of a text or a list of texts; empty if it is neither.
std::vector<NamedState> statesOf(const toml::node& node) {
    std::vector<NamedState> states;
    const auto take = [&](const toml::node& value) {
        const auto text = value.value_exact<std::string>();
        auto state = text ? namedState(*text) : std::nullopt;
        if (state) states.push_back(std::move(*state));
        return state.has_value();
    };
    const toml::array* list = node.as_array();
    if (!list) {
        take(node);
        return states;
    }
    for (const toml::node& value : *list)
        if (!take(value) || states.size() > kLegacyData) return {};
    return states;
}

}  // namespace

base::Result<LegacyIds> LegacyIds::parse(std::string_view toml, std::string_view name) {
    const toml::table table = TERRANE_TRY(base::parseToml(toml, name));
    LegacyIds ids;
    const toml::table* entries = table["ids"].as_table();
    if (!entries) return base::fail(base::ErrorCode::BadInput, "{}:1: ids: required", name);
    for (const auto& [key, value] : *entries) {
        int id = -1;
        const std::string_view text = key.str();
        const auto [end, bad] = std::from_chars(text.data(), text.data() + text.size(), id);
        if (bad != std::errc() || end != text.data() + text.size() || id < 0 || id >= kLegacyIds)
            return base::fail(base::ErrorCode::BadInput, "{}:{}: ids.{}: expected a number from 0 to {}",
                              name, lineOf(value), text, kLegacyIds - 1);
        auto states = statesOf(value);
        if (states.empty())
            return base::fail(base::ErrorCode::BadInput,
                              "{}:{}: ids.{}: expected a block's name, or a list of at most {}", name,
                              lineOf(value), text, kLegacyData);
        if (ids.byId_.size() <= static_cast<std::size_t>(id))
            ids.byId_.resize(static_cast<std::size_t>(id) + 1);
        ids.byId_[static_cast<std::size_t>(id)] = std::move(states);
    }
    return ids;
}

NamedState LegacyIds::stateOf(int id, int data) const {
    const auto index = static_cast<std::size_t>(id);
    if (id < 0 || index >= byId_.size() || byId_[index].empty())
        return {fmt::format("minecraft:id_{}_{}", id, data), {}};
    const std::vector<NamedState>& states = byId_[index];
    const auto at = static_cast<std::size_t>(data);
    if (at < states.size()) return states[at];
    return at >= 8 && at - 8 < states.size() ? states[at - 8] : states[0];
}

namespace {

using world::BlockType;

// By our facing: quarter turns counterclockwise from +y.
constexpr std::array<std::string_view, 4> kDirections{"south", "east", "north", "west"};
// By our arm: -x, +x, -y, +y.
constexpr std::array<std::string_view, 4> kArmDirections{"east", "west", "north", "south"};
// Sixteenths of a clockwise turn, 0 is south.
constexpr int kRotations = 16;
// The age of a ripe plant.
int grownAge(const NamedState& state) {
    const bool hasFewAges = state.name == "minecraft:beetroots" || state.name == "minecraft:nether_wart";
    return hasFewAges ? 3 : 7;
}
constexpr std::uint16_t kLiquidForm = 15;  // level and falling

bool is(const NamedState& state, std::string_view property, std::string_view value) {
    const std::string* found = state.property(property);
    return found && *found == value;
}

int numberOf(const NamedState& state, std::string_view property, int fallback) {
    const std::string* found = state.property(property);
    int value = fallback;
    if (found) std::from_chars(found->data(), found->data() + found->size(), value);
    return value;
}

std::uint16_t formBits(const BlockType& type) {
    return type.model ? type.model->stateMask : std::uint16_t{0};
}

bool hasFacing(const BlockType& type) {
    return (formBits(type) & world::kStateFacing) != 0;
}

// Whether it is a door or a gate, whose other form is the open one.
bool opens(const BlockType& type) {
    return world::hasBehavior(type, "opens") || world::hasBehavior(type, "door");
}

std::uint16_t facingOf(const NamedState& state, bool isOpposite) {
    int facing = 0;
    if (const std::string* direction = state.property("facing")) {
        const auto at = std::ranges::find(kDirections, *direction);
        if (at == kDirections.end()) return 0;
        facing = static_cast<int>(at - kDirections.begin());
    } else if (state.property("rotation")) {
        // Clockwise from south: 4 is west, 8 north, 12 east.
        const int quarters = (std::clamp(numberOf(state, "rotation", 0), 0, kRotations - 1) + 2) / 4 % 4;
        facing = (4 - quarters) % 4;
    } else {
        return 0;
    }
    return static_cast<std::uint16_t>(isOpposite ? (facing + 2) % 4 : facing);
}

std::uint16_t armsOf(const NamedState& state) {
    std::uint16_t arms = 0;
    for (unsigned side = 0; side < kArmDirections.size(); ++side) {
        const std::string* value = state.property(kArmDirections[side]);
        const bool isThere = value && (*value == "true" || *value == "low" || *value == "tall");
        if (isThere) arms |= static_cast<std::uint16_t>(1u << (world::kStateArmShift + side));
    }
    return arms;
}

// A plant's state counts the stages that are left.
std::uint16_t growthOf(const BlockType& type, const NamedState& state) {
    const int stages = static_cast<int>(type.growth.size());
    const int grown = grownAge(state), age = std::clamp(numberOf(state, "age", grown), 0, grown);
    return static_cast<std::uint16_t>(((grown - age) * stages + grown - 1) / grown);
}

void addMissing(NamedState& state, std::string_view property, std::string_view value) {
    if (!state.property(property)) state.set(property, std::string(value));
}

void addFacing(std::uint16_t state, bool isOpposite, NamedState& named) {
    const unsigned facing = (state + (isOpposite ? 2u : 0u)) & world::kStateFacing;
    const bool isStandingSign = named.name.ends_with("_sign") && !named.name.ends_with("_wall_sign");
    if (isStandingSign)
        addMissing(named, "rotation", std::to_string((4 - facing) % 4 * 4));
    else
        addMissing(named, "facing", kDirections[facing]);
}

void addHalf(bool isUpsideDown, NamedState& named) {
    if (named.name.ends_with("_slab"))
        addMissing(named, "type", isUpsideDown ? "top" : "bottom");
    else if (named.name.ends_with("lantern"))
        addMissing(named, "hanging", isUpsideDown ? "true" : "false");
    else
        addMissing(named, "half", isUpsideDown ? "top" : "bottom");
}

}  // namespace

std::uint16_t stateOfProperties(const BlockType& type, const NamedState& state, bool isOpposite) {
    const std::uint16_t bits = formBits(type);
    std::uint16_t result = 0;
    if (hasFacing(type)) result |= facingOf(state, isOpposite);
    const bool isTop = is(state, "half", "top") || is(state, "type", "top") || is(state, "hanging", "true");
    if ((bits & world::kStateUpsideDown) != 0 && isTop) result |= world::kStateUpsideDown;
    if (opens(type) && is(state, "open", "true")) result |= world::kStateOther;
    if ((bits & world::kStateArms) != 0) result |= armsOf(state);
    if (world::hasBehavior(type, "flows")) {
        const int level = std::clamp(numberOf(state, "level", 0), 0, static_cast<int>(kLiquidForm));
        result |= static_cast<std::uint16_t>(std::min(level, 8));
    }
    if (!type.growth.empty()) result |= growthOf(type, state);
    return result;
}

void addProperties(const BlockType& type, std::uint16_t state, bool isOpposite, NamedState& named) {
    const std::uint16_t bits = formBits(type);
    if (hasFacing(type) && named.name != "minecraft:torch") addFacing(state, isOpposite, named);
    if ((bits & world::kStateUpsideDown) != 0) addHalf((state & world::kStateUpsideDown) != 0, named);
    if (opens(type)) addMissing(named, "open", (state & world::kStateOther) != 0 ? "true" : "false");
    for (unsigned side = 0; side < kArmDirections.size() && (bits & world::kStateArms) != 0; ++side) {
        const bool isThere = (state >> (world::kStateArmShift + side) & 1) != 0;
        addMissing(named, kArmDirections[side], isThere ? "true" : "false");
    }
    if (world::hasBehavior(type, "flows")) addMissing(named, "level", std::to_string(state & kLiquidForm));
    if (!type.growth.empty()) {
        const int stages = static_cast<int>(type.growth.size());
        const int grown = grownAge(named), age = grown - std::min<int>(state, stages) * grown / stages;
        addMissing(named, "age", std::to_string(age));
    }
}

namespace {

constexpr std::string_view kOwnNamespace = "terrane:";

std::optional<std::uint16_t> stateNumber(std::string_view text) {
    std::uint16_t value = 0;
    const auto [end, bad] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (bad != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

// "terrane:NAME[state=N]"; nothing if the registry lacks it or the name has another namespace.
std::optional<BlockAndState> ownBlock(const NamedState& named, const world::BlockRegistry& blocks) {
    if (!named.name.starts_with(kOwnNamespace)) return std::nullopt;
    const world::BlockType* type = blocks.find(std::string_view(named.name).substr(kOwnNamespace.size()));
    if (!type) return std::nullopt;
    const std::string* state = named.property("state");
    return BlockAndState{type->id, state ? stateNumber(*state).value_or(0) : std::uint16_t{0}};
}

bool holds(const NamedState& all, const NamedState& some) {
    return std::ranges::all_of(some.properties, [&](const auto& property) {
        const std::string* value = all.property(property.first);
        return value && *value == property.second;
    });
}

}  // namespace

// Prefers entries with more properties; of equal ones the last, which is the later file's.
const BlockMapping::Entry* BlockMapping::entryOf(const NamedState& state) const {
    const auto found = byName_.find(state.name);
    if (found == byName_.end()) return nullptr;
    const Entry* best = nullptr;
    for (const std::size_t k : found->second) {
        const Entry& entry = entries_[k];
        const bool isBetter = !best || entry.name.properties.size() >= best->name.properties.size();
        if (isBetter && holds(state, entry.name)) best = &entry;
    }
    return best;
}

bool BlockMapping::isOpposite(world::BlockId id) const {
    return std::ranges::find(opposite_, id) != opposite_.end();
}

BlockAndState BlockMapping::applied(const Entry& entry, const NamedState& state) const {
    const world::BlockType& type = blocks_->type(entry.block.id);
    const std::uint16_t bits = stateOfProperties(type, state, isOpposite(type.id));
    return {entry.block.id, static_cast<std::uint16_t>(entry.block.state | bits)};
}

BlockAndState BlockMapping::blockOf(const NamedState& state) const {
    if (const Entry* entry = entryOf(state)) return applied(*entry, state);
    return ownBlock(state, *blocks_).value_or(BlockAndState{blocks_->missing(), 0});
}

bool BlockMapping::isKnown(const NamedState& state) const {
    return entryOf(state) || ownBlock(state, *blocks_);
}

std::vector<std::pair<world::BlockId, world::BlockId>> BlockMapping::doors() const {
    std::vector<std::pair<world::BlockId, world::BlockId>> doors;
    for (const world::BlockType& type : blocks_->types()) {
        const world::BlockType* top = blocks_->find(type.name + "_top");
        if (top && world::hasBehavior(type, "door")) doors.emplace_back(type.id, top->id);
    }
    return doors;
}

NamedState BlockMapping::nameOf(BlockAndState block) const {
    const world::BlockType& type = blocks_->type(block.id);
    const auto found = byBlock_.find(block.id);
    for (const std::size_t k : found == byBlock_.end() ? std::vector<std::size_t>() : found->second) {
        NamedState name = entries_[k].name;
        addProperties(type, block.state, isOpposite(block.id), name);
        if (blockOf(name) == block) return name;
    }
    NamedState own{std::string(kOwnNamespace) + type.name, {}};
    if (block.state != 0) own.set("state", std::to_string(block.state));
    return own;
}

}  // namespace terrane::formats

// Reads the tables of block_mapping.h.

namespace terrane::embedded {
std::span<const base::EmbeddedFile> formats();
}  // namespace terrane::embedded

namespace terrane::formats {
namespace {

constexpr std::size_t kMaxMappingBytes = std::size_t{4} << 20;

std::optional<std::uint32_t> colorOf(std::string_view text) {
    if (text.size() != 7 || text[0] != '#') return std::nullopt;
    std::uint32_t value = 0;
    const auto [end, bad] = std::from_chars(text.data() + 1, text.data() + text.size(), value, 16);
    if (bad != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

base::Result<std::string_view> builtInFile(std::string_view name) {
    for (const base::EmbeddedFile& file : embedded::formats())
        if (file.path == name) return file.data;
    return base::fail("{}: not in the program", name);
}

}  // namespace

// Reads one file into a mapping; keeps the first error.
class BlockMapping::Reader {
  public:
    Reader(BlockMapping& mapping, const MappingFile& file) : mapping_(mapping), file_(file) {}

    base::Result<void> read() {
        const toml::table table = TERRANE_TRY(base::parseToml(file_.toml, file_.name));
        for (const auto& [key, value] : table) {
            if (key == "opposite")
                readOpposite(value);
            else if (key == "blocks" && value.is_table())
                readBlocks(*value.as_table());
            else if (key == "colors" && value.is_table())
                readColors(*value.as_table());
            else
                wrong(value, key.str(), "expected the list opposite, and the tables blocks and colors");
        }
        if (problem_) return tl::unexpected(*problem_);
        return {};
    }

  private:
    void wrong(const toml::node& node, std::string_view key, std::string_view what) {
        if (problem_) return;
        problem_ = base::Error{base::ErrorCode::BadInput,
                               fmt::format("{}:{}: {}: {}", file_.name, node.source().begin.line, key, what)};
    }

    const world::BlockType* typeOf(const toml::node& node, std::string_view key, std::string_view name) {
        const world::BlockType* type = mapping_.blocks_->find(name);
        if (!type) wrong(node, key, fmt::format("there is no block \"{}\"", name));
        return type;
    }

    void readOpposite(const toml::node& node) {
        if (!node.is_array()) return wrong(node, "opposite", "expected a list of blocks");
        for (const toml::node& value : *node.as_array()) {
            const world::BlockType* type = typeOf(value, "opposite", value.value_or(std::string_view()));
            if (type) mapping_.opposite_.push_back(type->id);
        }
    }

    // "torch", or "torch[8]" with a block state.
    void readBlocks(const toml::table& table) {
        for (const auto& [key, names] : table) {
            const std::string_view text = key.str(), name = text.substr(0, text.find('['));
            const world::BlockType* type = typeOf(names, text, name);
            std::uint16_t state = 0;
            if (name != text) {
                const char *begin = text.data() + name.size() + 1, *end = text.data() + text.size() - 1;
                const auto [after, bad] = std::from_chars(begin, std::max(begin, end), state);
                if (bad != std::errc() || after != end || *end != ']')
                    wrong(names, text, "expected a block state as NAME[0] to NAME[65535]");
            }
            if (!names.is_array()) wrong(names, text, "expected a list of names");
            if (problem_) return;
            for (const toml::node& value : *names.as_array()) addName(value, text, {type->id, state});
        }
    }

    void addName(const toml::node& value, std::string_view key, BlockAndState block) {
        auto name = namedState(value.value_or(std::string_view()));
        if (!name) return wrong(value, key, "expected a name, \"oak_slab[type=double]\"");
        const std::size_t number = mapping_.entries_.size();
        mapping_.byName_[name->name].push_back(number);
        mapping_.byBlock_[block.id].push_back(number);
        mapping_.entries_.push_back({std::move(*name), block});
    }

    void readColors(const toml::table& table) {
        for (const auto& [key, value] : table) {
            const auto color = colorOf(key.str());
            if (!color) return wrong(value, key.str(), "expected a color as \"#rrggbb\"");
            const world::BlockType* type = typeOf(value, key.str(), value.value_or(std::string_view()));
            if (type) mapping_.colors_[*color] = type->id;
        }
    }

    BlockMapping& mapping_;
    const MappingFile& file_;
    std::optional<base::Error> problem_;
};

base::Result<BlockMapping> BlockMapping::create(const world::BlockRegistry& blocks,
                                                std::span<const MappingFile> files) {
    BlockMapping mapping(blocks);
    for (const MappingFile& file : files) TERRANE_TRY(Reader(mapping, file).read());
    return mapping;
}

base::Result<BlockMapping> loadMapping(const world::BlockRegistry& blocks, const std::string& file) {
    const auto builtIn = TERRANE_TRY(builtInFile("minecraft.toml"));
    std::vector<MappingFile> files{{builtIn, "minecraft.toml"}};
    base::Result<std::string> text;
    if (!file.empty()) {
        text = base::readFile(file, kMaxMappingBytes);
        if (!text) return tl::unexpected(text.error());
        files.push_back({*text, file});
    }
    return BlockMapping::create(blocks, files);
}

base::Result<LegacyIds> builtInLegacyIds() {
    const auto text = TERRANE_TRY(builtInFile("minecraft_ids.toml"));
    return LegacyIds::parse(text, "minecraft_ids.toml");
}

}  // namespace terrane::formats

#include "terrane/formats/block_mapping.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "terrane/formats/state_rules.h"
#include "terrane/world/block_behavior.h"

namespace terrane::formats {
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

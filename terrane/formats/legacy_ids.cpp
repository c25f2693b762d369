#include "terrane/formats/legacy_ids.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include <charconv>

namespace terrane::formats {
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
    toml::table table;
    try {
        table = toml::parse(toml, name);
    } catch (const toml::parse_error& error) {
        return base::fail(base::ErrorCode::BadInput, "{}:{}: {}", name, error.source().begin.line,
                          error.description());
    }
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

}  // namespace terrane::formats

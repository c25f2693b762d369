#include "apps/terrane/record/script_values.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "apps/terrane/toml_flags.h"

namespace terrane::app {
namespace {

constexpr double kMaxBlocks = 2147483647;  // from the origin

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
            if (value && std::abs(*value) <= kMaxBlocks) numbers.push_back(*value);
        }
        if (numbers.size() == count && array->size() == count) return numbers;
    }
    table.expected(*node, key, form);
    return std::vector<double>(count, 0.0);
}

std::optional<world::BlockPos> blockPosOf(world::ContentTable& table, std::string_view key) {
    constexpr std::string_view kForm = "[x, y, z] of a block in the world, whole numbers, z from 0 to 255";
    const auto n = numbersOf(table, key, 3, kForm);
    if (!n) return std::nullopt;
    const bool isWhole = std::ranges::all_of(*n, [](double v) { return v == std::floor(v); });
    if (!isWhole || (*n)[2] < 0 || (*n)[2] >= world::kChunkHeight)
        table.expected(*table.node(key), key, kForm);
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

}  // namespace terrane::app

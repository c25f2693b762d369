#include "terrane/world/blocks/content_table.h"

#include <sstream>

namespace terrane::world {
namespace {

bool isName(std::string_view text) {
    constexpr std::string_view kLetters = "abcdefghijklmnopqrstuvwxyz0123456789_";
    return !text.empty() && text.find_first_not_of(kLetters) == std::string_view::npos;
}

// A value of the file as errors show it.
std::string shown(const toml::node& node) {
    if (node.is_table()) return "a table";
    if (const toml::array* array = node.as_array()) return fmt::format("an array of {}", array->size());
    if (const auto text = node.value_exact<std::string_view>()) return fmt::format("\"{}\"", *text);
    if (const auto number = node.value_exact<double>()) {  // as short as it is written
        const std::string digits = fmt::format("{}", *number);
        return digits.find_first_not_of("-0123456789") == std::string::npos ? digits + ".0" : digits;
    }
    std::ostringstream other;
    node.visit([&](const auto& value) {
        if constexpr (toml::is_value<decltype(value)>) other << value;
    });
    return other.str();
}

}  // namespace

const toml::node* ContentTable::firstOf(std::initializer_list<std::string_view> keys) const {
    const auto find = [&](const toml::table& table) -> const toml::node* {
        for (const std::string_view key : keys)
            if (const toml::node* value = table.get(key)) return value;
        return nullptr;
    };
    const toml::node* found = find(table_);
    for (std::size_t k = 0; !found && k < like_.size(); ++k) found = find(*like_[k]);
    return found;
}

void ContentTable::wrong(int line, std::string_view key, std::string_view what) {
    if (!error_) error_ = fmt::format("{}:{}: {}: {}", file_, line, key, what);
}

void ContentTable::expected(const toml::node& node, std::string_view key, std::string_view what) {
    wrong(lineOf(node), key, fmt::format("expected {}, got {}", what, shown(node)));
}

void ContentTable::missing(std::string_view key, std::string_view note) {
    wrong(line(), key, fmt::format("missing ({})", note));
}

bool ContentTable::boolean(std::string_view key, bool fallback) {
    const toml::node* found = node(key);
    return found ? booleanOf(*found, key) : fallback;
}

bool ContentTable::booleanOf(const toml::node& value, std::string_view key) {
    if (!value.is_boolean()) expected(value, key, "true or false");
    return value.value_or(false);
}

int ContentTable::numberOf(const toml::node& value, std::string_view key, int min, int max) {
    const auto number = value.value_exact<std::int64_t>();
    if (number && *number >= min && *number <= max) return static_cast<int>(*number);
    expected(value, key, fmt::format("{} to {}", min, max));
    return min;
}

double ContentTable::realOf(const toml::node& value, std::string_view key, double min, double max) {
    const auto number = value.is_number() ? value.value<double>() : std::nullopt;
    if (number && *number >= min && *number <= max) return *number;
    expected(value, key, fmt::format("{} to {}", min, max));
    return min;
}

std::string ContentTable::nameOf(const toml::node& value, std::string_view key) {
    const auto text = value.value_exact<std::string>();
    if (text && isName(*text)) return *text;
    expected(value, key, "a name of a-z, 0-9 and _");
    return {};
}

}  // namespace terrane::world

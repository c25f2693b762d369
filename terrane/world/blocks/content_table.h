// One table of a content file (TOML), read key by key, with errors that name line and key. The readers of
// content files use it. One thread uses it.
#pragma once

#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "terrane/base/toml.h"

namespace terrane::world {

// The name of an enum value in the file.
template <class T>
struct EnumName {
    std::string_view name;
    T value;
};

template <class Names>
std::string listed(const Names& names) {
    std::string text;
    for (const auto& entry : names) {
        if (!text.empty()) text += ", ";
        text += entry.name;
    }
    return text;
}

// Readers return the key's value, or `fallback` if it is absent; a wrong value gives an error and an
// arbitrary result. All tables of a file share one error, the first.
class ContentTable {
  public:
    // `like` has tables whose keys this table inherits if it does not set them, the nearest first.
    ContentTable(const toml::table& table, std::string_view file, std::optional<std::string>& error,
                 std::span<const toml::table* const> like = {})
        : table_(table), like_(like), file_(file), error_(error) {}

    const toml::node* own(std::string_view key) const { return table_.get(key); }
    const toml::node* node(std::string_view key) const { return firstOf({key}); }
    // Returns the first of these keys, which exclude each other, in the nearest table that has one.
    const toml::node* firstOf(std::initializer_list<std::string_view> keys) const;
    int line() const { return lineOf(table_); }
    // Returns a table inside this one, whose errors join those of this one.
    ContentTable inner(const toml::table& table) const { return ContentTable(table, file_, error_); }

    void wrong(int line, std::string_view key, std::string_view what);
    void expected(const toml::node& node, std::string_view key, std::string_view what);
    void missing(std::string_view key, std::string_view note = "required");

    // Every key must be one of `known`; `prefix` is the path of the table in errors.
    template <class Known>
    void rejectUnknown(const Known& known, std::string_view prefix = "") {
        const toml::key* first = nullptr;
        for (const auto& [key, value] : table_) {
            if (std::find(known.begin(), known.end(), key.str()) != known.end()) continue;
            if (!first || key.source().begin.line < first->source().begin.line) first = &key;
        }
        if (!first) return;
        wrong(static_cast<int>(first->source().begin.line), fmt::format("{}{}", prefix, first->str()),
              fmt::format("unknown key, expected one of {}", fmt::join(known, ", ")));
    }

    bool boolean(std::string_view key, bool fallback);
    bool booleanOf(const toml::node& value, std::string_view key);
    // These return a number from `min` to `max`.
    int numberOf(const toml::node& value, std::string_view key, int min, int max);
    double realOf(const toml::node& value, std::string_view key, double min, double max);
    std::string nameOf(const toml::node& value, std::string_view key);

    template <class T, std::size_t N>
    T enumOf(const toml::node& value, std::string_view key, const std::array<EnumName<T>, N>& names) {
        const auto text = value.value_exact<std::string>();
        for (const EnumName<T>& entry : names)
            if (text && *text == entry.name) return entry.value;
        expected(value, key, fmt::format("one of {}", listed(names)));
        return names[0].value;
    }

    // Returns one value for each of `names`, from a single value for all or from a table; absent names get
    // `fallback`.
    template <class T, std::size_t N, class Read>
    std::array<T, N> valueEach(std::string_view key, const std::array<std::string_view, N>& names,
                               const T& fallback, Read read) {
        std::array<T, N> result;
        result.fill(fallback);
        const toml::node* found = node(key);
        if (!found) return result;
        const toml::table* inner = found->as_table();
        if (!inner) {
            result.fill(read(*found, key));
            return result;
        }
        this->inner(*inner).rejectUnknown(names, fmt::format("{}.", key));
        for (std::size_t n = 0; n < N; ++n)
            if (const toml::node* value = inner->get(names[n]))
                result[n] = read(*value, fmt::format("{}.{}", key, names[n]));
        return result;
    }

  private:
    static int lineOf(const toml::node& node) { return static_cast<int>(node.source().begin.line); }

    const toml::table& table_;
    std::span<const toml::table* const> like_;
    std::string_view file_;
    std::optional<std::string>& error_;
};

}  // namespace terrane::world

#include "apps/terrane/toml_flags.h"

#include <CLI/CLI.hpp>
#include <sstream>
#include <vector>

#include "apps/terrane/former_names.h"

namespace terrane::app {
namespace {

// The value as written on the command line.
std::string textOf(const toml::node& value) {
    if (const auto text = value.value_exact<std::string>()) return *text;
    std::ostringstream out;
    value.visit([&](const auto& v) {
        if constexpr (toml::is_value<decltype(v)>) out << v;
    });
    return out.str();
}

}  // namespace

base::Result<void> setFromToml(CLI::Option& flag, const toml::node& value) {
    try {
        if (const toml::array* list = value.as_array())
            for (const toml::node& element : *list) flag.add_result(textOf(element));
        else
            flag.add_result(textOf(value));
        flag.run_callback();
    } catch (const CLI::ParseError& error) {
        std::string what = error.what();
        const std::string prefix = flag.get_name() + ": ";
        if (what.starts_with(prefix)) what.erase(0, prefix.size());
        return base::fail("{}", what);
    }
    return {};
}

void useCurrentNames(toml::table& table) {
    std::vector<toml::key> former;
    for (auto&& [key, value] : table) {
        if (currentFlag(key.str()) != key.str()) former.push_back(key);
        if (toml::table* inner = value.as_table()) useCurrentNames(*inner);
        if (toml::array* array = value.as_array()) {
            for (toml::node& element : *array)
                if (toml::table* inner = element.as_table()) useCurrentNames(*inner);
        }
    }
    for (const toml::key& key : former) {
        // Keeps the source position, so that errors name the line.
        table.insert(toml::key(currentFlag(key.str()), toml::source_region(key.source())),
                     std::move(*table.get(key.str())));
        table.erase(key.str());
    }
}

}  // namespace terrane::app

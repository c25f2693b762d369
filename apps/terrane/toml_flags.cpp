#include "apps/terrane/toml_flags.h"

#include <CLI/CLI.hpp>
#include <sstream>

namespace terrane::app {
namespace {

// As it would be written on the command line.
std::string wordOf(const toml::node& value) {
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
        flag.add_result(wordOf(value));
        flag.run_callback();
    } catch (const CLI::ParseError& error) {
        std::string what = error.what();
        const std::string prefix = flag.get_name() + ": ";
        if (what.starts_with(prefix)) what.erase(0, prefix.size());
        return base::fail("{}", what);
    }
    return {};
}

}  // namespace terrane::app

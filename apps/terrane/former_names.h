// Commands, flags and values that were renamed in 0.2. The old names are accepted for one version: on the
// command line, in settings.toml and in path files. The help does not list them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace terrane::app {

// The current name of a flag without dashes, or of a value of an option. Other names are returned unchanged.
std::string_view currentFlag(std::string_view name);
std::string_view currentValue(std::string_view value);

// The command line with current names: arguments[1] is the command, flags are --name or --name=value.
std::vector<std::string> withCurrentNames(std::span<const char* const> arguments);

}  // namespace terrane::app

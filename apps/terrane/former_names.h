// Commands, flags and values that have another name since 0.2. The old names are understood for one version:
// on the command line, in settings.toml and in path files. No help lists them.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace terrane::app {

// A flag without dashes, or one value of an option. Names that never changed come back as they are.
std::string_view currentFlag(std::string_view name);
std::string_view currentValue(std::string_view value);

// The command line in today's names: the command is arguments[1], flags are --name or --name=value.
std::vector<std::string> withCurrentNames(std::span<const char* const> arguments);

}  // namespace terrane::app

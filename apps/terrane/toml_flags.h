// Sets command line flags from values of a TOML file.
#pragma once

#include <toml++/toml.h>

#include "terrane/base/result.h"

namespace CLI {
class Option;
}

namespace terrane::app {

// Sets the flag as if the value followed it on the command line. Errors do not name the line.
base::Result<void> setFromToml(CLI::Option& flag, const toml::node& value);

// Renames keys of the table and of nested tables from former to current flag names. If both exist, the former
// one is dropped.
void useCurrentNames(toml::table& table);

}  // namespace terrane::app

// Flags of the command line that get their values from a TOML file.
#pragma once

#include <toml++/toml.h>

#include "terrane/base/result.h"

namespace CLI {
class Option;
}

namespace terrane::app {

// As if the value stood behind the flag. The error says what is wrong with the value, not where it stands.
base::Result<void> setFromToml(CLI::Option& flag, const toml::node& value);

// Keys of the table, and of tables in it, that are former names of flags become today's. Where both stand the
// former one goes.
void useCurrentNames(toml::table& table);

}  // namespace terrane::app

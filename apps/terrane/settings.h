// Settings that the user changed in the window, kept in a TOML file. Each is an option of `terrane play` with
// the same name: the file sets options that the command line does not.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/base/toml.h"

// Sets command line flags from values of a TOML file.
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

namespace CLI {
class App;
}

namespace terrane::app {

// $XDG_CONFIG_HOME/terrane/settings.toml, else $HOME/.config/terrane/settings.toml; empty if neither variable
// holds an absolute path.
std::filesystem::path settingsPath();

using SettingValues = std::map<std::string, std::string>;  // option without dashes, value

// Sets the options of `command` that the command line does not set. A preset on the command line overrides
// the file's graphics options, named in `graphics`. Does nothing without a file. Errors name the file and the
// line. Options that are not configurable are errors: they have their effect before the file is read.
base::Result<void> applySettings(const std::filesystem::path& file, CLI::App& command,
                                 const std::vector<std::string>& graphics);

// Writes only the differences between `before` and `after`, so that options of the command line do not become
// settings; the rest of the file stays, comments and order too. A changed preset replaces all `graphics`
// options. Creates the file and its folder; a symbolic link stays one.
base::Result<void> writeChanges(const std::filesystem::path& file, const SettingValues& before,
                                const SettingValues& after, const std::vector<std::string>& graphics);

}  // namespace terrane::app

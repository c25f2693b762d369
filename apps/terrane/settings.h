// What a user chose in the window, kept between sessions in a TOML file. Each setting is an option of
// `terrane play` of the same name: the file gives options that the command line leaves out.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "terrane/base/result.h"

namespace CLI {
class App;
}

namespace terrane::app {

// $XDG_CONFIG_HOME/terrane/settings.toml, where that variable is no absolute path
// $HOME/.config/terrane/settings.toml; empty where there is neither.
std::filesystem::path settingsPath();

using SettingValues = std::map<std::string, std::string>;  // option without dashes, value

// Sets those of `command`'s options that the command line did not. A preset on the command line stands alone:
// `graphics`, the names of single graphics options, are then left out. Nothing where there is no file. Errors
// name the file, the line and what is wrong.
base::Result<void> applySettings(const std::filesystem::path& file, CLI::App& command,
                                 const std::vector<std::string>& graphics);

// Writes what differs between `before` and `after`, as a user changed it; all else in the file stays,
// comments and order too, so that options of one command line do not become settings. Another preset replaces
// all of the `graphics` options. Makes the file and its folder; a link stays one.
base::Result<void> writeChanges(const std::filesystem::path& file, const SettingValues& before,
                                const SettingValues& after, const std::vector<std::string>& graphics);

}  // namespace terrane::app

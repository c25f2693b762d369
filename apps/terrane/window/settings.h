// What a person chose in the window, kept between sessions in a TOML file. Each setting is an option of
// `terrane play` of the same name: the file gives options that the command line leaves out.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "terrane/base/result.h"

namespace terrane::app {

// $XDG_CONFIG_HOME/terrane/settings.toml, where that variable is no absolute path
// $HOME/.config/terrane/settings.toml; empty where there is neither.
std::filesystem::path settingsPath();

using SettingValues = std::vector<std::pair<std::string, std::string>>;  // option without dashes, value

// Sets those of `command`'s options that the command line did not. A preset on the command line stands alone:
// `graphics`, the names of single graphics options, are then left out. Nothing where there is no file. Errors
// name the file, the line and what is wrong.
base::Result<void> applySettings(const std::filesystem::path& file, CLI::App& command,
                                 const std::vector<std::string>& graphics);

// Replaces the file; makes its folder.
base::Result<void> writeSettings(const std::filesystem::path& file, const SettingValues& values);

}  // namespace terrane::app

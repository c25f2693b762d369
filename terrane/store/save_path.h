// Where the save of a name lies. Called by programs while they start; reads the environment, which no thread
// may change meanwhile.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "terrane/base/result.h"

namespace terrane::store {

// What the place depends on. Texts are empty where the environment does not have them.
struct SavePlaces {
    std::string xdgDataHome;                // $XDG_DATA_HOME
    std::string home;                       // $HOME
    std::filesystem::path former = "save";  // folder of saves up to version 0.1, below the working directory
};

// Of this process.
SavePlaces savePlaces();

// Where Terrane keeps what players make: $XDG_DATA_HOME/terrane, or $HOME/.local/share/terrane where that
// variable is no absolute path. Absolute; may not exist. An error where neither variable is set.
[[nodiscard]] base::Result<std::filesystem::path> dataFolder(const SavePlaces& places);

// An error for a name that cannot be a file's: empty, longer than 100 bytes, with a slash or a control
// character, or with a dot or a space in front.
[[nodiscard]] base::Result<void> checkSaveName(std::string_view name);

// NAME.sqlite in the data folder. A save that only the former folder has is found there: the path is then
// relative. Errors of checkSaveName(). Makes no folders.
[[nodiscard]] base::Result<std::filesystem::path> savePath(std::string_view name, const SavePlaces& places);

}  // namespace terrane::store

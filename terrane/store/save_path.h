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
    std::filesystem::path program;  // the executable
    std::string xdgDataHome;        // $XDG_DATA_HOME
    std::string home;               // $HOME
};

// Of this program.
SavePlaces savePlaces();

// A program that lies in a build folder (with a CMakeCache.txt) is being developed: save/NAME.sqlite below
// the working directory. Else it is installed: $XDG_DATA_HOME/terrane/NAME.sqlite, where that variable is no
// absolute path $HOME/.local/share/terrane/NAME.sqlite. An error for what cannot be the name of a file:
// empty, longer than 100 bytes, with a slash or a control character, or with a dot or a space in front. Makes
// no folders.
[[nodiscard]] base::Result<std::filesystem::path> savePath(std::string_view name, const SavePlaces& places);

}  // namespace terrane::store

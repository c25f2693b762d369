// Paths of saves by name. Called by programs while they start; reads the environment, which no thread may
// change meanwhile.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "terrane/base/result.h"

namespace terrane::store {

// The inputs of the paths. Strings are empty if the environment lacks them.
struct SavePlaces {
    std::string xdgDataHome;                // $XDG_DATA_HOME
    std::string home;                       // $HOME
    std::filesystem::path former = "save";  // folder of saves up to version 0.1, below the working directory
};

// The values of this process.
SavePlaces savePlaces();

// The folder of players' worlds and other files: $XDG_DATA_HOME/terrane, or $HOME/.local/share/terrane if
// that variable is not an absolute path. Absolute; may not exist. Fails if neither variable is set.
[[nodiscard]] base::Result<std::filesystem::path> dataFolder(const SavePlaces& places);

constexpr std::size_t kMaxSaveName = 100;  // bytes; file systems allow 255, including extensions
// Fails for a name that cannot be a file name: empty, longer than 100 bytes, with a slash or a control
// character, or with a leading dot or space.
[[nodiscard]] base::Result<void> checkSaveName(std::string_view name);

// NAME.sqlite in the data folder, or in the former folder if it exists only there; then the path is relative.
// Errors of checkSaveName(). Creates no folders.
[[nodiscard]] base::Result<std::filesystem::path> savePath(std::string_view name, const SavePlaces& places);

}  // namespace terrane::store

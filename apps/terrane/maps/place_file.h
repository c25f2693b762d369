// Reads a file of places for maps: bookmarks with or without names.
#pragma once

#include <filesystem>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/game/places.h"

namespace terrane::app {

// Lines are "X Y Z YAW PITCH NAME"; unnamed places are numbered. An empty path gives no places. Errors name
// the line.
[[nodiscard]] base::Result<std::vector<game::Place>> readPlaceFile(const std::filesystem::path& file);

}  // namespace terrane::app

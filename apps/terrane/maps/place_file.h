// A file of places, for maps: bookmarks, with or without names.
#pragma once

#include <filesystem>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/game/places.h"

namespace terrane::app {

// Lines "X Y Z YAW PITCH NAME"; a line without a name gets its number among those. An empty path has no
// places. Errors name the line.
[[nodiscard]] base::Result<std::vector<game::Place>> readPlaceFile(const std::filesystem::path& file);

}  // namespace terrane::app

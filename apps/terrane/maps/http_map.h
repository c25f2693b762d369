// `terrane map --http`: serves the map of a world to browsers, without a game server.
#pragma once

#include <filesystem>

#include "apps/terrane/maps/map_options.h"
#include "apps/terrane/options.h"
#include "terrane/base/result.h"

namespace terrane::app {

// Runs until a signal stops it.
[[nodiscard]] base::Result<void> showMap(io::WorldOptions& world, const io::SaveOptions& save,
                                         const std::string& resourcePack, const MapSiteOptions& options);

}  // namespace terrane::app

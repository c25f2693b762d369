// `terrane map --http`: the map of a world that nobody plays, for browsers.
#pragma once

#include <filesystem>

#include "apps/terrane/maps/map_options.h"
#include "apps/terrane/option_values.h"
#include "terrane/base/result.h"

namespace terrane::app {

// Until a signal ends it.
[[nodiscard]] base::Result<void> showMap(WorldOptions& world, const SaveOptions& save,
                                         const std::string& resourcePack, const MapSiteOptions& options);

}  // namespace terrane::app

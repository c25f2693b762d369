// `terrane map --tiles`: a map as a folder of files, for any web server, or to be opened from the disk.
#pragma once

#include <string>
#include <vector>

#include "apps/terrane/option_values.h"
#include "terrane/base/result.h"
#include "terrane/map/map_tile.h"

namespace terrane::app {

struct StaticMapOptions {
    std::string folder;
    int maxZoom = 0;
    std::vector<std::string> layers;  // empty: all that the world has
    std::string places;               // file; empty: none
};

// `area`: chunks of level 0. Images that a former call wrote stay, but for those of edited land, so that a
// call that was stopped goes on. Refuses a folder that has other files, or the map of another world.
[[nodiscard]] base::Result<void> writeStaticMap(WorldOptions& world, const SaveOptions& save,
                                                const std::string& resourcePack, const world::ChunkArea& area,
                                                const StaticMapOptions& options);

}  // namespace terrane::app

// `terrane map --tiles`: writes a map as a folder of files, for a web server or to be opened from disk.
#pragma once

#include <string>
#include <vector>

#include "apps/terrane/options.h"
#include "terrane/base/result.h"
#include "terrane/map/map_tile.h"

namespace terrane::app {

struct StaticMapOptions {
    std::string folder;
    int maxZoom = 0;
    std::vector<std::string> layers;  // empty: all layers of the world
    std::string places;               // file; empty: none
};

// `area`: chunks of level 0. Keeps the images of an earlier call, except those of edited terrain, so a
// stopped run can continue. Refuses a folder with other files or with the map of another world.
[[nodiscard]] base::Result<void> writeStaticMap(io::WorldOptions& world, const io::SaveOptions& save,
                                                const std::string& resourcePack, const world::ChunkArea& area,
                                                const StaticMapOptions& options);

}  // namespace terrane::app

// Writes a map as a folder of files, for a web server or to be opened from disk. One thread, which uses
// others.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/io/map_world.h"
#include "terrane/map/map_tile.h"
#include "terrane/web/map_parts.h"
#include "terrane/world/coords.h"

namespace terrane::web {

struct StaticMapSettings {
    std::filesystem::path folder;
    std::string title = "Terrane";    // display name of the world
    world::ChunkArea area;            // of level 0
    world::Heights heights = {};      // of the world
    std::vector<map::Layer> layers;   // from layersOf()
    int maxZoom = 0;                  // of the finest images
    std::vector<game::Place> places;  // in addition to those saved in the world
};

struct StaticMapWritten {
    std::size_t written = 0, images = 0;  // by this call; of the map
    bool isDone = true;                   // false if `progress` stopped it
};

// Limit on the images of a map: a few days of work, 300 GB.
inline constexpr std::int64_t kMaxImages = 10'000'000;
std::int64_t imageCountOf(const StaticMapSettings& settings);

// The layers by name; without names, all that the world has. Fails unless one of them is a base layer.
[[nodiscard]] base::Result<std::vector<map::Layer>> layersOf(const std::vector<std::string>& names,
                                                             const map::MapPainter& painter);

// Keeps the images of an earlier call, except those of edited terrain, so a stopped run can continue. Refuses
// a folder with other files or with the map of another world. `painter`: of the world.
[[nodiscard]] base::Result<StaticMapWritten> writeStaticMap(io::MapWorld& world, map::MapPainter& painter,
                                                            const StaticMapSettings& settings,
                                                            const io::Progress& progress = {});

}  // namespace terrane::web

// Options of browser maps, for `serve` and `map`.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "terrane/base/result.h"

#include "apps/terrane/maps/static_map.h"

namespace CLI {
class App;
}

namespace terrane::app {

enum class ShownPlayers : std::uint8_t { None, Surface, All };

struct MapSiteOptions {
    std::string http;                // "PORT" or "ADDRESS:PORT"; empty: no map
    std::vector<std::string> hosts;  // names of the map besides localhost and its address
    int diskMegabytes = 300, memoryMegabytes = 64;
    unsigned threads = 1;
    std::string places;  // file; empty: none
    ShownPlayers players = ShownPlayers::Surface;
};

// --http and --map-…; servers also get the options for players and threads. A build without maps has none of
// them.
void addMapSiteOptions(CLI::App& command, MapSiteOptions& options, bool isServer);
// Checks the address and the file of places before anything is opened or created.
[[nodiscard]] base::Result<void> checkMapSite(const MapSiteOptions& options);
// --tiles, --max-zoom and --layers.
void addStaticMapOptions(CLI::App& command, StaticMapOptions& options);

}  // namespace terrane::app

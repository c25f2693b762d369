// Options of browser maps, for `serve` and `map`, and the maps that they describe. A build without browser
// maps has no such options (map_options_none.cpp).
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/io/world_options.h"
#include "terrane/net/server/server_state.h"
#include "terrane/web/server_map.h"
#include "terrane/world/blocks/block_model.h"
#include "terrane/world/coords.h"

namespace CLI {
class App;
}

namespace terrane::app {

struct MapSiteOptions {
    std::string http;                // "PORT" or "ADDRESS:PORT"; empty: no map
    std::vector<std::string> hosts;  // names of the map besides localhost and its address
    int diskMegabytes = 300, memoryMegabytes = 64;
    unsigned threads = 1;
    std::string places;  // file; empty: none
    web::ShownPlayers players = web::ShownPlayers::Surface;
};

// `terrane map --tiles`.
struct StaticMapOptions {
    std::string folder;
    int maxZoom = 0;
    std::vector<std::string> layers;  // empty: all layers of the world
    std::string places;               // file; empty: none
};

// --http and --map-…; servers also get the options for players and threads.
void addMapSiteOptions(CLI::App& command, MapSiteOptions& options, bool isServer);
// Checks the address and the file of places before anything is opened or created.
[[nodiscard]] base::Result<void> checkMapSite(const MapSiteOptions& options);
// --tiles, --max-zoom and --layers.
void addStaticMapOptions(CLI::App& command, StaticMapOptions& options);

// `terrane map --http`: runs until a signal stops it.
[[nodiscard]] base::Result<void> showMap(io::WorldOptions& world, const io::SaveOptions& save,
                                         const std::string& resourcePack, const MapSiteOptions& options);
// `terrane map --tiles`. `area`: chunks of level 0.
[[nodiscard]] base::Result<void> writeStaticMap(io::WorldOptions& world, const io::SaveOptions& save,
                                                const std::string& resourcePack, const world::ChunkArea& area,
                                                const StaticMapOptions& options);

// The map of a running server: call it after each tick with the tick's duration. Empty if the options name no
// port. `world`: as on the command line; `files`: from net_postgres::serverFilesOf(). The context and the
// server outlive it.
using MapTick = std::function<void(double milliseconds)>;
[[nodiscard]] base::Result<MapTick> openServerMap(boost::asio::io_context& context, net::ServerState& server,
                                                  const std::string& world, const MapSiteOptions& options,
                                                  const std::filesystem::path& files,
                                                  const world::TextureSource& textures);

}  // namespace terrane::app

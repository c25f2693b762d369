// The map of a world as a web site: page, tiles, live changes, Prometheus metrics. Combines the parts of this
// module; the owner of the world provides the contents. It is used on one thread, which runs the context;
// workers of its own paint the tiles.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/gen/level_generators.h"
#include "terrane/io/map_world.h"
#include "terrane/map/surface_cache.h"
#include "terrane/store/chunk_store.h"
#include "terrane/web/map_parts.h"
#include "terrane/web/metrics.h"
#include "terrane/web/page.h"
#include "terrane/web/web_server.h"
#include "terrane/world/blocks/block_model.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::web {

struct MapSiteParts {
    const gen::LevelGenerators& generators;
    const world::BlockRegistry& blocks;
    const world::TextureSource& textures;  // only read by open()
    store::ReadableStore& store;           // of the world; workers read edited chunks
    std::string name;                      // display name of the world
    MapMarker spawn;
    unsigned threads = 1;
    map::SurfaceCache* cache = nullptr;             // null: no disk cache
    std::size_t tileBytes = std::size_t{64} << 20;  // limit of tiles in memory
    std::vector<world::ChunkPos> edited = {};       // edited chunks of level 0 so far
    // Returns a loaded chunk of level 0 of a running game; null if it is not loaded. The function may be
    // empty.
    std::function<world::ChunkPtr(world::ChunkPos)> liveChunk = {};
    // These return the players and places to show; called each second while there are listeners. They may be
    // empty.
    std::function<std::vector<MapMarker>()> players = {}, places = {};
    // Adds metrics of the program. It may be empty.
    std::function<void(MetricsText&)> metrics = {};
};

class MapSite {
  public:
    // Starts to listen. The context and everything that the parts refer to outlive it.
    [[nodiscard]] static base::Result<std::unique_ptr<MapSite>> open(boost::asio::io_context& context,
                                                                     MapSiteParts parts,
                                                                     const WebAddress& address,
                                                                     const WebLimits& limits = {});
    ~MapSite();

    std::uint16_t port() const;
    // Reports edited chunks of level 0 and stored tiles that changed with them; browsers reload them.
    void onChanged(std::span<const world::ChunkPos> chunks);
    // Sends changes to browsers. Call it a few times per second.
    void tick();

  private:
    struct Impl;
    explicit MapSite(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

// Serves the map of a world to browsers, without a game server, on one thread.
struct WorldMapLoop {
    std::function<void(std::uint16_t port)> onOpened = {};  // may be empty
    std::function<bool()> stopRequested;                    // called a few times per second
};

// Uses the world's threads in place of those of `settings`. Runs until stopRequested().
[[nodiscard]] base::Result<void> serveWorldMap(io::MapWorld& world, const MapSettings& settings,
                                               const WorldMapLoop& loop);

}  // namespace terrane::web

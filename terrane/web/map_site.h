// The map of a world as a web site: the page, its tiles, what changes while people look, figures for
// Prometheus. Ties the parts of this module together; whoever has a world says what there is to show. On one
// thread, which runs the context; tiles are painted by workers of its own.
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
#include "terrane/map/surface_cache.h"
#include "terrane/store/chunk_store.h"
#include "terrane/web/metrics.h"
#include "terrane/web/page.h"
#include "terrane/web/web_server.h"
#include "terrane/world/block_registry.h"
#include "terrane/world/texture_source.h"

namespace terrane::web {

struct MapSiteParts {
    const gen::LevelGenerators& generators;
    const world::BlockRegistry& blocks;
    const world::TextureSource& textures;  // read by open() alone
    store::ReadableStore& store;           // its identity is the world's; edited chunks are read by workers
    std::string name;                      // of the world, for people
    NamedPlace spawn;
    unsigned threads = 1;
    map::SurfaceCache* cache = nullptr;             // null: nothing is kept on the disk
    std::size_t tileBytes = std::size_t{64} << 20;  // of tiles in memory
    std::vector<world::ChunkPos> edited = {};       // of level 0, so far
    // A chunk of level 0 as it is in a running game; null where it is not loaded. May be empty.
    std::function<world::ChunkPtr(world::ChunkPos)> liveChunk = {};
    // Who and what is shown, asked for each second while somebody looks. May be empty.
    std::function<std::vector<NamedPlace>()> players = {}, places = {};
    // Adds figures of the program. May be empty.
    std::function<void(MetricsText&)> metrics = {};
};

class MapSite {
  public:
    // Listens from here on. The context and what the parts refer to outlive it.
    [[nodiscard]] static base::Result<std::unique_ptr<MapSite>> open(boost::asio::io_context& context,
                                                                     MapSiteParts parts,
                                                                     const WebAddress& address,
                                                                     const WebLimits& limits = {});
    ~MapSite();

    std::uint16_t port() const;
    // Chunks of level 0 that were edited, and tiles of the store that follow from edits: browsers show them
    // anew.
    void onChanged(std::span<const world::ChunkPos> chunks);
    // Tells browsers what changed. Some times a second.
    void tick();

  private:
    struct Impl;
    explicit MapSite(std::unique_ptr<Impl> impl);
    std::unique_ptr<Impl> impl_;
};

}  // namespace terrane::web

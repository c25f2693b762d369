#include "terrane/web/world_map.h"

#include <boost/asio/io_context.hpp>
#include <chrono>
#include <utility>

#include "terrane/web/map_site.h"

namespace terrane::web {
namespace {

constexpr std::chrono::milliseconds kTick{50};

}  // namespace

base::Result<void> serveWorldMap(io::MapWorld& world, const MapSettings& settings, const WorldMapLoop& loop) {
    const game::SessionParts& opened = world.parts;
    const auto spawn = TERRANE_TRY(spawnOf(world));
    const auto cache = openMapCache(settings, originOf(opened.store->identity(), *opened.blocks));
    MapSiteParts parts{opened.generators, *opened.blocks, world.textures,
                       *opened.store,     settings.title, spawn};
    parts.threads = opened.threads;
    parts.cache = cache.get();
    parts.tileBytes = static_cast<std::size_t>(settings.memoryMegabytes) * 1'000'000;
    parts.edited = world.edited;
    parts.places = [all = allPlaces(*opened.store, settings.places)] { return all; };
    boost::asio::io_context context;
    auto site = TERRANE_TRY(MapSite::open(context, std::move(parts), settings.address));
    if (loop.onOpened) loop.onOpened(site->port());
    while (!loop.stopRequested()) {
        context.restart();
        context.run_for(kTick);
        site->tick();
    }
    return {};
}

}  // namespace terrane::web

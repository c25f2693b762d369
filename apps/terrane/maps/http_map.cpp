#include "apps/terrane/maps/http_map.h"

#include <boost/asio/io_context.hpp>
#include <chrono>

#include "apps/terrane/maps/site_parts.h"
#include "terrane/base/digest.h"
#include "terrane/base/log.h"
#include "terrane/base/machine.h"
#include "terrane/base/process.h"
#include "terrane/io/map_world.h"
#include "terrane/store/saves/save_path.h"
#include "terrane/web/map_site.h"

namespace terrane::app {
namespace {

constexpr std::chrono::milliseconds kTick{50};

// The cache beside the world's file; for other worlds a file in the data folder, named after `origin`. Empty
// if there is no data folder.
std::filesystem::path cacheFile(const io::SaveOptions& save, const std::string& origin) {
    std::error_code error;
    const store::WorldLocation location = store::worldLocation(save.world);
    if (!save.world.empty() && location.kind != store::WorldLocation::Kind::Url)
        if (auto file = store::fileOf(location)) return file->replace_extension(kMapCacheEnding);
    const auto folder = store::dataFolder(store::saveEnvironment());
    if (!folder) return {};
    std::filesystem::create_directories(*folder, error);
    return *folder / fmt::format("generated-{:016x}{}", base::hash64(origin), kMapCacheEnding);
}

}  // namespace

base::Result<void> showMap(io::WorldOptions& worldOptions, const io::SaveOptions& save,
                           const std::string& resourcePack, const MapSiteOptions& options) {
    auto address = TERRANE_TRY(webAddressFrom(options.http));
    address.hosts = options.hosts;
    const auto places = TERRANE_TRY(readPlaceFile(options.places));
    const auto world = TERRANE_TRY(io::openMapWorld(worldOptions, save, resourcePack));
    const auto spawn = TERRANE_TRY(spawnOf(*world));
    const game::SessionParts& opened = world->parts;
    const std::string origin = originOf(opened.store->identity(), *opened.blocks);
    const std::filesystem::path file = cacheFile(save, origin);
    const auto cache = openMapCache(file, origin, file.empty() ? 0 : options.diskMegabytes);
    web::MapSiteParts parts{opened.generators, *opened.blocks,      world->textures,
                            *opened.store,     titleOf(save.world), spawn};
    parts.threads = opened.threads;
    parts.cache = cache.get();
    parts.tileBytes = static_cast<std::size_t>(options.memoryMegabytes) * 1'000'000;
    parts.edited = world->edited;
    parts.places = [all = allPlaces(*opened.store, places)] { return all; };
    base::raiseOpenFileLimit();
    boost::asio::io_context context;
    auto site = TERRANE_TRY(web::MapSite::open(context, std::move(parts), address));
    base::logInfo("the map is at {}", urlOf(address, site->port()));
    const base::StopSignals signals;
    while (!signals.stopRequested()) {
        context.restart();
        context.run_for(kTick);
        site->tick();
    }
    return {};
}

}  // namespace terrane::app

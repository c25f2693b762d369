#include "apps/terrane/map_options.h"

#include <memory>
#include <optional>
#include <utility>

#include "apps/terrane/commands/progress.h"
#include "apps/terrane/options.h"
#include "apps/terrane/output_files.h"
#include "terrane/base/log.h"
#include "terrane/base/machine.h"
#include "terrane/base/process.h"
#include "terrane/io/map_world.h"
#include "terrane/web/host_check.h"
#include "terrane/web/map_site.h"
#include "terrane/web/static_map.h"

namespace terrane::app {
namespace {

constexpr double kMaxMegabytes = 1e6;

CLI::Validator notEmpty() {
    return CLI::Validator([](const std::string& value) { return value.empty() ? "is empty" : ""; }, "");
}

CLI::Validator hostName() {
    return CLI::Validator(
        [](const std::string& value) {
            return web::isHostName(value) ? std::string()
                                          : value + " is no host name, such as map.example.org";
        },
        "");
}

base::Result<web::WebAddress> addressOf(const MapSiteOptions& options) {
    auto address = web::webAddressFrom(options.http);
    if (!address) return base::fail(address.error().code, "--http: {}", address.error().message);
    address->hosts = options.hosts;
    return address;
}

// Without the cache's file, which depends on the kind of map.
base::Result<web::MapSettings> settingsOf(const MapSiteOptions& options, const std::string& world) {
    auto address = TERRANE_TRY(addressOf(options));
    auto places = TERRANE_TRY(web::readPlaceFile(options.places));
    return web::MapSettings{.address = std::move(address),
                            .title = web::titleOf(world),
                            .places = std::move(places),
                            .cache = {},
                            .diskMegabytes = options.diskMegabytes,
                            .memoryMegabytes = options.memoryMegabytes,
                            .threads = options.threads};
}

void addPlayerOption(CLI::App& command, MapSiteOptions& options) {
    addChoice<web::ShownPlayers>(
        command, "--map-players", options.players,
        {{"none", web::ShownPlayers::None},
         {"surface", web::ShownPlayers::Surface},
         {"all", web::ShownPlayers::All}},
        "Players that a map shows; \"surface\" leaves out those who are under ground");
}

}  // namespace

void addMapSiteOptions(CLI::App& command, MapSiteOptions& options, bool isServer) {
    command
        .add_option(
            "--http", options.http,
            "Show a map to browsers at this port of this machine; 0: a port that is free. With an address, "
            "such as 0.0.0.0:8080 or [::]:8080, to others")
        ->check(notEmpty())
        ->type_name("[ADDRESS:]PORT");
    command
        .add_option("--map-host", options.hosts,
                    "Name under which browsers reach the map, such as map.example.org; again for each name. "
                    "Without it they reach it as localhost and by its address")
        ->check(hostName())
        ->type_name("NAME");
    command
        .add_option("--map-disk", options.diskMegabytes, "Megabytes of the cache file for maps; 0: no file")
        ->check(numberFrom(0, kMaxMegabytes))
        ->capture_default_str();
    command.add_option("--map-memory", options.memoryMegabytes, "Megabytes of map images in memory")
        ->check(numberFrom(1, kMaxMegabytes))
        ->capture_default_str();
    command
        .add_option(
            "--map-places", options.places,
            "File of places on the map, one line \"X Y Z YAW PITCH NAME\" each, such as bookmarks.txt; "
            "places without a name get numbers")
        ->check(notEmpty())
        ->type_name("FILE");
    if (!isServer) return;
    command.add_option("--map-threads", options.threads, "Threads that draw the map")
        ->check(numberFrom(1, 256))
        ->capture_default_str();
    addPlayerOption(command, options);
}

base::Result<void> checkMapSite(const MapSiteOptions& options) {
    if (options.http.empty()) return {};
    (void)TERRANE_TRY(settingsOf(options, ""));
    return {};
}

void addStaticMapOptions(CLI::App& command, StaticMapOptions& options) {
    writesFolder(command.add_option(
                     "--tiles", options.folder,
                     "Write the map as a folder with a web page and its images; existing images stay unless "
                     "their land was edited"))
        ->check(notEmpty());
    command
        .add_option("--max-zoom", options.maxZoom,
                    "The finest images of --tiles: 2 has 4 pixels per block, -1 two blocks per pixel")
        ->check(numberFrom(map::kMinZoom, map::kMaxZoom))
        ->capture_default_str();
    command
        .add_option("--layers", options.layers,
                    "Layers of --tiles: day, night, height, biome, isometric; by default all")
        ->delimiter(',')
        ->check(notEmpty())
        ->type_name("LAYER,…");
}

base::Result<void> showMap(io::WorldOptions& worldOptions, const io::SaveOptions& save,
                           const std::string& resourcePack, const MapSiteOptions& options) {
    auto settings = TERRANE_TRY(settingsOf(options, save.world));
    const auto world = TERRANE_TRY(io::openMapWorld(worldOptions, save, resourcePack));
    settings.cache =
        web::mapCacheFile(save.world, web::originOf(world->parts.store->identity(), *world->parts.blocks));
    base::raiseOpenFileLimit();
    std::optional<base::StopSignals> signals;
    return web::serveWorldMap(*world, settings,
                              {[&](std::uint16_t port) {
                                   base::logInfo("the map is at {}", web::urlOf(settings.address, port));
                                   signals.emplace();
                               },
                               [&] { return signals->stopRequested(); }});
}

base::Result<void> writeStaticMap(io::WorldOptions& worldOptions, const io::SaveOptions& save,
                                  const std::string& resourcePack, const world::ChunkArea& area,
                                  const StaticMapOptions& options) {
    auto places = TERRANE_TRY(web::readPlaceFile(options.places));
    const auto world = TERRANE_TRY(io::openMapWorld(worldOptions, save, resourcePack));
    auto painter = TERRANE_TRY(io::painterOf(*world));
    auto layers = web::layersOf(options.layers, painter);
    if (!layers) return base::fail(layers.error().code, "--layers: {}", layers.error().message);
    const web::StaticMapSettings settings{.folder = options.folder,
                                          .title = web::titleOf(save.world),
                                          .area = area,
                                          .heights = worldOptions.heights.over({}),
                                          .layers = std::move(*layers),
                                          .maxZoom = options.maxZoom,
                                          .places = std::move(places)};
    if (web::imageCountOf(settings) > web::kMaxImages)
        return base::fail(base::ErrorCode::BadInput,
                          "a map has at most {} images; a lower --max-zoom needs fewer", web::kMaxImages);
    const auto map = TERRANE_TRY(web::writeStaticMap(*world, painter, settings, progressBar("mapping")));
    base::logInfo("{}: {} of {} images written{}", options.folder, map.written, map.images,
                  map.isDone ? "; open index.html" : " before it was stopped: the same command continues");
    return {};
}

base::Result<MapTick> openServerMap(boost::asio::io_context& context, net::ServerState& server,
                                    const std::string& world, const MapSiteOptions& options,
                                    const std::filesystem::path& files,
                                    const world::TextureSource& textures) {
    if (options.http.empty()) return MapTick();
    auto settings = TERRANE_TRY(settingsOf(options, world));
    settings.cache = files.string() + web::kMapCacheEnding;
    auto map = TERRANE_TRY(web::ServerMap::open(context, server, settings, options.players, textures));
    base::logInfo("the map is at {}", web::urlOf(settings.address, map->port()));
    return [shown = std::shared_ptr<web::ServerMap>(std::move(map))](double milliseconds) {
        shown->tick(milliseconds);
    };
}

}  // namespace terrane::app

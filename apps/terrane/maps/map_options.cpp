#include "apps/terrane/maps/map_options.h"

#include "apps/terrane/maps/site_parts.h"
#include "apps/terrane/options.h"
#include "terrane/io/map_world.h"

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

void addPlayerOption(CLI::App& command, MapSiteOptions& options) {
    addChoice<ShownPlayers>(
        command, "--map-players", options.players,
        {{"none", ShownPlayers::None}, {"surface", ShownPlayers::Surface}, {"all", ShownPlayers::All}},
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
    (void)TERRANE_TRY(webAddressFrom(options.http));
    (void)TERRANE_TRY(readPlaceFile(options.places));
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

}  // namespace terrane::app

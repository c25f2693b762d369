// What maps of a running server, of a saved world and of a folder of files have in common. Any thread.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "terrane/base/result.h"
#include "terrane/game/places.h"
#include "terrane/io/map_world.h"
#include "terrane/map/surface_cache.h"
#include "terrane/web/page.h"
#include "terrane/web/web_server.h"

namespace terrane::web {

struct MapSettings {
    WebAddress address;
    std::string title = "Terrane";    // display name of the world
    std::vector<game::Place> places;  // in addition to those saved in the world
    std::filesystem::path cache;      // file that keeps surfaces; empty: none
    int diskMegabytes = 300;          // of that file; 0: none
    int memoryMegabytes = 64;         // of images
    unsigned threads = 1;             // that draw
};

// "8080", "127.0.0.1:8080", "[::1]:8080".
[[nodiscard]] base::Result<WebAddress> webAddressFrom(const std::string& text);
// "http://127.0.0.1:8080/"; localhost if the server listens on all addresses.
std::string urlOf(const WebAddress& address, std::uint16_t port);

// The ending of the file that caches surfaces.
inline constexpr const char* kMapCacheEnding = ".map.sqlite";

// Identifies everything that surfaces of generated terrain depend on.
std::string originOf(const store::WorldIdentity& identity, const world::BlockRegistry& blocks);
// The file that caches surfaces of `world`, a store::WorldLocation: beside its file; for a database or
// without a world in the data folder, named after `origin`. Empty if there is no data folder.
std::filesystem::path mapCacheFile(const std::string& world, const std::string& origin);
// Null without a file or megabytes; also, with a warning, if the file cannot be used.
std::unique_ptr<map::SurfaceCache> openMapCache(const MapSettings& settings, const std::string& origin);

// The name of a world's file or database; "Terrane" without a world.
std::string titleOf(const std::string& world);

// Reads a file of places for maps: bookmarks with or without names.
// Lines are "X Y Z YAW PITCH NAME"; unnamed places are numbered. An empty path gives no places. Errors name
// the line.
[[nodiscard]] base::Result<std::vector<game::Place>> readPlaceFile(const std::filesystem::path& file);

MapMarker namedPlace(const std::string& name, const world::Pose& pose);
std::vector<MapMarker> namedPlaces(const std::vector<game::Place>& places);
// The places saved in the world, then those of a file.
std::vector<MapMarker> allPlaces(store::ReadableStore& store, const std::vector<game::Place>& ofFile);
// The spawn point, with an empty name. Takes a tenth of a second.
[[nodiscard]] base::Result<MapMarker> spawnOf(const io::MapWorld& world);

}  // namespace terrane::web

// Functions shared by the map of a server and of `terrane map`.
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

namespace terrane::app {

// "8080", "127.0.0.1:8080", "[::1]:8080".
[[nodiscard]] base::Result<web::WebAddress> webAddressFrom(const std::string& text);
// "http://127.0.0.1:8080/"; localhost if the server listens on all addresses.
std::string urlOf(const web::WebAddress& address, std::uint16_t port);

// The ending of the file that caches surfaces.
inline constexpr const char* kMapCacheEnding = ".map.sqlite";

// Identifies everything that surfaces of generated terrain depend on.
std::string originOf(const store::WorldIdentity& identity, const world::BlockRegistry& blocks);
// Null if `megabytes` is 0; also, with a warning, if the file cannot be used.
std::unique_ptr<map::SurfaceCache> openMapCache(const std::filesystem::path& file, const std::string& origin,
                                                int megabytes);

// The name of a world's file or database; "Terrane" without a world.
std::string titleOf(const std::string& world);

// Reads a file of places for maps: bookmarks with or without names.
// Lines are "X Y Z YAW PITCH NAME"; unnamed places are numbered. An empty path gives no places. Errors name
// the line.
[[nodiscard]] base::Result<std::vector<game::Place>> readPlaceFile(const std::filesystem::path& file);

web::NamedPlace namedPlace(const std::string& name, const world::Pose& pose);
std::vector<web::NamedPlace> namedPlaces(const std::vector<game::Place>& places);
// The places saved in the world, then those of a file.
std::vector<web::NamedPlace> allPlaces(store::ReadableStore& store, const std::vector<game::Place>& ofFile);
// The spawn point, with an empty name. Takes a tenth of a second.
[[nodiscard]] base::Result<web::NamedPlace> spawnOf(const io::MapWorld& world);

}  // namespace terrane::app

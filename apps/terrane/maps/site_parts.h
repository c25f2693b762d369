// What maps for browsers have in common, whether a server or `terrane map` shows them.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "apps/terrane/maps/map_world.h"
#include "terrane/base/result.h"
#include "terrane/game/places.h"
#include "terrane/map/surface_cache.h"
#include "terrane/web/page.h"
#include "terrane/web/web_server.h"

namespace terrane::app {

// "8080", "127.0.0.1:8080", "[::1]:8080".
[[nodiscard]] base::Result<web::WebAddress> webAddressFrom(const std::string& text);
// "http://127.0.0.1:8080/"; of all addresses this machine's own.
std::string urlOf(const web::WebAddress& address, std::uint16_t port);

// What a file of surfaces adds to the name of a world's other files.
inline constexpr const char* kMapCacheEnding = ".map.sqlite";

// All that surfaces of generated land follow from.
std::string originOf(const store::WorldIdentity& identity, const world::BlockRegistry& blocks);
// Null where `megabytes` is 0, and, with a warning, where the file cannot be used.
std::unique_ptr<map::SurfaceCache> openMapCache(const std::filesystem::path& file, const std::string& origin,
                                                int megabytes);

// What people call a world: the name of its file, or of its database; of no world "Terrane".
std::string titleOf(const std::string& world);

web::NamedPlace namedPlace(const std::string& name, const world::Pose& pose);
std::vector<web::NamedPlace> namedPlaces(const std::vector<game::Place>& places);
// Those of the world, then those of a file (place_file.h).
std::vector<web::NamedPlace> allPlaces(store::ReadableStore& store, const std::vector<game::Place>& ofFile);
// Where the world begins. Takes a tenth of a second.
[[nodiscard]] base::Result<web::NamedPlace> spawnOf(const MapWorld& world);

}  // namespace terrane::app

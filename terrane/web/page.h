// The map's page, and the information about a world that it shows. Any thread may use it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "terrane/base/files.h"
#include "terrane/map/map_tile.h"
#include "terrane/store/saves/world_identity.h"

namespace terrane::web {

// A named player or place on the map, with its position in blocks.
struct MapMarker {
    std::string name;
    double x = 0, y = 0, z = 0;

    bool operator==(const MapMarker&) const = default;
};

struct PageInfo {
    store::WorldIdentity identity;
    std::string name;  // display name of the world
    MapMarker spawn;
    std::vector<MapMarker> places = {};
    std::vector<std::string> layers = {};
    int minZoom = 0, maxZoom = 0;
    std::uint64_t edits = 0;                  // number of the last event of edits
    bool isLive = true;                       // served by a program, not static files
    std::optional<map::BlockRect> area = {};  // area with tiles; no value: the whole world
};
// These format values as JSON.
std::string textOf(const PageInfo& info);
std::string textOf(const std::vector<MapMarker>& places);
// Returns the information as a script for the page: world.js.
std::string scriptOf(const PageInfo& info);

// Returns the files of the page, except world.js.
std::span<const base::EmbeddedFile> pageFiles();
std::string_view typeOf(std::string_view fileName);  // for Content-Type

}  // namespace terrane::web

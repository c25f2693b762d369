// Maps request targets to routes. Plain values; any thread.
#pragma once

#include <cstdint>
#include <string>
#include <variant>

#include "terrane/map/map_tile.h"
#include "terrane/web/target.h"

namespace terrane::web {

struct PageFile {
    std::string name;  // "index.html"
};
struct TileImage {
    map::MapTile tile;
};
struct BlockAt {
    std::int32_t x = 0, y = 0;
};
struct WorldScript {};  // the world's facts for the page, as JavaScript
struct WorldFacts {};   // the same as JSON
struct PlayerList {};
struct EventStream {};
struct Metrics {};
struct Health {};
struct NotFound {};
struct BadRequest {
    std::string why;
};

using Route = std::variant<NotFound, BadRequest, PageFile, TileImage, BlockAt, WorldScript, WorldFacts,
                           PlayerList, EventStream, Metrics, Health>;

// /                              index.html           /api/world             the world
// /NAME                          a file of the page   /api/block?x=&y=       a column
// /tiles/LAYER/ZOOM/X/Y.png      a tile               /api/players           who plays
// /world.js                      the world            /api/edits             server-sent events
// /metrics                       for Prometheus       /healthz               that the program answers
Route routeOf(const Target& target);

}  // namespace terrane::web

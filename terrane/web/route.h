// Maps request targets to routes. All are plain values; any thread may use them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "terrane/map/map_tile.h"

namespace terrane::web {

// Longer targets, and targets with more parts, are rejected.
constexpr std::size_t kMaxTargetBytes = 1024, kMaxSegments = 8, kMaxParameters = 8;

struct Parameter {
    std::string name, value;
};

// "/a/b?x=1": segments a, b; one parameter. "/" has no segments.
struct Target {
    std::vector<std::string> segments;
    std::vector<Parameter> query;

    // Returns the value of the first parameter of this name, if there is one.
    std::optional<std::string_view> parameter(std::string_view name) const;
};

// Decodes percent escapes (RFC 3986); "+" is a plus. No value if the target is not an absolute path, or has
// invalid escapes, or has control characters or bytes above 0x7e outside of escapes. Also no value for
// segments that are empty, "." or "..", or contain a slash, backslash or zero byte after decoding.
std::optional<Target> parseTarget(std::string_view target);

struct PageFile {
    std::string name;  // "index.html"
};
struct TileImage {
    map::MapTile tile;
};
struct BlockAt {
    std::int32_t x = 0, y = 0;
};
struct WorldScript {};  // the information about the world for the page, as JavaScript
struct WorldInfo {};    // the same as JSON
struct PlayerList {};
struct EventStream {};
struct Metrics {};
struct Health {};
struct NotFound {};
struct BadRequest {
    std::string why;
};

using Route = std::variant<NotFound, BadRequest, PageFile, TileImage, BlockAt, WorldScript, WorldInfo,
                           PlayerList, EventStream, Metrics, Health>;

// /                              index.html           /api/world             the world
// /NAME                          a file of the page   /api/block?x=&y=       a column
// /tiles/LAYER/ZOOM/X/Y.png      a tile               /api/players           who plays
// /world.js                      the world            /api/edits             server-sent events
// /metrics                       for Prometheus       /healthz               that the program answers
Route routeOf(const Target& target);

}  // namespace terrane::web

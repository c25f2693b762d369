#include "terrane/web/page.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <utility>

#include "terrane/gen/generators/catalogue.h"
#include "terrane/map/isometric.h"

namespace terrane::embedded {
std::span<const base::EmbeddedFile> page();
}

namespace terrane::web {
namespace {

using Json = nlohmann::ordered_json;

Json jsonOf(const MapMarker& place) {
    const auto rounded = [](double value) { return std::round(value * 10) / 10; };
    return {{"name", place.name}, {"x", rounded(place.x)}, {"y", rounded(place.y)}, {"z", rounded(place.z)}};
}

Json jsonOf(const std::vector<MapMarker>& places) {
    Json list = Json::array();
    for (const MapMarker& place : places) list.push_back(jsonOf(place));
    return list;
}

// Names come from players: invalid UTF-8 is replaced.
std::string dump(const Json& json) {
    return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

constexpr std::pair<std::string_view, std::string_view> kTypes[] = {{".html", "text/html; charset=utf-8"},
                                                                    {".js", "text/javascript; charset=utf-8"},
                                                                    {".css", "text/css; charset=utf-8"},
                                                                    {".png", "image/png"},
                                                                    {".svg", "image/svg+xml"}};

}  // namespace

std::string textOf(const PageInfo& info) {
    Json json = {{"name", info.name},
                 {"seed", std::to_string(info.identity.seed)},
                 {"generator", info.identity.generator},
                 {"seaLevel", gen::seaLevelOf(info.identity.generator)},
                 {"isometricHeight", map::kIsometricHeight},
                 {"bottom", info.identity.heights.bottom},
                 {"top", info.identity.heights.top},
                 {"spawn", jsonOf(info.spawn)},
                 {"places", jsonOf(info.places)},
                 {"layers", info.layers},
                 {"minZoom", info.minZoom},
                 {"maxZoom", info.maxZoom},
                 {"edits", info.edits},
                 {"isLive", info.isLive}};
    if (info.area)
        json["area"] = {
            {"x0", info.area->x0}, {"y0", info.area->y0}, {"x1", info.area->x1}, {"y1", info.area->y1}};
    return dump(json);
}

std::string textOf(const std::vector<MapMarker>& places) {
    return dump(jsonOf(places));
}

std::string scriptOf(const PageInfo& info) {
    return "window.terraneWorld = " + textOf(info) + ";\n";
}

std::span<const base::EmbeddedFile> pageFiles() {
    return embedded::page();
}

std::string_view typeOf(std::string_view fileName) {
    for (const auto& [ending, type] : kTypes)
        if (fileName.ends_with(ending)) return type;
    return "application/octet-stream";
}

}  // namespace terrane::web

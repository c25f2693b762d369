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

Json jsonOf(const NamedPlace& place) {
    const auto rounded = [](double value) { return std::round(value * 10) / 10; };
    return {{"name", place.name}, {"x", rounded(place.x)}, {"y", rounded(place.y)}, {"z", rounded(place.z)}};
}

Json jsonOf(const std::vector<NamedPlace>& places) {
    Json list = Json::array();
    for (const NamedPlace& place : places) list.push_back(jsonOf(place));
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

std::string textOf(const PageFacts& facts) {
    Json json = {{"name", facts.name},
                 {"seed", std::to_string(facts.identity.seed)},
                 {"generator", facts.identity.generator},
                 {"seaLevel", gen::kSeaLevel},
                 {"isometricHeight", map::kIsometricHeight},
                 {"spawn", jsonOf(facts.spawn)},
                 {"places", jsonOf(facts.places)},
                 {"layers", facts.layers},
                 {"minZoom", facts.minZoom},
                 {"maxZoom", facts.maxZoom},
                 {"edits", facts.edits},
                 {"isLive", facts.isLive}};
    if (facts.area)
        json["area"] = {
            {"x0", facts.area->x0}, {"y0", facts.area->y0}, {"x1", facts.area->x1}, {"y1", facts.area->y1}};
    return dump(json);
}

std::string textOf(const std::vector<NamedPlace>& places) {
    return dump(jsonOf(places));
}

std::string scriptOf(const PageFacts& facts) {
    return "window.terraneWorld = " + textOf(facts) + ";\n";
}

std::span<const base::EmbeddedFile> pageFiles() {
    return embedded::page();
}

const base::EmbeddedFile* pageFile(std::string_view name) {
    const auto files = pageFiles();
    const auto found = std::ranges::find(files, name, &base::EmbeddedFile::path);
    return found == files.end() ? nullptr : &*found;
}

std::string_view typeOf(std::string_view fileName) {
    for (const auto& [ending, type] : kTypes)
        if (fileName.ends_with(ending)) return type;
    return "application/octet-stream";
}

}  // namespace terrane::web

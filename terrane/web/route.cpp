#include "terrane/web/route.h"

#include <charconv>
#include <optional>

namespace terrane::web {
namespace {

// Parses a decimal 32-bit number; all of the text must match.
std::optional<std::int32_t> numberFrom(std::string_view text) {
    std::int32_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
}

Route tileRoute(const Target& target) {
    constexpr std::string_view kEnding = ".png";
    const auto& segments = target.segments;
    if (segments.size() != 5 || !segments[4].ends_with(kEnding)) return NotFound{};
    const auto layer = map::layerNamed(segments[1]);
    const auto zoom = numberFrom(segments[2]), x = numberFrom(segments[3]);
    const auto y = numberFrom(std::string_view(segments[4]).substr(0, segments[4].size() - kEnding.size()));
    if (!layer || !zoom || !x || !y || *zoom < map::kMinZoom || *zoom > map::kMaxZoom) return NotFound{};
    const map::MapTile tile{*layer, *zoom, *x, *y};
    if (!map::isInWorld(tile)) return NotFound{};
    return TileImage{tile};
}

Route blockRoute(const Target& target) {
    const auto x = target.parameter("x"), y = target.parameter("y");
    if (!x || !y) return BadRequest{"block needs x and y"};
    const auto numberX = numberFrom(*x), numberY = numberFrom(*y);
    if (!numberX || !numberY) return BadRequest{"x and y are whole numbers of 32 bits"};
    return BlockAt{*numberX, *numberY};
}

Route apiRoute(const Target& target) {
    if (target.segments.size() != 2) return NotFound{};
    const std::string& name = target.segments[1];
    if (name == "world") return WorldFacts{};
    if (name == "block") return blockRoute(target);
    if (name == "players") return PlayerList{};
    if (name == "edits") return EventStream{};
    return NotFound{};
}

}  // namespace

Route routeOf(const Target& target) {
    if (target.segments.empty()) return PageFile{"index.html"};
    const std::string& first = target.segments.front();
    if (first == "tiles") return tileRoute(target);
    if (first == "api") return apiRoute(target);
    if (target.segments.size() > 1) return NotFound{};
    if (first == "world.js") return WorldScript{};
    if (first == "metrics") return Metrics{};
    if (first == "healthz") return Health{};
    return PageFile{first};
}

}  // namespace terrane::web

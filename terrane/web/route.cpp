#include "terrane/web/route.h"

#include <algorithm>
#include <charconv>
#include <optional>

#include "terrane/base/text.h"

namespace terrane::web {

namespace {

std::optional<std::string> decoded(std::string_view text) {
    std::string out;
    for (std::size_t k = 0; k < text.size(); ++k) {
        if (text[k] != '%') {
            out.push_back(text[k]);
            continue;
        }
        if (k + 2 >= text.size()) return std::nullopt;
        const auto byte = base::hexByte(text[k + 1], text[k + 2]);
        if (!byte) return std::nullopt;
        out.push_back(static_cast<char>(*byte));
        k += 2;
    }
    return out;
}

// Splits at separators; an empty text has no parts.
std::vector<std::string_view> parts(std::string_view text, char separator) {
    std::vector<std::string_view> found;
    while (!text.empty()) {
        const std::size_t end = std::min(text.find(separator), text.size());
        found.push_back(text.substr(0, end));
        if (end == text.size()) break;
        text.remove_prefix(end + 1);
        if (text.empty()) found.emplace_back();
    }
    return found;
}

bool isSegment(std::string_view segment) {
    constexpr std::string_view kForbidden("/\\\0", 3);
    return !segment.empty() && segment != "." && segment != ".." &&
           segment.find_first_of(kForbidden) == std::string_view::npos;
}

}  // namespace

std::optional<std::string_view> Target::parameter(std::string_view name) const {
    const auto found = std::ranges::find(query, name, &Parameter::name);
    if (found == query.end()) return std::nullopt;
    return found->value;
}

std::optional<Target> parseTarget(std::string_view text) {
    if (text.size() > kMaxTargetBytes || !text.starts_with('/')) return std::nullopt;
    if (std::ranges::any_of(text, [](char c) { return c <= ' ' || c > '~'; })) return std::nullopt;
    const std::size_t pathEnd = std::min(text.find('?'), text.size());
    Target target;
    for (const std::string_view part : parts(text.substr(1, pathEnd - 1), '/')) {
        auto segment = decoded(part);
        if (!segment || !isSegment(*segment) || target.segments.size() == kMaxSegments) return std::nullopt;
        target.segments.push_back(std::move(*segment));
    }
    if (pathEnd == text.size()) return target;
    for (const std::string_view part : parts(text.substr(pathEnd + 1), '&')) {
        const std::size_t equals = std::min(part.find('='), part.size());
        auto name = decoded(part.substr(0, equals));
        auto value = decoded(part.substr(std::min(equals + 1, part.size())));
        if (!name || !value || target.query.size() == kMaxParameters) return std::nullopt;
        target.query.push_back({std::move(*name), std::move(*value)});
    }
    return target;
}

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
    if (name == "world") return WorldInfo{};
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

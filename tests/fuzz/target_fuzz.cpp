// libFuzzer: any bytes as a browser's request target. No segment leads upward or escapes its folder, an
// accepted target survives writing and parsing again, and its route stays in the world.
#include <string>

#include "terrane/web/route.h"
#include "tests/fuzz/fuzz_input.h"

namespace {

using namespace terrane;

std::string escaped(std::string_view text) {
    constexpr char kDigits[] = "0123456789abcdef";
    std::string out;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        out += {'%', kDigits[byte / 16], kDigits[byte % 16]};
    }
    return out;
}

// Three bytes per byte of content, which is longer than some accepted targets.
std::string written(const web::Target& target) {
    std::string text;
    for (const std::string& segment : target.segments) text += "/" + escaped(segment);
    if (text.empty()) text = "/";
    for (std::size_t k = 0; k < target.query.size(); ++k) {
        const auto& [name, value] = target.query[k];
        text += (k == 0 ? "?" : "&") + escaped(name) + "=" + escaped(value);
    }
    return text;
}

bool areEqual(const web::Target& a, const web::Target& b) {
    if (a.segments != b.segments || a.query.size() != b.query.size()) return false;
    for (std::size_t k = 0; k < a.query.size(); ++k)
        if (a.query[k].name != b.query[k].name || a.query[k].value != b.query[k].value) return false;
    return true;
}

void checkSegment(const std::string& segment) {
    fuzz::require(!segment.empty() && segment != "." && segment != "..");
    fuzz::require(segment.find_first_of(std::string_view("/\\\0", 3)) == std::string::npos);
}

void checkRoute(const web::Target& target, const web::Route& route) {
    if (const auto* page = std::get_if<web::PageFile>(&route)) {
        checkSegment(page->name);
        fuzz::require(target.segments.size() <= 1);
    }
    if (const auto* image = std::get_if<web::TileImage>(&route)) {
        const map::MapTile& tile = image->tile;
        fuzz::require(map::isInWorld(tile) && tile.zoom >= map::kMinZoom && tile.zoom <= map::kMaxZoom);
        fuzz::require(static_cast<int>(tile.layer) < map::kLayerCount);
    }
    if (const auto* bad = std::get_if<web::BadRequest>(&route))
        fuzz::require(!bad->why.empty() && bad->why.find_first_of("\r\n") == std::string::npos);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto target = web::parseTarget({reinterpret_cast<const char*>(data), size});
    if (!target) return 0;
    fuzz::require(size <= web::kMaxTargetBytes && target->segments.size() <= web::kMaxSegments &&
                  target->query.size() <= web::kMaxParameters);
    for (const std::string& segment : target->segments) checkSegment(segment);
    const std::string text = written(*target);
    const auto again = web::parseTarget(text);
    fuzz::require(again ? areEqual(*again, *target) : text.size() > web::kMaxTargetBytes);
    checkRoute(*target, web::routeOf(*target));
    return 0;
}

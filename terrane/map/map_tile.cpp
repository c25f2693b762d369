#include "terrane/map/map_tile.h"

#include <algorithm>
#include <array>

namespace terrane::map {
namespace {

constexpr std::array<std::string_view, kLayerCount> kLayerNames = {"day", "night", "height", "biome",
                                                                   "isometric"};

}  // namespace

std::string_view nameOf(Layer layer) {
    return kLayerNames[static_cast<std::size_t>(layer)];
}

std::optional<Layer> layerNamed(std::string_view name) {
    const auto found = std::ranges::find(kLayerNames, name);
    if (found == kLayerNames.end()) return std::nullopt;
    return static_cast<Layer>(found - kLayerNames.begin());
}

bool isInWorld(const MapTile& tile) {
    // Isometric tiles are numbered by pixels: sums of the world's two coordinates, and of the height.
    const std::int64_t reach = tile.layer == Layer::Isometric ? std::int64_t{1} << 32 : std::int64_t{1} << 31;
    const std::int64_t across = blocksAcross(tile.zoom);
    const auto isIn = [&](std::int32_t number) {
        return number * across < reach && (number + std::int64_t{1}) * across > -reach;
    };
    return isIn(tile.x) && isIn(tile.y);
}

std::size_t MapTileHash::operator()(const MapTile& tile) const {
    const std::uint64_t place =
        std::uint64_t{static_cast<std::uint32_t>(tile.x)} << 32 | static_cast<std::uint32_t>(tile.y);
    const std::uint64_t kind =
        static_cast<std::uint64_t>(tile.layer) << 8 | static_cast<std::uint8_t>(tile.zoom);
    const std::uint64_t spread = (place ^ kind << 27) * 0x9E3779B97F4A7C15u;
    return spread ^ spread >> 32;
}

}  // namespace terrane::map

#include "terrane/map/overlays.h"

#include <algorithm>
#include <iterator>

#include "terrane/gen/generators/continents.h"
#include "terrane/gen/generators/sea_level.h"

namespace terrane::map {
namespace {

struct Stop {
    int z;
    Rgb color;
};
constexpr int kSea = static_cast<int>(gen::kSeaLevel);
constexpr Stop kStops[] = {{0, {10, 16, 60}},           {kSea - 1, {70, 130, 200}},
                           {kSea, {60, 140, 70}},       {kSea + 30, {170, 190, 90}},
                           {kSea + 70, {190, 140, 80}}, {kSea + 110, {130, 90, 70}},
                           {255, {255, 255, 255}}};

// By the number of the biome.
constexpr Rgb kBiomeColors[] = {{38, 84, 124},   {72, 180, 190},  {240, 220, 150}, {170, 200, 90},
                                {80, 150, 60},   {150, 200, 140}, {40, 100, 50},   {50, 110, 100},
                                {160, 170, 160}, {245, 248, 255}, {210, 180, 80},  {250, 200, 110},
                                {200, 90, 50},   {90, 110, 70},   {150, 150, 170}, {20, 140, 60}};
static_assert(std::size(kBiomeColors) == static_cast<std::size_t>(gen::continents::Biome::Count));

std::uint8_t between(std::uint8_t a, std::uint8_t b, float share) {
    return static_cast<std::uint8_t>(static_cast<float>(a) +
                                     (static_cast<float>(b) - static_cast<float>(a)) * share + 0.5f);
}

constexpr int kContourBlocks = 16;
constexpr float kContourDarkness = 0.6f;

}  // namespace

Rgb heightColor(int z) {
    const auto* after = std::ranges::find_if(kStops, [z](const Stop& stop) { return stop.z > z; });
    if (after == std::begin(kStops)) return kStops[0].color;
    if (after == std::end(kStops)) return std::end(kStops)[-1].color;
    const Stop& before = after[-1];
    const float share = static_cast<float>(z - before.z) / static_cast<float>(after->z - before.z);
    return {between(before.color.red, after->color.red, share),
            between(before.color.green, after->color.green, share),
            between(before.color.blue, after->color.blue, share)};
}

Rgb biomeColor(std::size_t number) {
    return kBiomeColors[std::min(number, std::size(kBiomeColors) - 1)];
}

base::Image paintHeights(const PaintedArea& area) {
    std::array<Rgb, world::kChunkHeight> colors;
    for (int z = 0; z < world::kChunkHeight; ++z) colors[static_cast<std::size_t>(z)] = heightColor(z);
    return imageOf(gridOf(area), [&](int x, int y, glm::ivec2) {
        const int z = area.surfaces.at(x, y).underZ;
        const auto step = [&](int toX, int toY) {
            return area.surfaces.at(toX, toY).underZ / kContourBlocks;
        };
        const bool isContour = z / kContourBlocks > step(x + 1, y) || z / kContourBlocks > step(x, y - 1);
        const Rgb color = colors[static_cast<std::size_t>(z)];
        if (!isContour) return color;
        return Rgb{between(0, color.red, kContourDarkness), between(0, color.green, kContourDarkness),
                   between(0, color.blue, kContourDarkness)};
    });
}

base::Image paintBiomes(const ColumnRect& rect, int scale, std::span<const std::uint8_t> biomes) {
    return imageOf({rect.width, rect.height, 0, scale}, [&](int x, int y, glm::ivec2) {
        return biomeColor(biomes[static_cast<std::size_t>(y * rect.width + x)]);
    });
}

}  // namespace terrane::map

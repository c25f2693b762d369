#include "terrane/map/map_painter.h"

#include <algorithm>
#include <bit>
#include <iterator>
#include <type_traits>
#include <utility>

#include "terrane/base/digest.h"
#include "terrane/map/isometric.h"
#include "terrane/map/paint.h"

namespace terrane::map {

namespace {

struct Stop {
    int rise;  // above the sea
    Rgb color;
};
constexpr Stop kStops[] = {{world::kLowestBottom - gen::kSeaLevel, {0, 0, 0}},
                           {-80, {10, 16, 60}},
                           {-1, {70, 130, 200}},
                           {0, {60, 140, 70}},
                           {30, {170, 190, 90}},
                           {70, {190, 140, 80}},
                           {110, {130, 90, 70}},
                           {175, {255, 255, 255}},
                           {620, {180, 200, 240}},
                           {world::kHighestTop - 1 - gen::kSeaLevel, {150, 90, 220}}};

struct BiomeColor {
    std::string_view name;
    Rgb color;
};
// Biomes of the same name have the same color in all generators.
constexpr BiomeColor kBiomeColors[] = {
    // Water and shores.
    {"deep ocean", {20, 50, 88}},
    {"ocean", {38, 84, 124}},
    {"kelp forest", {28, 118, 108}},
    {"reef", {72, 180, 190}},
    {"beach", {240, 220, 150}},
    {"stony shore", {176, 166, 148}},
    {"mangrove", {112, 132, 92}},
    // Temperate land.
    {"meadow", {170, 200, 90}},
    {"steppe", {206, 204, 128}},
    {"oak forest", {80, 150, 60}},
    {"beech forest", {108, 172, 44}},
    {"birch forest", {150, 200, 140}},
    {"maple forest", {196, 108, 36}},
    {"old forest", {40, 100, 50}},
    {"giant forest", {70, 82, 32}},
    {"swamp", {90, 110, 70}},
    {"bog", {116, 92, 66}},
    // Cold land and heights.
    {"taiga", {50, 110, 100}},
    {"fir forest", {26, 78, 74}},
    {"larch forest", {172, 164, 56}},
    {"tundra", {160, 170, 160}},
    {"snow", {245, 248, 255}},
    {"glacier", {186, 222, 246}},
    {"alpine", {150, 150, 170}},
    {"alpine meadow", {126, 190, 112}},
    {"rocks", {128, 124, 130}},
    // Warm land.
    {"savanna", {210, 180, 80}},
    {"shrubland", {158, 146, 84}},
    {"desert", {250, 200, 110}},
    {"canyon land", {200, 90, 50}},
    {"badlands", {214, 104, 62}},
    {"rain forest", {20, 140, 60}},
    {"cloud forest", {66, 164, 118}},
    {"bamboo forest", {138, 216, 52}},
    {"cherry grove", {246, 164, 192}},
    {"lava field", {62, 40, 46}}};
constexpr Rgb kUnknownBiome{128, 128, 128};

std::vector<Rgb> biomeColors(const std::optional<gen::Biomes>& biomes) {
    std::vector<Rgb> colors;
    if (!biomes) return colors;
    for (const std::string_view name : biomes->names()) colors.push_back(biomeColor(name));
    return colors;
}

std::uint8_t between(std::uint8_t a, std::uint8_t b, float share) {
    return static_cast<std::uint8_t>(static_cast<float>(a) +
                                     (static_cast<float>(b) - static_cast<float>(a)) * share + 0.5f);
}

constexpr int kLinePixels = 8;     // between lines on a slope of 45°
constexpr int kFewestLines = 16;   // from the bottom of a world to its top
constexpr int kLinesPerThick = 4;  // the thick one included
constexpr float kLineShade = 0.6f, kThickShade = 0.45f;

Rgb shaded(const Rgb& color, float share) {
    return {between(0, color.red, share), between(0, color.green, share), between(0, color.blue, share)};
}

}  // namespace

Rgb heightColor(int z, int seaLevel) {
    const int rise = z - seaLevel;
    const auto* after = std::ranges::find_if(kStops, [rise](const Stop& stop) { return stop.rise > rise; });
    if (after == std::begin(kStops)) return kStops[0].color;
    if (after == std::end(kStops)) return std::end(kStops)[-1].color;
    const Stop& before = after[-1];
    const float share =
        static_cast<float>(rise - before.rise) / static_cast<float>(after->rise - before.rise);
    return {between(before.color.red, after->color.red, share),
            between(before.color.green, after->color.green, share),
            between(before.color.blue, after->color.blue, share)};
}

Rgb biomeColor(std::string_view name) {
    const auto* found = std::ranges::find(kBiomeColors, name, &BiomeColor::name);
    return found == std::end(kBiomeColors) ? kUnknownBiome : found->color;
}

// Powers of two: lines of a finer step are lines of a coarser one or vanish.
ContourSteps contourSteps(int level, world::Heights heights) {
    constexpr auto kLeast = static_cast<unsigned>(ContourSteps{}.line);
    const unsigned most = std::bit_floor(static_cast<unsigned>(heights.layers() / kFewestLines));
    if (most <= kLeast) return {};
    const auto line = static_cast<int>(std::clamp(unsigned{kLinePixels} << level, kLeast, most));
    return {line, kLinesPerThick * line};
}

base::Image paintHeights(const PaintedArea& area, int seaLevel, ContourSteps steps) {
    std::array<Rgb, world::kMostLayers> colors;  // from the lowest bottom
    for (std::size_t k = 0; k < colors.size(); ++k)
        colors[k] = heightColor(world::kLowestBottom + static_cast<int>(k), seaLevel);
    return imageOf(gridOf(area), [&](int x, int y, glm::ivec2) {
        const int z = area.surfaces.at(x, y).underZ;
        // Whether a line of a step lies between this column and a lower neighbor.
        const auto isOver = [&](int toX, int toY, int step) {
            const auto band = [step](int height) { return (height - world::kLowestBottom) / step; };
            return band(z) > band(area.surfaces.at(toX, toY).underZ);
        };
        const Rgb color = colors[static_cast<std::size_t>(z - world::kLowestBottom)];
        if (steps.thick > 0 && (isOver(x + 1, y, steps.thick) || isOver(x, y - 1, steps.thick) ||
                                isOver(x - 1, y, steps.thick) || isOver(x, y + 1, steps.thick)))
            return shaded(color, kThickShade);
        const bool isLine = isOver(x + 1, y, steps.line) || isOver(x, y - 1, steps.line);
        return isLine ? shaded(color, kLineShade) : color;
    });
}

base::Image paintBiomes(const ColumnRect& rect, int scale, std::span<const std::uint8_t> biomes,
                        std::span<const Rgb> colors) {
    return imageOf({rect.width, rect.height, 0, scale}, [&](int x, int y, glm::ivec2) {
        return colors[biomes[static_cast<std::size_t>(y * rect.width + x)]];
    });
}

using world::ChunkPos;

namespace {

int columnsAcross(int zoom) {
    return zoom > 0 ? kTilePixels >> zoom : kTilePixels;
}

ColumnRect widened(const ColumnRect& rect, int margin) {
    return {rect.level, rect.x0 - margin, rect.y0 - margin, rect.width + 2 * margin,
            rect.height + 2 * margin};
}

// Numbers of biomes in the order of the area's columns.
std::vector<std::uint8_t> biomesOf(const gen::Biomes& biomes, const ColumnRect& rect) {
    std::vector<std::uint8_t> numbers(static_cast<std::size_t>(rect.width) *
                                      static_cast<std::size_t>(rect.height));
    for (const ChunkPos chunk : chunksTouching(rect)) {
        if (!world::isInWorld(chunk)) continue;
        const auto columns = biomes.of(chunk);
        copyChunk(rect, chunk, columns, numbers);
    }
    return numbers;
}

}  // namespace

int marginOf(Layer layer) {
    if (layer == Layer::Biome) return 0;
    return layer == Layer::Night ? kLampMargin : kReliefMargin;
}

ColumnRect columnsOf(const MapTile& tile) {
    const int across = columnsAcross(tile.zoom);
    const ColumnRect columns{levelOf(tile.zoom), std::int64_t{tile.x} * across, std::int64_t{tile.y} * across,
                             across, across};
    return widened(columns, marginOf(tile.layer));
}

base::Result<MapPainter> MapPainter::create(Parts parts) {
    auto colors = TERRANE_TRY(mapColors(parts.blocks, parts.textures));
    return MapPainter(std::move(parts), std::move(colors));
}

MapPainter::MapPainter(Parts parts, MapColors colors)
    : kinds_(std::make_unique<SurfaceKinds>(surfaceKinds(parts.blocks))),
      heights_(parts.generators.heights()),
      colors_(std::move(colors)),
      biomes_(std::move(parts.biomes)),
      biomeColors_(biomeColors(biomes_)),
      seaLevel_(parts.seaLevel),
      surfaces_(std::make_unique<SurfaceSource>(
          SurfaceSource::Parts{parts.generators, *kinds_, parts.store, parts.cache})),
      tints_(std::make_unique<TintSource>(parts.generators)) {}

std::vector<ChunkPos> chunksFor(const MapTile& tile, world::Heights heights) {
    if (tile.layer == Layer::Biome) return {};
    if (tile.layer == Layer::Isometric) return visibleChunks({tile.zoom, tile.x, tile.y}, heights);
    return chunksTouching(columnsOf(tile));
}

std::vector<MapTile> tilesShowing(ChunkPos chunk, world::Heights heights) {
    std::vector<MapTile> tiles;
    for (int zoom = kMinZoom; zoom <= kMaxZoom; ++zoom) {
        if (levelOf(zoom) != chunk.level) continue;
        for (const Layer layer : {Layer::Day, Layer::Night, Layer::Height}) {
            const int across = columnsAcross(zoom), margin = marginOf(layer);
            const auto tileAt = [&](std::int64_t column) {
                return static_cast<std::int32_t>(tileOf(column, across));
            };
            const std::int64_t x = std::int64_t{chunk.x} * world::kChunkSize,
                               y = std::int64_t{chunk.y} * world::kChunkSize;
            for (std::int32_t ty = tileAt(y - margin); ty <= tileAt(y + world::kChunkSize - 1 + margin); ++ty)
                for (std::int32_t tx = tileAt(x - margin); tx <= tileAt(x + world::kChunkSize - 1 + margin);
                     ++tx)
                    tiles.push_back({layer, zoom, tx, ty});
        }
        for (const IsometricTile& tile : isometricTilesShowing(chunk, zoom, heights))
            tiles.push_back({Layer::Isometric, zoom, tile.x, tile.y});
    }
    return tiles;
}

base::Result<base::Image> MapPainter::isometricImage(const MapTile& tile,
                                                     std::span<const EditedChunk> edited) {
    const IsometricTile pixels{tile.zoom, tile.x, tile.y};
    const std::vector<ChunkPos> chunks = visibleChunks(pixels, heights_);
    const auto surfaces = surfaces_->surfaces(chunks, edited);
    if (!surfaces) return tl::unexpected(surfaces.error());
    std::vector<world::PackedColor> tints;
    for (const ChunkPos chunk : chunks) tints.push_back(tints_->of(chunk));
    return paintIsometric(pixels, {heights_, chunks, *surfaces, tints}, colors_);
}

base::Result<base::Image> MapPainter::image(const MapTile& tile, std::span<const EditedChunk> edited) {
    if (tile.layer == Layer::Isometric) return isometricImage(tile, edited);
    const ColumnRect rect = columnsOf(tile);
    const int scale = columnPixels(tile.zoom);
    if (tile.layer == Layer::Biome) return paintBiomes(rect, scale, biomesOf(*biomes_, rect), biomeColors_);
    const auto surfaces = surfaces_->area(rect, edited);
    if (!surfaces) return tl::unexpected(surfaces.error());
    const bool isHeight = tile.layer == Layer::Height;
    const TintField tint = isHeight ? TintField() : tints_->field(rect);
    const PaintedArea area{*surfaces, tint, marginOf(tile.layer), scale};
    if (isHeight) return paintHeights(area, seaLevel_, contourSteps(rect.level, heights_));
    return tile.layer == Layer::Night ? paintNight(area, colors_) : paintDay(area, colors_);
}

base::Result<base::Image> MapPainter::paintArea(const ColumnRect& rect, const EditedPositions& edited) {
    const ColumnRect wide = widened(rect, kReliefMargin);
    const auto surfaces = surfaces_->area(wide, edited.among(chunksTouching(wide)));
    if (!surfaces) return tl::unexpected(surfaces.error());
    const TintField tint = tints_->field(wide);
    return paintDay({*surfaces, tint, kReliefMargin, 1}, colors_);
}

std::uint64_t MapPainter::colorDigest() const {
    // Increase it when painting changes, so that folders do not mix images of two versions
    // (terrane/web/static_map.h).
    constexpr int kPainting = 3;
    std::string text = fmt::format("{}", kPainting);
    const auto add = [&](const glm::vec3& color) {
        text += fmt::format(" {} {} {}", color.r, color.g, color.b);
    };
    for (const BlockColor& color : colors_) {
        add(color.mean);
        for (const glm::vec3& texel : color.texels) add(texel);
        add(color.emission);
        text += fmt::format(" {} {} {}", color.isTinted, static_cast<int>(color.kind), color.reach);
    }
    return base::hash64(text);
}

base::Result<std::string> MapPainter::paint(const MapTile& tile, std::span<const EditedChunk> edited) {
    if (!hasLayer(tile.layer)) return base::fail(base::ErrorCode::NotFound, "the generator has no biomes");
    const auto painted = TERRANE_TRY(image(tile, edited));
    return base::encodePngFast(painted);
}

base::Result<std::uint64_t> MapPainter::surfaceDigest(ChunkPos pos, std::span<const EditedChunk> edited) {
    const auto surfaces = surfaces_->surfaces(std::span(&pos, 1), edited);
    if (!surfaces) return tl::unexpected(surfaces.error());
    static_assert(std::has_unique_object_representations_v<Surface>);
    const Surface& surface = *surfaces->front();
    return base::hash64(std::string_view(reinterpret_cast<const char*>(surface.data()), sizeof(surface)));
}

base::Result<ColumnInfo> MapPainter::columnInfo(std::int32_t x, std::int32_t y,
                                                std::span<const EditedChunk> edited) {
    const ChunkPos chunk = world::chunkOf({x, y, 0});
    const auto surfaces = surfaces_->surfaces(std::span(&chunk, 1), edited);
    if (!surfaces) return tl::unexpected(surfaces.error());
    const auto index = static_cast<std::size_t>((x & 15) + 16 * (y & 15));
    const SurfaceColumn& column = (*surfaces->front())[index];
    const bool isLiquid = column.top < colors_.size() && colors_[column.top].kind == SurfaceKind::Liquid;
    return ColumnInfo{column.top, column.topZ, isLiquid ? column.topZ - column.underZ : 0,
                      biomes_ ? biomes_->names()[biomes_->of(chunk)[index]] : std::string_view()};
}

}  // namespace terrane::map

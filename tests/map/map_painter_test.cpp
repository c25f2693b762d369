#include "terrane/map/map_painter.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <limits>
#include <set>

#include "terrane/content/built_in.h"
#include "terrane/map/paint.h"
#include "tests/map/map_fixture.h"

namespace terrane::map {
namespace {

using testing::HasSubstr;
using world::ChunkPos;

MapPainter painterOf(const std::string& generator) {
    const auto textures = content::builtInTextures();
    auto painter = MapPainter::create({generatorsOf(generator), contentBlocks(), textures, nullptr, nullptr,
                                       gen::Biomes::create(generator, contentBlocks(), kMapSeed),
                                       gen::seaLevelOf(generator)});
    if (!painter) throw std::runtime_error(painter.error().message);
    return std::move(*painter);
}

base::Image paintedTile(MapPainter& painter, const MapTile& tile, std::span<const EditedChunk> edited = {}) {
    const auto png = painter.paint(tile, edited);
    if (!png) throw std::runtime_error(png.error().message);
    return base::decodePng(*png, "tile").value();
}

bool isAmong(const std::vector<ChunkPos>& chunks, ChunkPos chunk) {
    return std::ranges::find(chunks, chunk) != chunks.end();
}
bool isAmong(const std::vector<MapTile>& tiles, const MapTile& tile) {
    return std::ranges::find(tiles, tile) != tiles.end();
}

MapTile randomTile(std::mt19937& random) {
    const int zoom = static_cast<int>(random() % 13) + kMinZoom;
    const auto end = static_cast<std::int32_t>((std::int64_t{1} << 31) / blocksAcross(zoom));
    const auto number = [&] {
        const std::uint32_t kind = random() % 4;
        if (kind == 0) return -end;
        if (kind == 1) return end - 1;
        return static_cast<std::int32_t>(random()) % (kind == 2 ? std::min(end, 30) : end);
    };
    return {static_cast<Layer>(random() % kLayerCount), zoom, number(), number()};
}

TEST(MapPainter, TilesOfAChunkAreThoseThatLookAtIt) {
    std::mt19937 random(1);
    for (int round = 0; round < 300; ++round) {
        const MapTile tile = randomTile(random);
        const std::vector<ChunkPos> chunks = chunksFor(tile, {});
        ASSERT_EQ(chunks.size(), std::set<ChunkPos>(chunks.begin(), chunks.end()).size());
        for (const ChunkPos chunk : chunks) {
            ASSERT_EQ(chunk.level, levelOf(tile.zoom));
            if (!world::isInWorld(chunk) || (tile.layer == Layer::Isometric && random() % 8 > 0)) continue;
            const std::vector<MapTile> tiles = tilesShowing(chunk, {});
            // An isometric tile looks at a few more chunks than reach into it (isometric_test.cpp).
            ASSERT_TRUE(tile.layer == Layer::Isometric || isAmong(tiles, tile))
                << nameOf(tile.layer) << " " << tile.zoom << " " << tile.x << " " << tile.y;
            for (const MapTile& other : tiles)
                ASSERT_TRUE(isAmong(chunksFor(other, {}), chunk)) << testing::PrintToString(chunk);
            if (random() % 8 > 0) break;
        }
    }
}

TEST(MapPainter, HighLevelsHaveNoTiles) {
    EXPECT_TRUE(tilesShowing({0, 0, 11}, {}).empty());
    EXPECT_TRUE(tilesShowing({0, 0, 15}, {}).empty());
    EXPECT_FALSE(tilesShowing({0, 0, 10}, {}).empty());
}

// Four tiles that meet at a corner, painted as one image.
base::Image fourTiles(const MapTile& first, std::span<const EditedChunk> edited) {
    const gen::LevelGenerators& generators = generatorsOf("overworld");
    SurfaceSource source({generators, contentKinds()});
    TintSource tints(generators);
    const MapColors colors = mapColors(contentBlocks(), content::builtInTextures()).value();
    const int margin = marginOf(first.layer), scale = first.zoom > 0 ? 1 << first.zoom : 1;
    ColumnRect rect = columnsOf(first);
    rect.width += rect.width - 2 * margin;
    rect.height += rect.height - 2 * margin;
    const SurfaceArea surfaces = source.area(rect, edited).value();
    const TintField tint = tints.field(rect);
    const PaintedArea area{surfaces, tint, margin, scale};
    if (first.layer == Layer::Night) return paintNight(area, colors);
    return first.layer == Layer::Height ? paintHeights(area, gen::seaLevelOf("overworld"))
                                        : paintDay(area, colors);
}

bool isPartOf(const base::Image& part, const base::Image& whole, int x, int y) {
    for (int row = 0; row < part.height; ++row) {
        const auto from = part.rgba.begin() + std::ptrdiff_t{row} * part.width * 4;
        const auto at = whole.rgba.begin() + (std::ptrdiff_t{row + y} * whole.width + x) * 4;
        if (!std::equal(from, from + std::ptrdiff_t{part.width} * 4, at)) return false;
    }
    return true;
}

// Lamps beside the borders of tiles.
std::vector<EditedChunk> chunksWithLamps() {
    std::vector<EditedChunk> edited;
    for (const ChunkPos pos : {ChunkPos{-1, 0}, ChunkPos{0, -1}, ChunkPos{-4, -3}})
        edited.push_back({pos, chunkWithPillar(generatorsOf("overworld"), pos, 1, 14, "lamp_red")});
    return edited;
}

TEST(MapPainter, TilesFitTogether) {
    MapPainter painter = painterOf("overworld");
    const std::vector<EditedChunk> edited = chunksWithLamps();
    for (const int zoom : {2, 0, -3}) {
        for (const Layer layer : {Layer::Day, Layer::Night, Layer::Height}) {
            if (layer != Layer::Day && zoom == -3) continue;
            const MapTile first{layer, zoom, -1, -1};
            const base::Image whole = fourTiles(first, edited);
            std::set<std::vector<std::uint8_t>> colors;
            for (std::size_t k = 0; k < whole.rgba.size(); k += 4)
                colors.insert({whole.rgba[k], whole.rgba[k + 1], whole.rgba[k + 2]});
            EXPECT_GT(colors.size(), 10u) << "there is something to be seen";
            for (int k = 0; k < 4; ++k) {
                const MapTile tile{layer, zoom, first.x + k % 2, first.y + k / 2};
                // East, the lower x, is at the right.
                EXPECT_TRUE(
                    isPartOf(paintedTile(painter, tile, edited), whole, (1 - k % 2) * 256, k / 2 * 256))
                    << nameOf(layer) << " " << zoom << " " << tile.x << " " << tile.y;
            }
        }
    }
}

TEST(MapPainter, AnEditChangesTheTilesOfItsChunk) {
    MapPainter painter = painterOf("flat");
    const ChunkPos chunk{0, 15};
    const EditedChunk edited[] = {{chunk, chunkWithPillar(generatorsOf("flat"), chunk, 15, 15, "lamp_red")}};
    for (const MapTile& tile : tilesShowing(chunk, {})) {
        if (!painter.hasLayer(tile.layer) || tile.zoom == 1) continue;
        const bool isChanged = paintedTile(painter, tile).rgba != paintedTile(painter, tile, edited).rgba;
        const bool isItsOwn =
            tile.x == 0 && tile.y == (tile.zoom == 2 ? 3 : 0) && tile.layer != Layer::Isometric;
        EXPECT_TRUE(isChanged || !isItsOwn) << nameOf(tile.layer) << tile.zoom;
    }
    // The relief of the tile to the south shows that it is higher to its north, and the lamp shines there.
    for (const Layer layer : {Layer::Day, Layer::Night})
        EXPECT_NE(paintedTile(painter, {layer, 0, 0, 1}).rgba,
                  paintedTile(painter, {layer, 0, 0, 1}, edited).rgba);
    int changed = 0;
    for (const MapTile& tile : tilesShowing(chunk, {}))
        if (tile.layer == Layer::Isometric && tile.zoom == 0)
            changed += paintedTile(painter, tile).rgba != paintedTile(painter, tile, edited).rgba;
    EXPECT_GT(changed, 0);
}

TEST(MapPainter, EveryLayerIsATile) {
    MapPainter painter = painterOf("continents");
    for (int k = 0; k < kLayerCount; ++k) {
        const auto layer = static_cast<Layer>(k);
        EXPECT_TRUE(painter.hasLayer(layer));
        const base::Image image = paintedTile(painter, {layer, -5, 0, -1});
        EXPECT_EQ(image.width, 256);
        EXPECT_EQ(image.height, 256);
    }
}

TEST(MapPainter, BiomesAreThoseOfTheGenerator) {
    MapPainter painter = painterOf("continents");
    const auto biomes = gen::Biomes::create("continents", contentBlocks(), kMapSeed).value();
    const base::Image image = paintedTile(painter, {Layer::Biome, -4, -1, 0});
    // The tile has the chunks -16 … -1, 0 … 15 of level 4.
    for (const ChunkPos chunk : {ChunkPos{-16, 0, 4}, ChunkPos{-1, 15, 4}, ChunkPos{-7, 3, 4}}) {
        const auto numbers = biomes.of(chunk);
        for (int y = 0; y < 16; ++y) {
            for (int x = 0; x < 16; ++x) {
                const int right = -1 - (chunk.x * 16 + x), down = chunk.y * 16 + y;
                const auto* pixel = &image.rgba[static_cast<std::size_t>(down * 256 + right) * 4];
                ASSERT_EQ((Rgb{pixel[0], pixel[1], pixel[2]}),
                          biomeColor(biomes.names()[numbers[static_cast<std::size_t>(x + 16 * y)]]));
            }
        }
    }
}

// Below and above the sea are two colors that have no shade in common, in every generator with a sea.
TEST(MapPainter, TheShoreIsWhereTheSeaIs) {
    for (const gen::CatalogueEntry& entry : gen::builtInGenerators()) {
        MapPainter painter = painterOf(entry.name);
        const MapTile tile{Layer::Height, -4, -1, 0};
        const base::Image heights = paintedTile(painter, tile);
        SurfaceSource source({generatorsOf(entry.name), contentKinds()});
        const SurfaceArea surfaces = source.area(columnsOf(tile), {}).value();
        const int margin = marginOf(Layer::Height);
        for (int k = 0; k < 256; ++k) {
            const SurfaceColumn& column = surfaces.at(k + margin, k + margin);
            const auto* pixel = &heights.rgba[static_cast<std::size_t>(k * 256 + 255 - k) * 4];
            const int rise = column.underZ - entry.seaLevel;
            const bool isSea = rise < 0 && column.topZ == entry.seaLevel, isLand = rise > 0 && rise < 100;
            EXPECT_TRUE(!isSea || pixel[2] > pixel[0]) << entry.name << ", column " << k;
            EXPECT_TRUE(!isLand || pixel[1] + 60 >= pixel[2]) << entry.name << ", column " << k;
        }
    }
}

TEST(MapPainter, WithoutBiomesThereIsNoSuchLayer) {
    MapPainter painter = painterOf("flat");
    EXPECT_FALSE(painter.hasLayer(Layer::Biome));
    EXPECT_TRUE(painter.hasLayer(Layer::Isometric));
    const auto png = painter.paint({Layer::Biome, 0, 0, 0}, {});
    ASSERT_FALSE(png);
    EXPECT_EQ(png.error().code, base::ErrorCode::NotFound);
}

TEST(MapPainter, TilesAtTheEndOfTheWorld) {
    MapPainter painter = painterOf("flat");
    for (const int zoom : {kMinZoom, 0, kMaxZoom}) {
        const auto end = static_cast<std::int32_t>((std::int64_t{1} << 31) / blocksAcross(zoom));
        for (const std::int32_t x : {-end, end - 1})
            for (const Layer layer : {Layer::Day, Layer::Night, Layer::Isometric})
                EXPECT_EQ(paintedTile(painter, {layer, zoom, x, x}).width, 256);
    }
    EXPECT_EQ(paintedTile(painter, {Layer::Isometric, 0, 0, (1 << 24) - 1}).rgba[3], 0) << "beyond: nothing";
}

TEST(MapPainter, FactsOfAColumn) {
    MapPainter painter = painterOf("continents");
    const gen::LevelGenerators& generators = generatorsOf("continents");
    const auto biomes = gen::Biomes::create("continents", contentBlocks(), kMapSeed).value();
    int liquids = 0;
    for (const auto& [x, y] : {std::pair(5, -3), std::pair(-1, 2000), std::pair(-30000, 4),
                               std::pair(7777, 7777), std::pair(-60000, 90000), std::pair(200000, -150000)}) {
        const auto info = painter.columnInfo(x, y, {}).value();
        const ChunkPos chunk = world::chunkOf(world::BlockPos{x, y, 0});
        const auto index = static_cast<std::size_t>((x & 15) + 16 * (y & 15));
        const SurfaceColumn column = generatedSurface(generators, chunk)[index];
        EXPECT_EQ(info.top, column.top);
        EXPECT_EQ(info.topZ, column.topZ);
        EXPECT_EQ(info.biome, biomes.names()[biomes.of(chunk)[index]]);
        const bool isLiquid = contentKinds()[column.top] == SurfaceKind::Liquid;
        EXPECT_EQ(info.depth, isLiquid ? column.topZ - column.underZ : 0);
        liquids += isLiquid;
    }
    EXPECT_GT(liquids, 0) << "one of the places is a sea";
}

TEST(MapPainter, FactsOfAnEditedColumn) {
    MapPainter painter = painterOf("flat");
    EXPECT_EQ(painter.columnInfo(-1, -1, {}).value().topZ, 80);
    EXPECT_EQ(painter.columnInfo(-1, -1, {}).value().top, contentBlock("grass"));
    EXPECT_EQ(painter.columnInfo(-1, -1, {}).value().biome, "");
    const EditedChunk edited[] = {
        {{-1, -1}, chunkWithPillar(generatorsOf("flat"), {-1, -1}, 15, 15, "lamp_red")}};
    const auto info = painter.columnInfo(-1, -1, edited).value();
    EXPECT_EQ(info.top, contentBlock("lamp_red"));
    EXPECT_EQ(info.topZ, 200);
    EXPECT_EQ(info.depth, 0);
    EXPECT_EQ(painter.columnInfo(-2, -1, edited).value().topZ, 80);
    constexpr std::int32_t kLow = std::numeric_limits<std::int32_t>::min(),
                           kHigh = std::numeric_limits<std::int32_t>::max();
    EXPECT_EQ(painter.columnInfo(kLow, kHigh, {}).value().topZ, 80);
}

TEST(MapPainter, ATextureThatCannotBeReadIsNamed) {
    const world::TextureSource none = [](std::string_view name) -> base::Result<base::Image> {
        return base::fail("{}: there is no such texture", name);
    };
    const auto painter = MapPainter::create({generatorsOf("flat"), contentBlocks(), none});
    ASSERT_FALSE(painter);
    EXPECT_THAT(painter.error().message, HasSubstr("there is no such texture"));
}

TEST(MapPainter, BiomesNeedNoSurfacesAndNoEdits) {
    const auto textures = content::builtInTextures();
    MapPainter painter = MapPainter::create({noGenerators(), contentBlocks(), textures, nullptr, nullptr,
                                             gen::Biomes::create("continents", contentBlocks(), kMapSeed)})
                             .value();
    MapPainter whole = painterOf("continents");
    for (const int zoom : {2, 0, -5}) {
        const MapTile tile{Layer::Biome, zoom, 1, -2};
        EXPECT_TRUE(chunksFor(tile, {}).empty());
        EXPECT_TRUE(paintedTile(painter, tile).rgba == paintedTile(whole, tile).rgba);
        EXPECT_EQ(columnsOf(tile).width, zoom == 2 ? 64 : 256) << "no margin";
    }
    for (const int level : {0, 5})
        for (const MapTile& tile : tilesShowing({3, 4, static_cast<std::uint8_t>(level)}, {}))
            EXPECT_NE(tile.layer, Layer::Biome);
    EXPECT_FALSE(painter.paint({Layer::Day, 0, 0, 0}, {})) << "other layers need them";
}

TEST(MapPainter, ColumnsOfATile) {
    const auto expect = [](const MapTile& tile, const ColumnRect& rect) {
        const ColumnRect found = columnsOf(tile);
        EXPECT_EQ(found.level, rect.level);
        EXPECT_EQ(found.x0, rect.x0);
        EXPECT_EQ(found.y0, rect.y0);
        EXPECT_EQ(found.width, rect.width);
        EXPECT_EQ(found.height, rect.height);
    };
    expect({Layer::Day, 0, -1, 2}, {0, -258, 510, 260, 260});
    expect({Layer::Night, -3, 0, 0}, {3, -16, -16, 288, 288});
    expect({Layer::Height, 2, 3, -1}, {0, 190, -66, 68, 68});
}

}  // namespace
}  // namespace terrane::map

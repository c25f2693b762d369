// Maps at the four corners of the world: all layers, all zooms, images of areas. Under the sanitizers, an
// overflow ends the test.
#include <algorithm>
#include <cmath>
#include <glm/vec2.hpp>
#include <limits>

#include "terrane/content/built_in.h"
#include "terrane/map/area_image.h"
#include "terrane/map/isometric.h"
#include "terrane/map/map_painter.h"
#include "tests/map/map_fixture.h"

namespace terrane::map {
namespace {

using world::ChunkPos;

constexpr std::int64_t kEdgeBlocks = std::int64_t{1}
                                     << 31;  // blocks are from -kEdgeBlocks to kEdgeBlocks - 1

MapPainter edgePainter() {
    const auto textures = content::builtInTextures();
    return MapPainter::create({generatorsOf("flat"), contentBlocks(), textures, nullptr, nullptr,
                               gen::Biomes::create("flat", contentBlocks(), kMapSeed)})
        .value();
}

struct MapCorner {
    bool isHighX = false, isHighY = false;

    ChunkPos chunk(int level) const {
        const std::int32_t low = world::kMinChunk >> level, high = world::kMaxChunk >> level;
        return {isHighX ? high : low, isHighY ? high : low, static_cast<std::uint8_t>(level)};
    }
    // The corner's block, seen as a point of the isometric view at a height.
    glm::dvec2 isometricPixel(int zoom, double z) const {
        const auto at = [](bool isHigh) {
            return static_cast<double>(isHigh ? kEdgeBlocks - 1 : -kEdgeBlocks);
        };
        const double x = at(isHighX) + 0.5, y = at(isHighY) + 0.5, scale = std::exp2(zoom);
        return {scale * (-x - y), scale * ((y - x) / 2 - kIsometricHeight * z)};
    }
};

class MapEdgeTest : public testing::TestWithParam<MapCorner> {
  protected:
    static bool hasLand(const base::Image& image) {
        for (std::size_t k = 3; k < image.rgba.size(); k += 4)
            if (image.rgba[k] != 0 && image.rgba[k - 1] + image.rgba[k - 2] + image.rgba[k - 3] > 0)
                return true;
        return false;
    }
    MapPainter painter_ = edgePainter();
};

TEST_P(MapEdgeTest, AllLayersAtAllZooms) {
    for (int zoom = kMinZoom; zoom <= kMaxZoom; ++zoom) {
        const std::int64_t across = blocksAcross(zoom);
        const auto number = [&](bool isHigh) {
            return static_cast<std::int32_t>(tileOf(isHigh ? kEdgeBlocks - 1 : -kEdgeBlocks, across));
        };
        for (const Layer layer : {Layer::Day, Layer::Night, Layer::Height}) {
            const MapTile tile{layer, zoom, number(GetParam().isHighX), number(GetParam().isHighY)};
            ASSERT_TRUE(isInWorld(tile));
            const auto png = painter_.paint(tile, {});
            ASSERT_TRUE(png) << png.error().message;
            EXPECT_TRUE(hasLand(base::decodePng(*png, "tile").value())) << nameOf(layer) << " " << zoom;
            EXPECT_FALSE(isInWorld({layer, zoom, tile.x + (GetParam().isHighX ? 1 : -1), tile.y}));
        }
    }
}

TEST_P(MapEdgeTest, TheIsometricViewAtAllZooms) {
    for (int zoom = kMinZoom; zoom <= kMaxZoom; ++zoom) {
        const glm::dvec2 pixel = GetParam().isometricPixel(zoom, 0) / double{kTilePixels};
        const MapTile tile{Layer::Isometric, zoom, static_cast<std::int32_t>(std::floor(pixel.x)),
                           static_cast<std::int32_t>(std::floor(pixel.y))};
        ASSERT_TRUE(isInWorld(tile)) << zoom;
        const std::vector<ChunkPos> chunks = chunksFor(tile, {});
        EXPECT_TRUE(std::ranges::find(chunks, GetParam().chunk(levelOf(zoom))) != chunks.end()) << zoom;
        const auto png = painter_.paint(tile, {});
        ASSERT_TRUE(png) << png.error().message;
        EXPECT_TRUE(hasLand(base::decodePng(*png, "tile").value())) << zoom;
    }
}

// Every tile of a chunk at the corner shows it, if it is a tile of the world.
TEST_P(MapEdgeTest, TilesOfTheLastChunk) {
    for (int level = 0; level <= levelOf(kMinZoom); ++level) {
        const ChunkPos chunk = GetParam().chunk(level);
        std::size_t inWorld = 0;
        for (const MapTile& tile : tilesShowing(chunk, {})) {
            if (!isInWorld(tile)) continue;
            ++inWorld;
            const std::vector<ChunkPos> chunks = chunksFor(tile, {});
            EXPECT_TRUE(std::ranges::find(chunks, chunk) != chunks.end()) << pathOf(tile);
        }
        EXPECT_GE(inWorld, 4u) << level;
    }
}

TEST_P(MapEdgeTest, ImagesOfAreasAtAllLevels) {
    base::JobSystem jobs(2);
    for (int level = 0; level <= world::kMaxLevel; ++level) {
        const ChunkPos chunk = GetParam().chunk(level);
        const ColumnRect rect = columnsOf({chunk.x, chunk.y, chunk.x + 1, chunk.y + 1}, level);
        const auto image = drawArea(painter_, rect, {}, jobs, [](int) { return true; });
        ASSERT_TRUE(image) << image.error().message;
        EXPECT_TRUE(hasLand(*image)) << level;
    }
}

TEST_P(MapEdgeTest, FactsOfTheLastColumn) {
    const auto number = [](bool isHigh) {
        return isHigh ? std::numeric_limits<std::int32_t>::max() : std::numeric_limits<std::int32_t>::min();
    };
    EXPECT_EQ(painter_.columnInfo(number(GetParam().isHighX), number(GetParam().isHighY), {}).value().topZ,
              80);
}

INSTANTIATE_TEST_SUITE_P(Corners, MapEdgeTest,
                         testing::Values(MapCorner{false, false}, MapCorner{false, true},
                                         MapCorner{true, false}, MapCorner{true, true}));

}  // namespace
}  // namespace terrane::map

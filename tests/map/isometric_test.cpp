#include "terrane/map/isometric.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "terrane/map/map_tile.h"
#include "tests/map/map_fixture.h"

namespace terrane::map {
namespace {

using world::ChunkPos;

constexpr world::BlockId kRed = 1, kGreen = 2;

MapColors redAndGreen() {
    MapColors colors(3);
    colors[kRed] = {.mean = {1, 0, 0}};
    colors[kGreen] = {.mean = {0, 1, 0}};
    return colors;
}

struct PixelBox {
    double x0, y0, x1, y1;  // pixels of the zoom

    // Has a pixel in common with the tile.
    bool touches(const IsometricTile& tile) const {
        const double left = 256.0 * tile.x, top = 256.0 * tile.y;
        return x0 < left + 256 && x1 > left && y0 < top + 256 && y1 > top;
    }
};

// The bounds of the eight corners of the chunk's box, by the formula of the header.
PixelBox boxOf(ChunkPos chunk, int zoom, world::Heights heights) {
    const double scale = zoom > 0 ? std::exp2(zoom) : 1, height = kIsometricHeight * std::exp2(zoom);
    PixelBox box{1e300, 1e300, -1e300, -1e300};
    for (int corner = 0; corner < 8; ++corner) {
        const double x = 16.0 * chunk.x + (corner & 1) * 16, y = 16.0 * chunk.y + (corner >> 1 & 1) * 16;
        const double pixelX = scale * (-x - y);
        const double pixelY =
            scale * (y - x) / 2 - height * (corner >> 2 == 0 ? heights.bottom : heights.top);
        box = {std::min(box.x0, pixelX), std::min(box.y0, pixelY), std::max(box.x1, pixelX),
               std::max(box.y1, pixelY)};
    }
    return box;
}

bool contains(const std::vector<ChunkPos>& chunks, ChunkPos chunk) {
    return std::ranges::find(chunks, chunk) != chunks.end();
}
bool contains(const std::vector<IsometricTile>& tiles, const IsometricTile& tile) {
    return std::ranges::any_of(tiles, [&](const IsometricTile& other) {
        return other.zoom == tile.zoom && other.x == tile.x && other.y == tile.y;
    });
}

ChunkPos randomChunk(std::mt19937& random, int zoom) {
    const int level = levelOf(zoom);
    const std::int32_t range = random() % 3 == 0 ? world::kMaxChunk >> level : 60;
    const auto number = [&] { return static_cast<std::int32_t>(random()) % range; };
    return {number(), number(), static_cast<std::uint8_t>(level)};
}

constexpr world::Heights kSomeHeights[] = {{}, {-64, 320}, {-1024, 1024}, {512, 768}, {-512, -256}};

TEST(Isometric, TilesSeeingAChunkAreThoseInWhichItIsSeen) {
    std::mt19937 random(1);
    for (int round = 0; round < 400; ++round) {
        const int zoom = static_cast<int>(random() % 13) + kMinZoom;
        const ChunkPos chunk = randomChunk(random, zoom);
        const world::Heights heights = kSomeHeights[random() % std::size(kSomeHeights)];
        const std::vector<IsometricTile> tiles = isometricTilesShowing(chunk, zoom, heights);
        for (const IsometricTile& tile : tiles)
            ASSERT_TRUE(contains(visibleChunks(tile, heights), chunk))
                << testing::PrintToString(chunk) << " in tile " << tile.x << ", " << tile.y;
        // Around each of them, too: all that the chunk's box reaches into.
        const PixelBox box = boxOf(chunk, zoom, heights);
        const IsometricTile first = tiles.front(), last = tiles.back();
        for (std::int32_t y = first.y - 2; y <= last.y + 2; ++y)
            for (std::int32_t x = first.x - 2; x <= last.x + 2; ++x)
                ASSERT_TRUE(!box.touches({zoom, x, y}) || contains(tiles, {zoom, x, y}))
                    << testing::PrintToString(chunk) << " in tile " << x << ", " << y;
        const auto rows = static_cast<std::size_t>(heights.layers() / 256);
        EXPECT_LE(tiles.size(), (zoom > 0 ? 40u : 9u) * rows) << "few more than are touched";
    }
}

TEST(Isometric, ChunksSeenAreAllThatReachIntoATile) {
    std::mt19937 random(2);
    for (int round = 0; round < 100; ++round) {
        const int zoom = static_cast<int>(random() % 13) + kMinZoom;
        const world::Heights heights = kSomeHeights[random() % std::size(kSomeHeights)];
        const std::vector<IsometricTile> seeing =
            isometricTilesShowing(randomChunk(random, zoom), zoom, heights);
        const IsometricTile tile = seeing[random() % seeing.size()];
        const std::vector<ChunkPos> chunks = visibleChunks(tile, heights);
        for (const ChunkPos chunk : chunks) {
            ASSERT_TRUE(world::isInWorld(chunk));
            ASSERT_EQ(chunk.level, levelOf(zoom));
            ASSERT_TRUE(!boxOf(chunk, zoom, heights).touches(tile) ||
                        contains(isometricTilesShowing(chunk, zoom, heights), tile));
            // The chunks around those that are in the list have to be in it as well, where they are seen.
            for (const ChunkPos near : world::chunksWithin(chunk, 1))
                ASSERT_TRUE(!world::isInWorld(near) || !boxOf(near, zoom, heights).touches(tile) ||
                            contains(chunks, near))
                    << testing::PrintToString(near);
        }
        const auto depth = [](ChunkPos chunk) { return chunk.y - chunk.x; };
        EXPECT_TRUE(std::ranges::is_sorted(chunks, {}, depth)) << "the farthest first";
    }
}

TEST(Isometric, NoChunkIsSeenBeyondTheWorld) {
    for (const std::int32_t far :
         {std::numeric_limits<std::int32_t>::min(), 1 << 30, std::numeric_limits<std::int32_t>::max()}) {
        EXPECT_TRUE(visibleChunks({0, far, 0}, {}).empty());
        EXPECT_TRUE(visibleChunks({2, 0, far}, {}).empty());
        EXPECT_TRUE(visibleChunks({-10, far, far}, {}).empty());
    }
}

// The pixel of a point, of a tile's image.
std::array<int, 4> pixelAt(const base::Image& image, const IsometricTile& tile, double x, double y) {
    const auto column = static_cast<int>(std::floor(x)) - tile.x * 256,
               row = static_cast<int>(std::floor(y)) - tile.y * 256;
    if (column < 0 || column > 255 || row < 0 || row > 255) return {};
    const auto* pixel = &image.rgba[static_cast<std::size_t>(row * 256 + column) * 4];
    return {pixel[0], pixel[1], pixel[2], pixel[3]};
}

TEST(Isometric, AColumnStandsWhereTheFormulaSays) {
    Surface surface{};
    surface[3 + 16 * 5] = {kRed, kRed, 9, 9};
    const ChunkPos chunk{-6, 5};
    const double x = -96 + 3 + 0.5, y = 80 + 5 + 0.5;  // the middle of the column
    for (const int zoom : {0, 1, 2}) {
        const double scale = std::exp2(zoom), right = scale * (-x - y), down = scale * (y - x) / 2,
                     block = scale * kIsometricHeight;
        const IsometricTile tile{zoom, static_cast<std::int32_t>(std::floor(right / 256)),
                                 static_cast<std::int32_t>(std::floor(down / 256))};
        const std::array<SurfacePtr, 1> surfaces{std::make_shared<const Surface>(surface)};
        const world::PackedColor tint = world::kNeutralTint;
        const base::Image image =
            paintIsometric(tile, {{}, std::span(&chunk, 1), surfaces, std::span(&tint, 1)}, redAndGreen());
        ASSERT_EQ(image.width, 256);
        ASSERT_EQ(image.height, 256);
        // Its top is ten blocks above the ground, its sides beneath, the southern one at the left.
        EXPECT_EQ(pixelAt(image, tile, right + 0.1, down - 10 * block), (std::array{255, 0, 0, 255}));
        const auto south = pixelAt(image, tile, right - scale / 2, down - 5 * block),
                   east = pixelAt(image, tile, right + scale / 2, down - 5 * block);
        EXPECT_EQ(south[3], 255);
        EXPECT_EQ(east[3], 255);
        EXPECT_LT(south[0], 255);
        EXPECT_LT(east[0], south[0]);
        EXPECT_EQ(pixelAt(image, tile, right, down - 12 * block)[3], 0);
        EXPECT_EQ(pixelAt(image, tile, right + 1.6 * scale, down - 5 * block)[3], 0);
    }
}

TEST(Isometric, WhatIsNearerHidesWhatIsFarther) {
    Surface surface{};
    surface[8 + 16 * 8] = {kRed, kRed, 60, 60};
    surface[7 + 16 * 9] = {kGreen, kGreen, 60, 60};  // one to the east and one to the south
    const ChunkPos chunk{0, -3};
    const std::array<SurfacePtr, 1> surfaces{std::make_shared<const Surface>(surface)};
    const world::PackedColor tint = world::kNeutralTint;
    int red = 0, green = 0;
    for (const IsometricTile& tile : isometricTilesShowing(chunk, 0, {})) {
        const base::Image image =
            paintIsometric(tile, {{}, std::span(&chunk, 1), surfaces, std::span(&tint, 1)}, redAndGreen());
        for (std::size_t k = 0; k < image.rgba.size(); k += 4) {
            red += image.rgba[k] > 0;
            green += image.rgba[k + 1] > 0;
        }
    }
    // Two pixels wide, a diamond of one pixel and 61 blocks of 1.25 pixels high.
    EXPECT_NEAR(green, 2 * (61 * 1.25 + 0.5), 3);
    EXPECT_NEAR(red, 2, 2) << "all of it but one row of pixels is hidden";
}

// Chunks that visibleChunks() leaves out would change nothing.
TEST(Isometric, TilesShowAllThatReachesIntoThem) {
    std::mt19937 random(4);
    const auto randomSurface = [&] {
        Surface surface;
        for (SurfaceColumn& column : surface) {
            column.top = column.under = static_cast<world::BlockId>(1 + random() % 2);
            column.topZ = column.underZ = static_cast<std::int16_t>(random() % 256);
        }
        return std::make_shared<const Surface>(surface);
    };
    std::vector<SurfacePtr> some;
    for (int k = 0; k < 5; ++k) some.push_back(randomSurface());
    const auto surfaceAt = [&](ChunkPos chunk) {
        return some[static_cast<std::size_t>(chunk.x * 7 + chunk.y * 3) % some.size()];
    };
    const MapColors colors = redAndGreen();
    for (const int zoom : {2, 0, -3}) {
        const IsometricTile tile{zoom, -1, zoom == 0 ? 0 : 1};
        const auto paint = [&](const std::vector<ChunkPos>& chunks) {
            std::vector<SurfacePtr> surfaces;
            for (const ChunkPos chunk : chunks) surfaces.push_back(surfaceAt(chunk));
            const std::vector<world::PackedColor> tints(chunks.size(), world::kNeutralTint);
            return paintIsometric(tile, {{}, chunks, surfaces, tints}, colors);
        };
        const std::vector<ChunkPos> seen = visibleChunks(tile, {});
        std::vector<ChunkPos> more;
        for (const ChunkPos chunk : seen)
            for (const ChunkPos near : world::chunksWithin(chunk, 2)) more.push_back(near);
        std::ranges::sort(more);
        more.erase(std::unique(more.begin(), more.end()), more.end());
        std::ranges::sort(more, {}, [](ChunkPos chunk) { return chunk.y - chunk.x; });
        EXPECT_GT(more.size(), seen.size());
        EXPECT_TRUE(paint(seen).rgba == paint(more).rgba) << "zoom " << zoom;
    }
}

constexpr world::BlockId kWaterBlock = 3, kLeavesBlock = 4, kLavaBlock = 5;

MapColors colorsWithLiquids() {
    MapColors colors = redAndGreen();
    colors.resize(6);
    colors[kWaterBlock] = {.mean = {0, 0, 1}, .kind = SurfaceKind::Liquid};
    colors[kLeavesBlock] = {.mean = {0, 1, 0}, .kind = SurfaceKind::Crown};
    colors[kLavaBlock] = {.mean = {1, 0.5f, 0}, .kind = SurfaceKind::Liquid, .reach = 15};
    return colors;
}

// The pixel of a height in the middle of a single column.
std::array<int, 4> topPixel(const SurfaceColumn& column, double z) {
    Surface surface{};
    surface[8 + 16 * 8] = column;
    const ChunkPos chunk{-8, 8};
    const double x = -128 + 8.5, y = 128 + 8.5;
    const double right = 4 * (-x - y) + 0.1, down = 4 * ((y - x) / 2 - kIsometricHeight * z);
    const IsometricTile tile{2, static_cast<std::int32_t>(std::floor(right / 256)),
                             static_cast<std::int32_t>(std::floor(down / 256))};
    const std::array<SurfacePtr, 1> surfaces{std::make_shared<const Surface>(surface)};
    const world::PackedColor tint = world::kNeutralTint;
    return pixelAt(
        paintIsometric(tile, {{}, std::span(&chunk, 1), surfaces, std::span(&tint, 1)}, colorsWithLiquids()),
        tile, right, down);
}

TEST(Isometric, ThereIsWaterUnderACrown) {
    const SurfaceColumn column{kLeavesBlock, kWaterBlock, 60, 40};
    EXPECT_EQ(topPixel(column, 61), (std::array{0, 255, 0, 255}));
    EXPECT_EQ(topPixel(column, 50)[3], 0) << "between them";
    const auto water = topPixel(column, 40.9);  // liquids are 0.9 blocks high
    EXPECT_EQ(water[3], 255) << "no hole";
    EXPECT_GT(water[2], 150);
    EXPECT_EQ(water[1], 0);
    EXPECT_GT(topPixel(column, 20)[2], 100) << "its side";
}

TEST(Isometric, LavaIsNotMixedWithItsGround) {
    const std::array<int, 4> lava = {255, 128, 0, 255};
    EXPECT_EQ(topPixel({kLavaBlock, kGreen, 40, 39}, 40.9), lava);
    EXPECT_EQ(topPixel({kLeavesBlock, kLavaBlock, 60, 40}, 40.9), lava);
    EXPECT_NE(topPixel({kWaterBlock, kGreen, 40, 39}, 40.9)[1], 0) << "the ground is seen through water";
}

}  // namespace
}  // namespace terrane::map

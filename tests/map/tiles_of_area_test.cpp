#include "terrane/map/map_tile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "terrane/map/isometric.h"

namespace terrane::map {
namespace {

constexpr Layer kAllLayers[] = {Layer::Day, Layer::Night, Layer::Height, Layer::Biome, Layer::Isometric};

BlockRect randomArea(std::mt19937& random) {
    const auto below = [&](int end) {
        return static_cast<std::int64_t>(random() % static_cast<unsigned>(end));
    };
    const std::int64_t x = below(4000) - 2000, y = below(4000) - 2000;
    constexpr world::Heights kSome[] = {{}, {-64, 320}, {-1024, 1024}, {512, 768}};
    return {x, y, x + 1 + below(700), y + 1 + below(700), kSome[random() % std::size(kSome)]};
}

TEST(TilesOfArea, SeenFromAboveTheyShareABlock) {
    std::mt19937 random(1);
    for (int round = 0; round < 2000; ++round) {
        const BlockRect area = randomArea(random);
        const int zoom = static_cast<int>(random() % 13) + kMinZoom;
        const std::int64_t across = blocksAcross(zoom);
        const auto near = [&](std::int64_t block) {
            return static_cast<std::int32_t>(
                       std::floor(static_cast<double>(block) / static_cast<double>(across))) +
                   static_cast<std::int32_t>(random() % 5) - 2;
        };
        const MapTile tile{Layer::Day, zoom, near(area.x0), near(area.y1)};
        const bool shares = tile.x * across < area.x1 && (tile.x + 1) * across > area.x0 &&
                            tile.y * across < area.y1 && (tile.y + 1) * across > area.y0;
        ASSERT_EQ(shows(tile, area), shares) << zoom << " " << tile.x << " " << tile.y;
    }
}

// Points of the area, from the world's bottom to its top, by the formula of isometric.h.
TEST(TilesOfArea, SeenAskewTheyHaveAPointOfIt) {
    std::mt19937 random(2);
    int withPoints = 0, withoutPoints = 0;
    for (int round = 0; round < 12; ++round) {
        const BlockRect area = randomArea(random);
        for (const int zoom : {-3, 0, 2}) {
            const double size = 256 / std::exp2(zoom);
            std::set<std::pair<int, int>> touched;
            constexpr int kSteps = 60;
            for (int k = 0; k < kSteps * kSteps * kSteps; ++k) {
                const auto between = [](std::int64_t low, std::int64_t high, int step) {
                    return static_cast<double>(low) + (step + 0.5) / kSteps * static_cast<double>(high - low);
                };
                const double x = between(area.x0, area.x1, k % kSteps),
                             y = between(area.y0, area.y1, k / kSteps % kSteps),
                             z = between(area.heights.bottom, area.heights.top, k / kSteps / kSteps);
                touched.emplace(static_cast<int>(std::floor((-x - y) / size)),
                                static_cast<int>(std::floor(((y - x) / 2 - kIsometricHeight * z) / size)));
            }
            for (const MapTile& tile : tilesOf(area, std::span(&kAllLayers[4], 1), zoom, zoom)) {
                EXPECT_EQ(tile.layer, Layer::Isometric);
                const bool isTouched = touched.erase({tile.x, tile.y}) > 0;
                ++(isTouched ? withPoints : withoutPoints);
            }
            EXPECT_TRUE(touched.empty()) << "zoom " << zoom;
        }
    }
    // Some tiles show so small a corner of it that none of the points is there.
    EXPECT_LT(withoutPoints * 10, withPoints);
}

TEST(TilesOfArea, AreAllThatShowIt) {
    const BlockRect area{-300, 20, 260, 500};
    const std::vector<MapTile> tiles = tilesOf(area, kAllLayers, -4, 1);
    const std::set<MapTile> all(tiles.begin(), tiles.end());
    EXPECT_EQ(all.size(), tiles.size()) << "each once";
    for (const Layer layer : kAllLayers)
        for (int zoom = -4; zoom <= 1; ++zoom)
            for (int x = -20; x <= 20; ++x)
                for (int y = -20; y <= 20; ++y)
                    ASSERT_EQ(all.contains({layer, zoom, x, y}), shows({layer, zoom, x, y}, area));
    EXPECT_TRUE(std::ranges::is_sorted(tiles, {}, &MapTile::zoom)) << "the widest first";
    EXPECT_GE(countTiles(area, kAllLayers, -4, 1), static_cast<std::int64_t>(tiles.size()));
}

TEST(TilesOfArea, LayersOfAPlaceStandTogether) {
    const std::vector<MapTile> tiles = tilesOf({0, 0, 600, 600}, kAllLayers, 0, 0);
    int groups = 0;
    for (std::size_t k = 0; k + 3 < tiles.size() && tiles[k].layer != Layer::Isometric; k += 4) {
        ++groups;
        for (std::size_t n = 0; n < 4; ++n) {
            EXPECT_EQ(tiles[k + n].layer, kAllLayers[n]);
            EXPECT_EQ(tiles[k + n].x, tiles[k].x);
            EXPECT_EQ(tiles[k + n].y, tiles[k].y);
        }
    }
    EXPECT_EQ(groups, 9) << "three by three tiles of 256 pixels";
}

TEST(TilesOfArea, EndWithTheWorld) {
    const std::int64_t end = std::int64_t{1} << 31;
    for (const MapTile& tile : tilesOf({end - 100, end - 100, end, end}, kAllLayers, kMinZoom, kMaxZoom)) {
        EXPECT_TRUE(isInWorld(tile));
        EXPECT_TRUE(tile.layer == Layer::Isometric || (tile.x > 0 && tile.y > 0));
    }
    const BlockRect all =
        blocksOf({world::kMinChunk, world::kMinChunk, world::kMaxChunk + 1, world::kMaxChunk + 1}, {});
    EXPECT_EQ(all.x0, -end);
    EXPECT_EQ(all.y1, end);
    EXPECT_GT(countTiles(all, kAllLayers, kMinZoom, kMaxZoom), std::int64_t{1} << 52) << "no overflow";
}

TEST(TilesOfArea, PathsNameTheTile) {
    EXPECT_EQ(pathOf({Layer::Day, -2, 4, -7}), "tiles/day/-2/4/-7.png");
    EXPECT_EQ(pathOf({Layer::Isometric, 2, -1, 0}), "tiles/isometric/2/-1/0.png");
}

}  // namespace
}  // namespace terrane::map

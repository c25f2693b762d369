#include "terrane/map/map_tile.h"

#include <gtest/gtest.h>

#include <limits>
#include <unordered_set>

namespace terrane::map {
namespace {

constexpr std::int32_t kLowest = std::numeric_limits<std::int32_t>::min(),
                       kHighest = std::numeric_limits<std::int32_t>::max();

TEST(MapTile, LayersHaveNames) {
    for (int k = 0; k < kLayerCount; ++k) {
        const auto layer = static_cast<Layer>(k);
        EXPECT_EQ(layerNamed(nameOf(layer)), layer);
    }
    EXPECT_EQ(nameOf(Layer::Day), "day");
    EXPECT_EQ(layerNamed("isometric"), Layer::Isometric);
    for (const char* name : {"", "Day", "da", "day ", "days"}) EXPECT_FALSE(layerNamed(name)) << name;
}

TEST(MapTile, ZoomsHaveWidthsAndLevels) {
    EXPECT_EQ(blocksAcross(2), 64);
    EXPECT_EQ(blocksAcross(1), 128);
    EXPECT_EQ(blocksAcross(0), 256);
    EXPECT_EQ(blocksAcross(-3), 2048);
    EXPECT_EQ(blocksAcross(-10), 262144);
    EXPECT_EQ(levelOf(2), 0);
    EXPECT_EQ(levelOf(0), 0);
    EXPECT_EQ(levelOf(-10), 10);
}

// The world reaches from -2^31 to 2^31 - 1 in both directions.
TEST(MapTile, TheWorldEndsAtEveryZoom) {
    for (int zoom = kMinZoom; zoom <= kMaxZoom; ++zoom) {
        const auto end = static_cast<std::int32_t>((std::int64_t{1} << 31) / blocksAcross(zoom));
        for (const std::int32_t other : {-end, 0, end - 1}) {
            EXPECT_TRUE(isInWorld({Layer::Day, zoom, -end, other})) << zoom;
            EXPECT_TRUE(isInWorld({Layer::Biome, zoom, other, end - 1})) << zoom;
            EXPECT_FALSE(isInWorld({Layer::Day, zoom, end, other})) << zoom;
            EXPECT_FALSE(isInWorld({Layer::Night, zoom, other, -end - 1})) << zoom;
        }
        for (const std::int32_t far : {kLowest, kHighest}) {
            EXPECT_FALSE(isInWorld({Layer::Height, zoom, far, 0})) << zoom;
            EXPECT_FALSE(isInWorld({Layer::Isometric, zoom, 0, far})) << zoom;
        }
        EXPECT_TRUE(isInWorld({Layer::Isometric, zoom, 2 * end - 1, 0})) << zoom;
        EXPECT_FALSE(isInWorld({Layer::Isometric, zoom, 2 * end, 0})) << zoom;
    }
}

TEST(MapTile, NeighborsHaveHashesOfTheirOwn) {
    std::unordered_set<std::size_t> hashes;
    int count = 0;
    for (int layer = 0; layer < kLayerCount; ++layer)
        for (int zoom = kMinZoom; zoom <= kMaxZoom; ++zoom)
            for (int x = -8; x < 8; ++x)
                for (int y = -8; y < 8; ++y, ++count)
                    hashes.insert(MapTileHash{}({static_cast<Layer>(layer), zoom, x, y}));
    EXPECT_GT(hashes.size(), static_cast<std::size_t>(count * 99 / 100));
}

TEST(MapTile, TilesOfColumnsAreRoundedDown) {
    EXPECT_EQ(tileOf(0, 256), 0);
    EXPECT_EQ(tileOf(255, 256), 0);
    EXPECT_EQ(tileOf(256, 256), 1);
    EXPECT_EQ(tileOf(-1, 256), -1);
    EXPECT_EQ(tileOf(-256, 256), -1);
    EXPECT_EQ(tileOf(-257, 256), -2);
    EXPECT_EQ(tileOf(-(std::int64_t{1} << 40), 256), -(std::int64_t{1} << 32));
}

}  // namespace
}  // namespace terrane::map

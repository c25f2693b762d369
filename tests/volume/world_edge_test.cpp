// Areas at the four corners of the world. Under the sanitizers, an overflow ends the test.
#include <algorithm>
#include <cstdint>
#include <span>

#include "terrane/volume/areas.h"
#include "terrane/volume/read_surfaces.h"
#include "tests/support/default_heights.h"
#include "tests/volume/volume_fixture.h"

namespace terrane::volume {
namespace {

constexpr std::int64_t kEdge = std::int64_t{1} << 31;  // blocks are from -kEdge to kEdge - 1

struct AreaCorner {
    bool isHighX = false, isHighY = false;
};

// Of so many blocks, which end at the corner.
BlockArea areaAt(const AreaCorner& corner, std::int64_t side) {
    const auto first = [side](bool isHigh) { return isHigh ? kEdge - side : -kEdge; };
    const std::int64_t x = first(corner.isHighX), y = first(corner.isHighY);
    return {x, y, 0, x + side, y + side, world::kChunkHeight};
}

class AreaEdgeTest : public testing::TestWithParam<AreaCorner> {};

TEST_P(AreaEdgeTest, BlocksAreWrittenAndRead) {
    const auto world = openWorld("flat");
    const BlockArea area = areaAt(GetParam(), 20);
    ASSERT_TRUE(checkArea(area, {}));
    const std::vector<world::BlockId> before = blocksOf(*world, area);
    const world::BlockId sand = contentBlock("sand");
    EXPECT_EQ(std::ranges::count(before, sand), 0);
    const BlockArea top{area.x0, area.y0, 200, area.x1, area.y1, 201};
    const auto changed = writeArea(*world, top, {std::span(&sand, 1)}, {});
    ASSERT_TRUE(changed) << changed.error().message;
    EXPECT_EQ(*changed, 400);
    EXPECT_EQ(std::ranges::count(blocksOf(*world, area), sand), 400);
    const world::ChunkArea chunks = chunksOver(area);
    EXPECT_EQ(digestOf(*world, chunks, {}).value(), digestOf(*world, chunks, {}).value());
}

TEST_P(AreaEdgeTest, LightReachesTheLastColumn) {
    const auto world = openWorld("flat");
    const BlockArea area = areaAt(GetParam(), 18);
    std::vector<LightLevels> levels(static_cast<std::size_t>(area.blockCount()), LightLevels{99, 99, 99, 99});
    const auto read = readLight(*world, area, levels, {});
    ASSERT_TRUE(read) << read.error().message;
    forEachBlock(area, [&](std::int64_t, std::int64_t, std::int64_t z, std::size_t place) {
        if (z > 100) {
            ASSERT_EQ(levels[place][0], 15) << place;
        }
    });
}

TEST_P(AreaEdgeTest, SurfacesNearAndFar) {
    for (const char* generator : {"flat", "overworld"}) {
        const auto world = openWorld(generator);
        const BlockArea blocks = areaAt(GetParam(), 20);
        for (const int level : {0, 1, 8, world::kMaxLevel}) {
            const auto area = columnsOver(level, blocks.x0, blocks.y0, blocks.x1, blocks.y1);
            ASSERT_TRUE(area) << area.error().message;
            const auto count = static_cast<std::size_t>((area->x1 - area->x0) * (area->y1 - area->y0));
            std::vector<std::int16_t> heights(count, -99);
            std::vector<world::BlockId> ids(count);
            for (const SurfaceLayer layer : {SurfaceLayer::Top, SurfaceLayer::Ground}) {
                const auto read = readSurfaces(*world, *area, layer, {heights, ids}, {});
                ASSERT_TRUE(read) << generator << " " << level << ": " << read.error().message;
                EXPECT_GE(std::ranges::min(heights), 0) << generator << " " << level;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Corners, AreaEdgeTest,
                         testing::Values(AreaCorner{false, false}, AreaCorner{false, true},
                                         AreaCorner{true, false}, AreaCorner{true, true}));

TEST(AreaEdge, NothingLiesBeyond) {
    for (const std::int64_t less : {-1, 0, 1}) {
        const bool isIn = less >= 0;
        EXPECT_EQ(checkArea({kEdge - less - 1, 0, 0, kEdge - less, 1, 1}, {}).has_value(), isIn);
        EXPECT_EQ(checkArea({0, less - kEdge, 0, 1, less - kEdge + 1, 1}, {}).has_value(), isIn);
    }
    EXPECT_FALSE(checkArea({-kEdge, -kEdge, 0, kEdge, kEdge, 256}, {})) << "2^72 blocks";
    EXPECT_FALSE(checkArea({INT64_MIN, INT64_MIN, INT64_MIN, INT64_MAX, INT64_MAX, INT64_MAX}, {}));
}

}  // namespace
}  // namespace terrane::volume

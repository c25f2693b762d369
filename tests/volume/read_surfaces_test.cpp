#include "terrane/volume/read_surfaces.h"

#include <gmock/gmock.h>

#include "terrane/map/surface.h"
#include "terrane/volume/areas.h"
#include "tests/volume/volume_fixture.h"

namespace terrane::volume {
namespace {

struct Read {
    std::vector<std::int16_t> heights;
    std::vector<world::BlockId> blocks;
};

Read surfacesOf(OpenedWorld& world, const ColumnArea& area, SurfaceLayer layer = SurfaceLayer::Top) {
    const auto count = static_cast<std::size_t>((area.x1 - area.x0) * (area.y1 - area.y0));
    Read read{std::vector<std::int16_t>(count, -99), std::vector<world::BlockId>(count, 99)};
    const auto done = readSurfaces(world, area, layer, {read.heights, read.blocks}, {});
    EXPECT_TRUE(done) << done.error().message;
    return read;
}

TEST(ReadSurfaces, ColumnsCoverTheArea) {
    const auto area = columnsOver(3, -9, 0, 9, 8);
    ASSERT_TRUE(area);
    EXPECT_EQ(area->x0, -2);
    EXPECT_EQ(area->x1, 2);
    EXPECT_EQ(area->y0, 0);
    EXPECT_EQ(area->y1, 1);
    constexpr std::int64_t kEnd = std::int64_t{1} << 31;
    EXPECT_TRUE(columnsOver(15, -kEnd, -4096, kEnd, 4096));
    EXPECT_FALSE(columnsOver(0, -kEnd, -kEnd, kEnd, kEnd));
    EXPECT_FALSE(columnsOver(16, 0, 0, 1, 1));
    EXPECT_FALSE(columnsOver(-1, 0, 0, 1, 1));
    EXPECT_FALSE(columnsOver(0, 0, 0, 0, 1));
    EXPECT_FALSE(columnsOver(0, 0, 0, kEnd + 1, 1));
    EXPECT_FALSE(columnsOver(0, INT64_MIN, INT64_MIN, INT64_MAX, INT64_MAX));
}

TEST(ReadSurfaces, HeightsAreThoseOfTheGeneratorsChunks) {
    const auto world = openWorld("overworld");
    const map::SurfaceKinds kinds = map::surfaceKinds(contentBlocks());
    for (const int level : {0, 3}) {
        const ColumnArea area{level, -140, -5, 37, 130};
        for (const SurfaceLayer layer : {SurfaceLayer::Top, SurfaceLayer::Ground}) {
            const Read read = surfacesOf(*world, area, layer);
            std::map<world::ChunkPos, map::Surface> surfaces;
            int wrong = 0;
            std::size_t place = 0;
            for (std::int64_t y = area.y0; y < area.y1; ++y)
                for (std::int64_t x = area.x0; x < area.x1; ++x, ++place) {
                    world::ChunkPos pos = chunkAtBlock(x, y);
                    pos.level = static_cast<std::uint8_t>(level);
                    if (!surfaces.contains(pos))
                        surfaces.emplace(pos,
                                         map::surfaceOf((*world->generator(level))->generate(pos), kinds));
                    const auto& column = surfaces.at(pos)[static_cast<std::size_t>((x & 15) + 16 * (y & 15))];
                    const bool isTop = layer == SurfaceLayer::Top;
                    wrong += read.heights[place] != (isTop ? column.topZ : column.underZ) ||
                             read.blocks[place] != (isTop ? column.top : column.under);
                }
            EXPECT_EQ(wrong, 0);
        }
    }
}

TEST(ReadSurfaces, EditsShowAtAllLevels) {
    const auto world = openWorld("flat");
    const ColumnArea area{0, 0, 0, 64, 64};
    EXPECT_THAT(surfacesOf(*world, area).heights, testing::Each(80));
    const world::BlockId stone = contentBlock("stone");
    ASSERT_TRUE(writeArea(*world, {0, 0, 81, 64, 64, 120}, {std::span(&stone, 1)}, {}));
    EXPECT_THAT(surfacesOf(*world, area).heights, testing::Each(119));
    EXPECT_THAT(surfacesOf(*world, area).blocks, testing::Each(stone));
    EXPECT_THAT(surfacesOf(*world, {2, 0, 0, 16, 16}).heights, testing::Each(119));
}

TEST(ReadSurfaces, AColumnWithoutBlocksHasNoHeight) {
    const auto world = openWorld("flat");
    ASSERT_TRUE(writeArea(*world, {3, 4, 0, 4, 5, 256}, {std::span(&world::kAir, 1)}, {}));
    const Read read = surfacesOf(*world, {0, 3, 4, 5, 5});
    EXPECT_THAT(read.heights, testing::ElementsAre(noHeight({}), 80));
    EXPECT_THAT(read.blocks, testing::ElementsAre(world::kAir, contentBlock("grass")));
}

TEST(ReadBiomes, TheyAreThoseOfTheGenerator) {
    const auto world = openWorld("continents");
    const auto biomes = gen::Biomes::create("continents", contentBlocks(), kVolumeSeed);
    ASSERT_TRUE(biomes);
    for (const int level : {0, 3}) {
        const auto area = columnsOver(level, -300, -50, 1500, 1111).value();
        std::vector<std::uint8_t> read(static_cast<std::size_t>((area.x1 - area.x0) * (area.y1 - area.y0)));
        ASSERT_TRUE(readBiomes(*world, area, read, {}));
        std::map<world::ChunkPos, std::array<std::uint8_t, 256>> chunks;
        int wrong = 0;
        for (std::int64_t y = area.y0; y < area.y1; ++y)
            for (std::int64_t x = area.x0; x < area.x1; ++x) {
                world::ChunkPos pos = chunkAtBlock(x, y);
                pos.level = static_cast<std::uint8_t>(level);
                if (!chunks.contains(pos)) chunks.emplace(pos, biomes->of(pos));
                const auto column = static_cast<std::size_t>((x & 15) + 16 * (y & 15));
                wrong += chunks.at(pos)[column] !=
                         read[static_cast<std::size_t>((y - area.y0) * (area.x1 - area.x0) + x - area.x0)];
            }
        EXPECT_EQ(wrong, 0) << level;
        EXPECT_LT(*std::ranges::max_element(read), biomes->names().size());
        EXPECT_NE(*std::ranges::min_element(read), *std::ranges::max_element(read));
    }
}

TEST(ReadBiomes, OtherGeneratorsHaveNone) {
    const auto world = openWorld("overworld");
    std::vector<std::uint8_t> read(256);
    const auto done = readBiomes(*world, {0, 0, 0, 16, 16}, read, {});
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().code, base::ErrorCode::Unsupported);
    EXPECT_EQ(done.error().message, "the generator overworld has no biomes");
}

}  // namespace
}  // namespace terrane::volume

// Exports at the four corners of the world, and of boxes that reach from one end to the other. Under the
// sanitizers, an overflow ends the test.
#include <gmock/gmock.h>

#include <algorithm>
#include <limits>

#include "terrane/io/export_formats.h"
#include "terrane/io/loaded_square.h"
#include "terrane/io/open_session.h"
#include "tests/io/flat_world.h"
#include "tests/support/default_heights.h"

namespace terrane::io {
namespace {

constexpr std::int32_t kFirstBlock = std::numeric_limits<std::int32_t>::min(),
                       kLastBlock = std::numeric_limits<std::int32_t>::max();
constexpr int kBoxSide = 20;  // more than a chunk

struct ExportCorner {
    std::int32_t x = 0, y = 0;
};

class ExportEdgeTest : public testing::TestWithParam<ExportCorner> {
  protected:
    base::Result<ExportSource> source(const world::BlockBox& box) {
        ExportOptions from{flatLand(), {}, box, ""};
        return openExport(from);
    }
    static world::BlockBox boxAtCorner() {
        const auto first = [](std::int32_t edge) { return edge < 0 ? edge : edge - (kBoxSide - 1); };
        const std::int32_t x = first(GetParam().x), y = first(GetParam().y);
        return {{x, y, 0}, {x + (kBoxSide - 1), y + (kBoxSide - 1), world::kChunkHeight - 1}};
    }
    base::TempFolder folder_;
};

TEST_P(ExportEdgeTest, AllFormatsReachTheLastColumn) {
    const auto opened = source(boxAtCorner());
    ASSERT_TRUE(opened) << opened.error().message;
    const auto expectFile = [](const base::Result<ExportedFile>& file, const std::string& content) {
        ASSERT_TRUE(file) << file.error().message;
        EXPECT_THAT(file->content, testing::HasSubstr(content));
        EXPECT_GT(file->bytes, 0u);
    };
    expectFile(exportGlb(*opened, folder_ / "a.glb"), "faces");
    expectFile(exportSchematic(*opened, folder_ / "a.schem", ""), "20×20×256 blocks");
    expectFile(exportVox(*opened, folder_ / "a.vox"), "20×20×256 blocks");
    expectFile(exportNpy(*opened, folder_ / "a.npy"), "20×20×256 blocks");
    expectFile(exportNpyHeights(*opened, folder_ / "h.npy"), "20×20 columns");
    expectFile(exportPngHeights(*opened, folder_ / "h.png", 16), "20×20 columns");
    const auto volume = readVolume(*opened);
    ASSERT_TRUE(volume) << volume.error().message;
    const auto isAir = [&](std::uint16_t cell) { return volume->palette[cell].id == world::kAir; };
    EXPECT_FALSE(isAir(volume->cells.front()));
    EXPECT_FALSE(isAir(volume->cells[kBoxSide * kBoxSide - 1])) << "the last column";
}

// Dumps of light and quads read a border of one chunk, which may lie outside.
TEST_P(ExportEdgeTest, SquaresHaveABorderBeyond) {
    const WorldOptions options = flatLand();
    const auto content = loadContent(options);
    ASSERT_TRUE(content) << content.error().message;
    const auto generator = makeGenerator(options, *content);
    ASSERT_TRUE(generator) << generator.error().message;
    base::JobSystem jobs(2);
    const world::ChunkArea area = chunksOf(boxAtCorner());
    LoadedSquare square(squareOf(area, 0));
    const auto loaded = square.load(nullptr, *generator, jobs);
    ASSERT_TRUE(loaded) << loaded.error().message;
    for (int y = -1; y <= square.chunksY(); ++y)
        for (int x = -1; x <= square.chunksX(); ++x) {
            const bool isInside = world::isInWorld({area.x0 + x, area.y0 + y});
            EXPECT_EQ(square.chunk(x, y).block(world::blockIndex(0, 0, 0)) != world::kAir, isInside)
                << x << ", " << y;
        }
}

INSTANTIATE_TEST_SUITE_P(Corners, ExportEdgeTest,
                         testing::Values(ExportCorner{kFirstBlock, kFirstBlock},
                                         ExportCorner{kFirstBlock, kLastBlock},
                                         ExportCorner{kLastBlock, kFirstBlock},
                                         ExportCorner{kLastBlock, kLastBlock}));

// The product of two sides of 2^32 blocks has no 64-bit number.
TEST(ExportEdge, TheWholeWorldIsTooLarge) {
    const base::TempFolder folder;
    for (const world::BlockPos high :
         {world::BlockPos{kLastBlock, kLastBlock, 255}, world::BlockPos{kLastBlock, -1, 0}}) {
        ExportOptions from{flatLand(), {}, world::BlockBox{{kFirstBlock, kFirstBlock, 0}, high}, ""};
        const auto opened = openExport(from);
        ASSERT_TRUE(opened) << opened.error().message;
        for (const auto& heights :
             {exportNpyHeights(*opened, folder / "h.npy"), exportPngHeights(*opened, folder / "h.png", 8)}) {
            ASSERT_FALSE(heights);
            EXPECT_THAT(heights.error().message, testing::HasSubstr("columns are more than"));
        }
        for (const auto& volume : {exportNpy(*opened, folder / "a.npy"), exportVox(*opened, folder / "a.vox"),
                                   exportSchematic(*opened, folder / "a.schem", "")}) {
            ASSERT_FALSE(volume);
            EXPECT_THAT(volume.error().message, testing::HasSubstr("is larger than"));
        }
    }
}

}  // namespace
}  // namespace terrane::io

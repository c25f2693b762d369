#include "terrane/io/loaded_square.h"

#include <gtest/gtest.h>

#include "terrane/io/open_session.h"
#include "tests/io/flat_world.h"

namespace terrane::io {
namespace {

TEST(Squares, CoverAnAreaOnceInRows) {
    const world::ChunkArea area{-5, 3, -5 + kSquareChunks + 1, 3 + 2 * kSquareChunks};
    ASSERT_EQ(squareCount(area), 4);
    std::int64_t chunks = 0;
    for (std::int64_t k = 0; k < 4; ++k) chunks += squareOf(area, k).chunkCount();
    EXPECT_EQ(chunks, area.chunkCount());
    EXPECT_EQ(squareOf(area, 0).x1, squareOf(area, 1).x0);
    EXPECT_EQ(squareOf(area, 1).x1, area.x1);
    EXPECT_EQ(squareOf(area, 0).y1, squareOf(area, 2).y0);
    EXPECT_EQ(squareOf(area, 3).y1, area.y1);
}

TEST(LoadedSquare, HasABorderOfOneChunk) {
    const WorldOptions options = flatLand();
    const auto content = loadContent(options);
    ASSERT_TRUE(content) << content.error().message;
    const auto generator = makeGenerator(options, *content);
    ASSERT_TRUE(generator) << generator.error().message;
    base::JobSystem jobs(2);
    LoadedSquare square({2, -1, 4, 0});
    ASSERT_TRUE(square.load(nullptr, *generator, jobs));
    EXPECT_EQ(square.chunksX(), 2);
    EXPECT_EQ(square.chunksY(), 1);
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 2; ++x)
            EXPECT_NE(square.chunk(x, y).block(world::blockIndex(0, 0, 0)), world::kAir) << x << ", " << y;
}

}  // namespace
}  // namespace terrane::io

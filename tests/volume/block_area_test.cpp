#include "terrane/volume/block_area.h"

#include <gtest/gtest.h>

namespace terrane::volume {
namespace {

constexpr std::int64_t kWorldEnd = std::int64_t{1} << 31;

TEST(BlockArea, AnAreaOfTheWorldIsTaken) {
    EXPECT_TRUE(checkArea({0, 0, 0, 1, 1, 1}, {}));
    EXPECT_TRUE(checkArea({-kWorldEnd, -kWorldEnd, 0, -kWorldEnd + 2048, -kWorldEnd + 2048, 256}, {}));
    EXPECT_TRUE(checkArea({kWorldEnd - 1, kWorldEnd - 1, 255, kWorldEnd, kWorldEnd, 256}, {}));
    EXPECT_TRUE(checkArea({0, 0, 0, 1 << 15, 1 << 15, 1}, {}));
    EXPECT_TRUE(checkArea({0, 0, -64, 1, 1, 320}, {-64, 320}));
}

TEST(BlockArea, OthersAreRefused) {
    const BlockArea refused[] = {
        {0, 0, 0, 0, 1, 1},                                      // empty
        {5, 0, 0, 4, 1, 1},                                      // the wrong way round
        {0, 0, -1, 1, 1, 1},                                     // below
        {0, 0, 0, 1, 1, 257},                                    // above
        {-kWorldEnd - 1, 0, 0, 0, 1, 1},                         // beyond the edge
        {0, kWorldEnd, 0, 1, kWorldEnd + 1, 1},                  //
        {-kWorldEnd, -kWorldEnd, 0, kWorldEnd, kWorldEnd, 256},  // 2^72 blocks
        {0, 0, 0, (1 << 15) + 1, 1 << 15, 1},                    // a row too many
        {INT64_MIN, INT64_MIN, 0, INT64_MAX, INT64_MAX, 256},
    };
    for (const BlockArea& area : refused) {
        const auto checked = checkArea(area, {});
        ASSERT_FALSE(checked) << area.x0 << " " << area.x1;
        EXPECT_EQ(checked.error().code, base::ErrorCode::BadInput);
    }
    EXPECT_FALSE(checkArea({0, 0, -65, 1, 1, 0}, {-64, 320}));
    EXPECT_FALSE(checkArea({0, 0, 0, 1, 1, 321}, {-64, 320}));
    EXPECT_FALSE(checkArea({0, 0, 0, 1, 1, 1}, {512, 1024}));
}

TEST(BlockArea, ChunksOfAnArea) {
    const auto expect = [](const BlockArea& area, const world::ChunkArea& chunks) {
        const world::ChunkArea found = chunksOver(area);
        EXPECT_EQ(found.x0, chunks.x0);
        EXPECT_EQ(found.y0, chunks.y0);
        EXPECT_EQ(found.x1, chunks.x1);
        EXPECT_EQ(found.y1, chunks.y1);
    };
    expect({0, 0, 0, 16, 16, 1}, {0, 0, 1, 1});
    expect({-1, 15, 0, 17, 17, 1}, {-1, 0, 2, 2});
    expect({kWorldEnd - 1, -kWorldEnd, 0, kWorldEnd, -kWorldEnd + 1, 1},
           {world::kMaxChunk, world::kMinChunk, world::kMaxChunk + 1, world::kMinChunk + 1});
}

TEST(BlockArea, PartOfAChunk) {
    const ChunkPart part = partOf({-3, 5, 10, 20, 18, 12}, {0, 1});
    EXPECT_EQ(part.x0, 0);
    EXPECT_EQ(part.x1, 16);
    EXPECT_EQ(part.y0, 0);
    EXPECT_EQ(part.y1, 2);
    EXPECT_EQ(part.z0, 10);
    EXPECT_EQ(part.z1, 12);
    EXPECT_EQ(part.first, (16 - 5) * 23 + 3);
}

}  // namespace
}  // namespace terrane::volume

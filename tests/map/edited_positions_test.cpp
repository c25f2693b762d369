#include "terrane/map/surface_source.h"

#include <algorithm>
#include <random>
#include <stdexcept>
#include <vector>

#include "tests/map/map_fixture.h"

namespace terrane::map {
namespace {

using world::ChunkPos;

ChunkPos above(ChunkPos chunk, int level) {
    return {chunk.x >> level, chunk.y >> level, static_cast<std::uint8_t>(level)};
}

TEST(EditedPositions, HoldTheTilesAbove) {
    EditedPositions edited;
    EXPECT_TRUE(edited.add({-1, 1023}));
    EXPECT_EQ(edited.count(), 1u);
    EXPECT_TRUE(edited.contains({-1, 1023}));
    EXPECT_TRUE(edited.contains({-1, 511, 1}));
    EXPECT_TRUE(edited.contains({-1, 0, 10}));
    EXPECT_TRUE(edited.contains({-1, 0, 15}));
    EXPECT_FALSE(edited.contains({0, 0, 10}));
    EXPECT_FALSE(edited.contains({0, 0, 15}));
    EXPECT_FALSE(edited.contains({-1, 511}));
}

TEST(EditedPositions, AddSaysWhatIsNew) {
    EditedPositions edited;
    EXPECT_TRUE(edited.add({4, 4}));
    EXPECT_FALSE(edited.add({4, 4}));
    EXPECT_TRUE(edited.add({5, 4})) << "its tiles are there, it is not";
    EXPECT_FALSE(edited.add({5, 4}));
    EXPECT_EQ(edited.count(), 2u);
}

TEST(EditedPositions, AreThoseOfASlowSearch) {
    std::mt19937 random(1);
    EditedPositions edited;
    std::vector<ChunkPos> added = {{world::kMinChunk, world::kMaxChunk},
                                   {world::kMaxChunk, world::kMinChunk}};
    for (int k = 0; k < 100; ++k)
        added.push_back({static_cast<std::int32_t>(random() % 4000) - 2000,
                         static_cast<std::int32_t>(random() % 4000) - 2000});
    for (const ChunkPos chunk : added) edited.add(chunk);
    for (int level = 0; level <= world::kMaxLevel; ++level) {
        for (const ChunkPos chunk : added) {
            const ChunkPos tile = above(chunk, level);
            for (const ChunkPos near : world::chunksWithin(tile, 1)) {
                const bool isThere =
                    std::ranges::any_of(added, [&](ChunkPos other) { return above(other, level) == near; });
                ASSERT_EQ(edited.contains(near), isThere) << testing::PrintToString(near);
            }
        }
    }
}

TEST(EditedPositions, AreChunksAndTheTilesOfLevelsThatExist) {
    EditedPositions edited;
    EXPECT_THROW(edited.add({0, 0, 1}), std::invalid_argument);
    edited.add({0, 0});
    EXPECT_FALSE(edited.contains({0, 0, world::kMaxLevel + 1}));
    EXPECT_FALSE(edited.contains({0, 0, 255}));
}

}  // namespace
}  // namespace terrane::map

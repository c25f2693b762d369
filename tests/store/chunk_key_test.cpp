#include "terrane/store/chunks/chunk_key.h"

#include <gtest/gtest.h>

namespace terrane::store {
namespace {

TEST(ChunkKey, ReversibleAndOrdered) {
    for (int level = 0; level <= world::kMaxLevel; ++level) {
        const std::int32_t low = world::kMinChunk >> level, high = world::kMaxChunk >> level;
        for (const std::int32_t x : {low, -1, 0, 5, high})
            for (const std::int32_t y : {low, -7, 0, high}) {
                const world::ChunkPos pos{x, y, static_cast<std::uint8_t>(level)};
                EXPECT_EQ(posOf(keyOf(pos)), pos);
            }
    }
    EXPECT_EQ(keyOf({world::kMinChunk, world::kMinChunk}), 0);
    EXPECT_LT(keyOf({0, world::kMaxChunk}), keyOf({1, world::kMinChunk}));
    EXPECT_LT(keyOf({world::kMaxChunk, world::kMaxChunk, 0}), keyOf({0, 0, 1})) << "level by level";
}

TEST(ChunkKey, AsTheDocumentsSay) {
    EXPECT_EQ(keyOf({0, 0}), (std::int64_t{1} << 55) + (1 << 27)) << "docs/file-format-1.md";
    EXPECT_EQ(keyOf({0, 0, 3}), (std::int64_t{3} << 56) + (std::int64_t{1} << 55) + (1 << 27));
}

TEST(ChunkKey, WhatIsNoKeyIsOutsideTheWorld) {
    for (const std::int64_t key : {std::int64_t{-1}, std::int64_t{16} << 56, INT64_MAX, INT64_MIN})
        EXPECT_FALSE(world::isInWorld(posOf(key)));
    EXPECT_FALSE(world::isInWorld(posOf(std::int64_t{1} << 56))) << "beyond the edge of level 1";
}

}  // namespace
}  // namespace terrane::store

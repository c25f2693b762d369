// The number of a chunk in the tables of a save: its primary key, (level, x, y) in one integer. SQLite finds
// a row by such a key in one tree; with three columns it needs a second tree, or tables without row ids,
// which cut chunks of about 750 bytes in two (measured: saving takes 1.3 to 1.9 times as long, or loading 1.4
// times and a file 1.4 times as large).
#pragma once

#include <cstdint>

#include "terrane/world/coords.h"

namespace terrane::store {

constexpr int kLevelShift = 56, kXShift = 28;  // 4 bits of the level, then x and y from 0 in 28 bits each

// Keys of level 0 are from 0 to below this one.
constexpr std::int64_t kFirstTileKey = std::int64_t{1} << kLevelShift;

constexpr std::int64_t keyOf(world::ChunkPos pos) {
    return std::int64_t{pos.level} << kLevelShift | (std::int64_t{pos.x} - world::kMinChunk) << kXShift |
           (std::int64_t{pos.y} - world::kMinChunk);
}

// What no position has the number of gives a position outside the world.
constexpr world::ChunkPos posOf(std::int64_t key) {
    constexpr std::int64_t kEnd = std::int64_t{world::kMaxLevel + 1} << kLevelShift;
    if (key < 0 || key >= kEnd) return {world::kMaxChunk + 1, world::kMaxChunk + 1, 0};
    constexpr std::int64_t kMask = (std::int64_t{1} << kXShift) - 1;
    return {static_cast<std::int32_t>((key >> kXShift & kMask) + world::kMinChunk),
            static_cast<std::int32_t>((key & kMask) + world::kMinChunk),
            static_cast<std::uint8_t>(key >> kLevelShift)};
}

// What the checksum of a chunk begins with, so that it covers the key and the origin of its row too. Of saves
// of formats 1 and 2 it is kFormerSeed.
constexpr std::uint64_t checksumSeed(world::ChunkPos pos, bool isEdited) {
    return static_cast<std::uint64_t>(keyOf(pos)) * 2 + (isEdited ? 1 : 0);
}
constexpr std::uint64_t kFormerSeed = 0;

}  // namespace terrane::store

// The primary key of a chunk in the tables of a save: (level, x, y) in one integer. SQLite finds a row by an
// integer key in one B-tree. Three columns need a second tree, or tables without row ids, which split chunks
// of about 750 bytes. Measured: saving takes 1.3 to 1.9 times as long, or loading takes 1.4 times as long and
// a file is 1.4 times as large.
#pragma once

#include <cstdint>

#include "terrane/world/coords.h"

namespace terrane::store {

// 4 bits of level, 28 bits each of x and y, offset from kMinChunk.
constexpr int kLevelShift = 56, kXShift = 28;

// Keys of level 0 are in [0, kFirstTileKey).
constexpr std::int64_t kFirstTileKey = std::int64_t{1} << kLevelShift;

constexpr std::int64_t keyOf(world::ChunkPos pos) {
    return std::int64_t{pos.level} << kLevelShift | (std::int64_t{pos.x} - world::kMinChunk) << kXShift |
           (std::int64_t{pos.y} - world::kMinChunk);
}

// Returns the position of a key; an invalid key gives a position outside the world.
constexpr world::ChunkPos posOf(std::int64_t key) {
    constexpr std::int64_t kEnd = std::int64_t{world::kMaxLevel + 1} << kLevelShift;
    if (key < 0 || key >= kEnd) return {world::kMaxChunk + 1, world::kMaxChunk + 1, 0};
    constexpr std::int64_t kMask = (std::int64_t{1} << kXShift) - 1;
    return {static_cast<std::int32_t>((key >> kXShift & kMask) + world::kMinChunk),
            static_cast<std::int32_t>((key & kMask) + world::kMinChunk),
            static_cast<std::uint8_t>(key >> kLevelShift)};
}

// Returns the seed of a chunk's checksum, which therefore also covers the key and origin of its row. Saves of
// formats 1 and 2 use kLegacySeed.
constexpr std::uint64_t checksumSeed(world::ChunkPos pos, bool isEdited) {
    return static_cast<std::uint64_t>(keyOf(pos)) * 2 + (isEdited ? 1 : 0);
}
constexpr std::uint64_t kLegacySeed = 0;

}  // namespace terrane::store

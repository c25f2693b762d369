// The surface of a chunk of any level as seen from above: height and topmost block of its columns. Far
// shadows and light from the ground are computed from it (render/land_map.h). Plain values; any thread.
#pragma once

#include <array>
#include <cstdint>

#include "terrane/world/block_registry.h"
#include "terrane/world/chunk.h"
#include "terrane/world/tint.h"

namespace terrane::world {

struct LandTile {
    static constexpr std::size_t kColumns = static_cast<std::size_t>(kChunkSize) * kChunkSize;

    // By column, x + 16 y.
    std::array<std::uint16_t, kColumns> height{};  // blocks from z = 0 to the upper side of the topmost block
    std::array<BlockId, kColumns> ground{};        // the topmost block
    PackedColor tint = kNeutralTint;               // of the whole tile
};

// Crowns of trees and the surface of water count, plants do not. Columns without blocks have height 0.
LandTile landTileOf(const Chunk& chunk, const BlockRegistry& blocks);

}  // namespace terrane::world

// The chunks that a pass may read from.
#pragma once

#include <array>
#include <cstdint>

#include "terrane/world/coords.h"

namespace terrane::gen {

// The 3×3 chunks around `pos` by y, then x; coordinates wrap at the world's edge as those of blocks do.
inline std::array<world::ChunkPos, 9> chunksAround(world::ChunkPos pos) {
    const int bits = 4 + pos.level;  // of a chunk's width in blocks
    const auto wrap = [bits](std::int32_t v) {
        return static_cast<std::int32_t>(static_cast<std::uint32_t>(v) << bits) >> bits;
    };
    std::array<world::ChunkPos, 9> around;
    for (int n = 0; n < 9; ++n) {
        around[static_cast<std::size_t>(n)] = {wrap(pos.x + n % 3 - 1), wrap(pos.y + n / 3 - 1), pos.level};
    }
    return around;
}

}  // namespace terrane::gen

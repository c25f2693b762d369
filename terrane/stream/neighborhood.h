// A chunk and the eight around it.
#pragma once

#include <array>

#include "terrane/world/coords.h"

namespace terrane::stream {

// By y, then x: index x + 3 y, the chunk itself is 4. Some may lie beyond the world.
inline std::array<world::ChunkPos, 9> neighborhood(world::ChunkPos pos) {
    std::array<world::ChunkPos, 9> around;
    for (int n = 0; n < 9; ++n) {
        around[static_cast<std::size_t>(n)] = world::offsetBy(pos, n % 3 - 1, n / 3 - 1);
    }
    return around;
}

}  // namespace terrane::stream

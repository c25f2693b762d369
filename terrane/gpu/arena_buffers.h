// The buffers of an ArenaAllocator's arenas, for code that writes to addresses in them. A plain value.
#pragma once

#include <cstdint>
#include <vector>

#include "terrane/gpu/buffer.h"

namespace terrane::gpu {

// Address a lies in buffers[a / arenaSize], at unit a % arenaSize.
struct ArenaBuffers {
    std::vector<const Buffer*> buffers;  // one at least; they outlive this
    std::uint32_t arenaSize = UINT32_MAX;
};

}  // namespace terrane::gpu

// The event that tells browsers about edits. Plain values; any thread.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "terrane/world/coords.h"

namespace terrane::web {

// JSON: the event's number, and boxes of blocks with inclusive bounds, each with the level of the tiles that
// show it. With many chunks, boxes are enlarged to limit their number.
std::string editEvent(std::uint64_t number, std::span<const world::ChunkPos> chunks);

}  // namespace terrane::web

// What browsers are told of edits. Plain values; any thread.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "terrane/world/coords.h"

namespace terrane::web {

// JSON: the event's number, and boxes of blocks, each with the level of the tiles that show it, the ends
// included. Of many chunks some boxes are larger than what changed.
std::string editEvent(std::uint64_t number, std::span<const world::ChunkPos> chunks);

}  // namespace terrane::web

// Brings the light of visible chunks up to date after edits, on the world's thread.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "terrane/light/relight.h"
#include "terrane/stream/chunk_table.h"
#include "terrane/world/block_edit.h"
#include "terrane/world/world.h"

namespace terrane::stream {

constexpr std::uint16_t kAllBricks = 0xFFFF;  // of a chunk, a bit each

// The chunk and its neighbors with the local light that is known.
ChunkNeighborhood neighborhoodOf(const ChunkTable& table, const world::World& world, world::ChunkPos pos);

// `world` has the new blocks; each block is in `edits` once, with the id it had at first. Replaces
// ChunkRecord::light where it changes and returns the changed bricks. Chunks whose neighbors are all lit are
// relit incrementally; if a neighbor is not lit yet, so that light from beyond is not known, only the visible
// chunks around that edit are lit from scratch. The result equals that of lighting everything from scratch.
std::vector<light::LightChange> relightEdits(ChunkTable& table, const world::World& world,
                                             std::span<const world::BlockEdit> edits,
                                             const light::LightTable& lights);

}  // namespace terrane::stream

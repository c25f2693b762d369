// Schedules the first light and mesh of chunks: the third of the pipeline's schedulers
// (chunk_table.h).
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "terrane/light/relight.h"
#include "terrane/stream/chunk_table.h"
#include "terrane/world/changes/block_edit.h"
#include "terrane/world/coords.h"
#include "terrane/world/world.h"

namespace terrane::stream {

// Returns a chunk and the eight around it by y, then x: the index is x + 3 y, and the chunk itself is 4. Some
// may lie beyond the world.
inline std::array<world::ChunkPos, 9> neighborhood(world::ChunkPos pos) {
    std::array<world::ChunkPos, 9> around;
    for (int n = 0; n < 9; ++n) {
        around[static_cast<std::size_t>(n)] = world::offsetBy(pos, n % 3 - 1, n / 3 - 1);
    }
    return around;
}

// Removes and returns up to `limit` chunks in view to light: Visible ones to light again, then Loaded ones
// whose neighbors are loaded and deep enough (depth.h), most urgent first, which become Lighting.
std::vector<world::ChunkPos> popLightingRequests(ChunkTable& table, std::size_t limit);

// Finishes the lighting of a chunk: if it was Lighting, it becomes Visible. Returns false if blocks of it or
// of a neighbor, the mesh options or its open sides changed meanwhile, or if the view has left it: the result
// is outdated. Then a chunk that was Lighting is Loaded again, and a Visible one is lit once more.
bool finishLighting(ChunkTable& table, world::ChunkPos pos);

// Marks lighting in progress for a chunk and its neighbors as outdated, after blocks of the chunk changed.
void invalidateLighting(ChunkTable& table, world::ChunkPos pos);

// Requests the lighting of a chunk if it and its neighbors are loaded. Called after the chunk or a neighbor
// was loaded.
void requestLighting(ChunkTable& table, world::ChunkPos pos);

// Requests that a Visible chunk is lit and meshed again; it is shown as before until then.
void requestLightAgain(ChunkTable& table, world::ChunkPos pos);

// Brings the light of visible chunks up to date after edits, on the world's thread.

// Returns the chunk and its neighbors with the local light that is known.
ChunkNeighborhood neighborhoodOf(const ChunkTable& table, const world::World& world, world::ChunkPos pos);

// Updates the light of visible chunks after edits, on the world's thread. `world` has the new blocks; each
// block is in `edits` once, with the id it had at first. Replaces ChunkRecord::light where it changes and
// returns the changed bricks. Chunks whose neighbors are all lit are relit incrementally; if a neighbor is
// not lit yet, so that light from beyond is not known, only the visible chunks around that edit are lit from
// scratch. The result equals that of lighting everything from scratch.
std::vector<light::LightChange> relightEdits(ChunkTable& table, const world::World& world,
                                             std::span<const world::BlockEdit> edits,
                                             const light::LightTable& lights);

}  // namespace terrane::stream

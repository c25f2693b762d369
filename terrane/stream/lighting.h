// Schedules the first light and mesh of chunks: the second of the pipeline's three schedulers
// (chunk_table.h).
#pragma once

#include <cstddef>
#include <vector>

#include "terrane/stream/chunk_table.h"

namespace terrane::stream {

// Takes up to `limit` Loaded chunks in view whose neighbors are loaded, most urgent first, and makes them
// Lighting.
std::vector<world::ChunkPos> popLightingRequests(ChunkTable& table, std::size_t limit);

// Called when the lighting of a Lighting chunk is finished: makes it Visible. False if blocks of it or of a
// neighbor, the mesh options or its open sides changed meanwhile, or if the view has left it: the result is
// outdated, and the chunk is Loaded again.
bool finishLighting(ChunkTable& table, world::ChunkPos pos);

// Called when blocks of a chunk changed: lighting in progress for it and its neighbors is outdated.
void outdateLighting(ChunkTable& table, world::ChunkPos pos);

// Called when the chunk or a neighbor was loaded: it may be ready to be lit.
void considerLighting(ChunkTable& table, world::ChunkPos pos);

}  // namespace terrane::stream

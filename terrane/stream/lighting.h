// Which chunks are lit and meshed for the first time: the second of the pipeline's three schedulers
// (chunk_table.h).
#pragma once

#include <cstddef>
#include <vector>

#include "terrane/stream/chunk_table.h"

namespace terrane::stream {

// Up to `limit` Loaded chunks in view whose neighbors are loaded, most urgent first; they are Lighting then.
std::vector<world::ChunkPos> popLightingRequests(ChunkTable& table, std::size_t limit);

// Light and mesh of a Lighting chunk are there: it is Visible. False where blocks of it or of a neighbor
// changed meanwhile, or the view has left it: the result is outdated, and the chunk is Loaded again.
bool finishLighting(ChunkTable& table, world::ChunkPos pos);

// Blocks of a chunk changed: lighting in progress of it and its neighbors is outdated.
void outdateLighting(ChunkTable& table, world::ChunkPos pos);

// The chunk may be ready to be lit: it, or a neighbor, was loaded.
void considerLighting(ChunkTable& table, world::ChunkPos pos);

}  // namespace terrane::stream

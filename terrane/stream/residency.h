// Which chunks are loaded and unloaded: the first of the pipeline's three schedulers (chunk_table.h).
#pragma once

#include <cstddef>
#include <vector>

#include "terrane/stream/chunk_table.h"

namespace terrane::stream {

constexpr std::chrono::seconds kUnloadAfter{5};

// Moves the view (view_order.h). False where all is as before.
bool setView(ChunkTable& table, world::ChunkPos center, int distance, glm::vec2 direction = {});

// Somebody else needs a chunk that is in the world: it is loaded soon and kept for 5 s.
void requestChunk(ChunkTable& table, world::ChunkPos pos, Time now);

// Up to `limit` absent chunks that are to be loaded, most urgent first; they are Loading then.
std::vector<world::ChunkPos> popLoadRequests(ChunkTable& table, std::size_t limit);
// Nobody needs the chunk any more: its load may be cancelled. What was requested is always loaded.
bool mayCancelLoad(const ChunkTable& table, world::ChunkPos pos);
// A Loading chunk is Loaded, or will not come: then it is absent again.
void finishLoad(ChunkTable& table, world::ChunkPos pos, Time now);
void abandonLoad(ChunkTable& table, world::ChunkPos pos);

// Visible chunks that the view has left by more than one ring; they are Loaded then.
std::vector<world::ChunkPos> popHidden(ChunkTable& table);
// All visible chunks; they are Loaded then, and come again where the view has them.
std::vector<world::ChunkPos> popVisible(ChunkTable& table);
// Loaded chunks that nobody needed for 5 s. The caller saves them and erases their records.
std::vector<world::ChunkPos> findUnneeded(ChunkTable& table, Time now);
void unload(ChunkTable& table, world::ChunkPos pos);

}  // namespace terrane::stream

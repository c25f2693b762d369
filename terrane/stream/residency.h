// Schedules loading and unloading of chunks: the first of the pipeline's three schedulers (chunk_table.h).
#pragma once

#include <cstddef>
#include <vector>

#include "terrane/stream/chunk_table.h"
#include "terrane/world/changes/block_edit.h"

namespace terrane::stream {

// Edits that are not relit yet: each block once, as it was before the first of its edits.
struct PendingEdits {
    std::vector<world::BlockEdit> edits;
    world::BlockSet blocks;

    void add(const world::BlockEdit& edit) {
        if (blocks.insert(edit.pos)) edits.push_back(edit);
    }
};

constexpr std::chrono::seconds kUnloadAfter{5};

// Moves the view (view_order.h). False if nothing changed.
bool setView(ChunkTable& table, world::ChunkPos center, int distance, glm::vec2 direction = {});

// Requests a chunk of the world independently of the view: it is loaded soon and kept for 5 s.
void requestChunk(ChunkTable& table, world::ChunkPos pos, Time now);

// Takes up to `limit` absent chunks to load, most urgent first, and makes them Loading.
std::vector<world::ChunkPos> popLoadRequests(ChunkTable& table, std::size_t limit);
// Whether nobody needs the chunk any more, so that its load may be cancelled. Requested chunks are always
// loaded.
bool mayCancelLoad(const ChunkTable& table, world::ChunkPos pos);
// finishLoad() makes a Loading chunk Loaded, abandonLoad() makes it absent again.
void finishLoad(ChunkTable& table, world::ChunkPos pos, Time now);
void abandonLoad(ChunkTable& table, world::ChunkPos pos);

// Takes the visible chunks that the view has left by more than one ring, and makes them Loaded.
std::vector<world::ChunkPos> popHidden(ChunkTable& table);
// Takes all visible chunks and makes them Loaded; those in view are lit again.
std::vector<world::ChunkPos> popVisible(ChunkTable& table);
// Loaded chunks that nobody needed for 5 s. The caller saves and unloads them.
std::vector<world::ChunkPos> findUnneeded(ChunkTable& table, Time now);
void unload(ChunkTable& table, world::ChunkPos pos);

}  // namespace terrane::stream

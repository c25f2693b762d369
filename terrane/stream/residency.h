// Schedules loading and unloading of chunks: the first of the pipeline's schedulers (chunk_table.h).
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

constexpr std::chrono::seconds kUnloadDelay{5};

// Moves the view (view_order.h). Returns false if nothing changed.
bool setView(ChunkTable& table, world::ChunkPos center, int distance, glm::vec2 direction = {});

// Requests a whole chunk of the world independently of the view: it is loaded soon, made to its bottom, and
// stays loaded for 5 s.
void requestChunk(ChunkTable& table, world::ChunkPos pos, Time now);

// Removes and returns up to `limit` absent chunks to load, most urgent first, and makes them Loading.
std::vector<world::ChunkPos> popLoadRequests(ChunkTable& table, std::size_t limit);
// Returns whether the chunk is not needed any more, so that its load may be cancelled. Requested chunks are
// always loaded.
bool mayCancelLoad(const ChunkTable& table, world::ChunkPos pos);
// finishLoad() makes a Loading chunk Loaded, abandonLoad() makes it absent again.
void finishLoad(ChunkTable& table, world::ChunkPos pos, Time now, LoadedDepths depths = {});
void abandonLoad(ChunkTable& table, world::ChunkPos pos);

// Removes and returns the visible chunks outside the view by more than one ring, and makes them Loaded.
std::vector<world::ChunkPos> popHidden(ChunkTable& table);
// Removes and returns all visible chunks and makes them Loaded; chunks in view are lit again.
std::vector<world::ChunkPos> popVisible(ChunkTable& table);
// Returns the Loaded chunks that were not needed for 5 s. The caller saves and unloads them.
std::vector<world::ChunkPos> findUnneeded(ChunkTable& table, Time now);
void unload(ChunkTable& table, world::ChunkPos pos);

}  // namespace terrane::stream

// Schedules the meshing of visible chunks that changed: the fourth of the pipeline's schedulers
// (chunk_table.h). Sections that edits touched are meshed at once, before everything else; whole chunks, as
// when the options of meshing change, are meshed by jobs and shown as before until then.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "terrane/mesh/chunk_mesher.h"
#include "terrane/stream/chunk_table.h"
#include "terrane/stream/tile_table.h"
#include "terrane/world/blocks/block_registry.h"

namespace terrane::stream {

// These request meshes. They ignore chunks that are not Visible, which are meshed when they are lit.
void requestEditedMesh(ChunkTable& table, world::ChunkPos pos, mesh::MeshSectionSet meshSections);
void requestWholeMesh(ChunkTable& table, world::ChunkPos pos);

struct MeshRequest {
    world::ChunkPos pos;
    mesh::MeshSectionSet meshSections{};  // all if the chunk waited for a mesh job or was in one
};
// Removes and returns up to `limit` chunks that edits touched; the caller meshes them at once.
std::vector<MeshRequest> popEditedMeshes(ChunkTable& table, std::size_t limit);

struct MeshJob {
    world::ChunkPos pos;
    std::uint64_t number = 0;
};
// Removes and returns up to `limit` whole chunks for workers. Each job ends with finishMeshJob().
std::vector<MeshJob> popMeshJobs(ChunkTable& table, std::size_t limit);
// Finishes a job. Returns false if the result is outdated: the chunk was meshed since, or is not shown any
// more.
bool finishMeshJob(ChunkTable& table, const MeshJob& job);

// Returns the number of chunks that wait or are being meshed; some may count twice.
inline std::size_t pendingMeshes(const ChunkTable& table) {
    return table.editedMeshes.size() + table.otherMeshes.size() + table.meshJobCount;
}

// The next functions handle borders between chunks of level 0 and tiles. A chunk is meshed against its
// neighbors: if a tile with lower land is in a neighbor's place, a gap would be visible. So the sides of
// chunks are open there, as those of tiles are (mesh::meshTile): opaque faces go down to the bottom of the
// world.
// Returns the sides of a chunk beyond which tiles lie. A chunk that a tile replaces has none.
SideSet openSides(const TileView& view, world::ChunkPos pos);

// Returns the neighbor beyond an open side for meshing: all water, since faces of opaque blocks are drawn
// toward it and those of water are not. Air if there is no liquid.
world::ChunkPtr borderChunk(const world::BlockRegistry& blocks, world::Heights heights);

// Requests new meshes of chunks whose open sides changed.
void remeshBorders(ChunkTable& table, const TileView& before, const TileView& now);

}  // namespace terrane::stream

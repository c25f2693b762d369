// Schedules the meshing of visible chunks that changed: the third of the pipeline's three schedulers
// (chunk_table.h). Sections that edits touched are meshed at once, before everything else; whole chunks, as
// when the options of meshing change, are meshed by jobs and shown as before until then.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "terrane/stream/chunk_table.h"

namespace terrane::stream {

// Ignores chunks that are not Visible: they are meshed when they are lit.
void requestEditedMesh(ChunkTable& table, world::ChunkPos pos, mesh::MeshSectionSet meshSections);
void requestWholeMesh(ChunkTable& table, world::ChunkPos pos);

struct MeshRequest {
    world::ChunkPos pos;
    mesh::MeshSectionSet meshSections = 0;  // all if the chunk waited for a mesh job or was in one
};
// Takes up to `limit` chunks that edits touched; the caller meshes them at once.
std::vector<MeshRequest> popEditedMeshes(ChunkTable& table, std::size_t limit);

struct MeshJob {
    world::ChunkPos pos;
    std::uint64_t number = 0;
};
// Takes up to `limit` whole chunks for workers. Each job ends with finishMeshJob().
std::vector<MeshJob> popMeshJobs(ChunkTable& table, std::size_t limit);
// False if the result is outdated: the chunk was meshed since, or is not shown any more.
bool finishMeshJob(ChunkTable& table, const MeshJob& job);

// Chunks that wait or are being meshed; some may count twice.
inline std::size_t pendingMeshes(const ChunkTable& table) {
    return table.editedMeshes.size() + table.otherMeshes.size() + table.meshJobCount;
}

}  // namespace terrane::stream

// The changes on screen that the renderer has not received yet, one entry for each chunk. Edited chunks come
// first, then the rest in order of change.
#pragma once

#include <cstddef>
#include <deque>
#include <unordered_map>
#include <vector>

#include "terrane/stream/pipeline_types.h"

namespace terrane::stream {

class ChangeQueue {
  public:
    // Sets new light of a chunk, changed in `bricks`.
    void setLight(world::ChunkPos pos, light::ChunkLightPtr light, const world::SectionSet& bricks);
    // Sets new light that changed in all bricks.
    void setLight(world::ChunkPos pos, light::ChunkLightPtr light);
    // Sets new quads of `meshSections`. Other sections of a waiting mesh stay.
    void setMesh(world::ChunkPos pos, MeshPtr mesh, mesh::MeshSectionSet meshSections);
    // Requests that the receiver of the change makes the mesh.
    void requestMesh(world::ChunkPos pos);
    bool isMeshRequested(world::ChunkPos pos) const;
    // Marks the chunk as no longer on screen.
    void hide(world::ChunkPos pos);
    // Moves an edited chunk ahead of all that were not edited.
    void prioritize(world::ChunkPos pos);

    std::vector<ChunkChange> take(std::size_t limit);
    // Removes and returns only the chunks that are no longer on screen.
    std::vector<world::ChunkPos> takeHidden();
    std::size_t size() const { return changes_.size(); }

  private:
    ChunkChange& change(world::ChunkPos pos);

    std::unordered_map<world::ChunkPos, ChunkChange, world::ChunkPosHash> changes_;
    // They may have positions that were taken meanwhile; take() skips these.
    std::deque<world::ChunkPos> first_, others_;
};

}  // namespace terrane::stream

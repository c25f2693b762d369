// Changes on screen that were not taken yet, one entry for each chunk. Edited chunks come first, then the
// rest in order of change.
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
    void setLight(world::ChunkPos pos, light::ChunkLightPtr light, std::uint16_t bricks);
    // Sets new quads of `meshSections`. Other sections of a waiting mesh stay.
    void setMesh(world::ChunkPos pos, MeshPtr mesh, mesh::MeshSectionSet meshSections);
    // Asks the taker of the change to make the mesh.
    void requestMesh(world::ChunkPos pos);
    bool isMeshRequested(world::ChunkPos pos) const;
    // The chunk is no longer on screen.
    void hide(world::ChunkPos pos);
    // Moves an edited chunk ahead of all that were not edited.
    void putFirst(world::ChunkPos pos);

    std::vector<ChunkChange> take(std::size_t limit);
    // Takes only the chunks that are no longer on screen.
    std::vector<world::ChunkPos> takeHidden();
    std::size_t size() const { return changes_.size(); }

  private:
    ChunkChange& change(world::ChunkPos pos);

    std::unordered_map<world::ChunkPos, ChunkChange, world::ChunkPosHash> changes_;
    // May have positions that were taken meanwhile; take() skips them.
    std::deque<world::ChunkPos> first_, others_;
};

}  // namespace terrane::stream

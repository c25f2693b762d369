// What changed on screen and was not handed on yet, one entry a chunk: edited chunks come first, then the
// others in the order in which they changed.
#pragma once

#include <cstddef>
#include <deque>
#include <unordered_map>
#include <vector>

#include "terrane/stream/pipeline_types.h"

namespace terrane::stream {

class ChangeQueue {
  public:
    // New light of a chunk, in `bricks`.
    void setLight(world::ChunkPos pos, light::ChunkLightPtr light, std::uint16_t bricks);
    // New quads in `meshSections`. What waits stays, but for the mesh sections that are newer now.
    void setMesh(world::ChunkPos pos, MeshPtr mesh, mesh::MeshSectionSet meshSections);
    // Whoever takes the change makes the mesh.
    void askForMesh(world::ChunkPos pos);
    bool asksForMesh(world::ChunkPos pos) const;
    // The chunk is no longer on screen.
    void hide(world::ChunkPos pos);
    // An edit changed it: it comes before others.
    void putFirst(world::ChunkPos pos);

    std::vector<ChunkChange> take(std::size_t limit);
    // Those that are no longer on screen, before all others.
    std::vector<world::ChunkPos> takeHidden();
    std::size_t size() const { return changes_.size(); }

  private:
    ChunkChange& change(world::ChunkPos pos);

    std::unordered_map<world::ChunkPos, ChunkChange, world::ChunkPosHash> changes_;
    // Positions that were taken meanwhile are passed over.
    std::deque<world::ChunkPos> first_, others_;
};

}  // namespace terrane::stream

// The edited chunks of a world, and so the tiles above them that may be edited. add() on one thread; reading
// on any thread while nothing is added.
#pragma once

#include <array>
#include <span>
#include <unordered_set>
#include <vector>

#include "terrane/map/surface_source.h"
#include "terrane/world/coords.h"

namespace terrane::map {

class EditedPositions {
  public:
    // Adds a chunk of level 0. False if it was there.
    bool add(world::ChunkPos chunk);
    std::size_t count() const { return positions_.front().size(); }  // of level 0
    // Whether this is an edited chunk of level 0, or a tile with an edited chunk beneath it.
    bool contains(world::ChunkPos chunk) const;

    // The edited ones of these chunks, to be read from the store.
    std::vector<EditedChunk> among(std::span<const world::ChunkPos> chunks) const;

  private:
    std::array<std::unordered_set<world::ChunkPos, world::ChunkPosHash>, world::kMaxLevel + 1>
        positions_;  // by level
};

}  // namespace terrane::map

// Which chunks of a world are edited, and so which tiles above them may be. add() on one thread; any thread
// while nothing is added.
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
    // A chunk of level 0. False where it was there.
    bool add(world::ChunkPos chunk);
    std::size_t count() const { return positions_.front().size(); }  // of level 0
    // A chunk of level 0, or a tile of any level with an edited chunk beneath it.
    bool contains(world::ChunkPos chunk) const;

    // Those of these chunks that are edited, as the store has them.
    std::vector<EditedChunk> among(std::span<const world::ChunkPos> chunks) const;

  private:
    std::array<std::unordered_set<world::ChunkPos, world::ChunkPosHash>, world::kMaxLevel + 1>
        positions_;  // by level
};

}  // namespace terrane::map

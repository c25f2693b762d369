// Light sources of a chunk from its own blocks, before light spreads: opacities, emission and the daylight of
// its columns. It is a part of LocalLight (light_chunk.h); any thread may use it.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "terrane/light/brick.h"
#include "terrane/light/chunk_light.h"
#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/chunk.h"

namespace terrane::light {

// Opacity and emission of block types, by id. It is made once a session, immutable, shared by all threads.
class LightTable {
  public:
    explicit LightTable(const world::BlockRegistry& blocks);

    // Returns the opacity 0…15 of the block in each of the four components; unknown ids have that of
    // "missing".
    LightValue opacity(world::BlockId id) const { return entry(id).opacity; }
    // Returns the emission in red, green and blue, without daylight.
    LightValue emission(world::BlockId id) const { return entry(id).emission; }

  private:
    struct Entry {
        LightValue opacity, emission;
    };
    const Entry& entry(world::BlockId id) const { return entries_[id < entries_.size() ? id : missing_]; }

    std::vector<Entry> entries_;
    world::BlockId missing_;
};

// Sixteen bricks of a chunk. The function that fills it states who owns the values.
struct ChunkBricks {
    std::array<BrickView, world::kSectionsPerChunk> light, opacity;
};

// Fills bricks from number `lowest` on; those below stay empty. The pool owns the bricks that are not shared.
ChunkBricks findSources(const world::Chunk& chunk, const LightTable& table, BrickPool& pool, int lowest = 0);

}  // namespace terrane::light

// Light sources of a chunk from its own blocks, before light spreads: opacities, emission and the daylight of
// its columns. It is a part of LocalLight (light_chunk.h); any thread may use it.
#pragma once

#include <array>
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

// A brick of a chunk, or several with the same uniform light and opacity, one above the other.
struct BrickRun {
    int highest = 0, lowest = 0;  // numbers of their sections
    BrickView light, opacity;
};

// The daylight that comes down the columns of a chunk, x + 16 y.
struct Daylight {
    std::array<LightValue, world::kBlocksPerLayer> columns;
    bool isEven = true;  // the same in all columns

    Daylight() { columns.fill(kFullDaylight); }
    bool isDark() const { return isEven && columns[0] == kDark; }
};

// The bricks of a chunk from its top to its bottom. The function that fills them states who owns the values.
using ChunkBricks = std::vector<BrickRun>;

// Returns the sources of a chunk. The pool owns the bricks that are not shared.
ChunkBricks findSources(const world::Chunk& chunk, const LightTable& table, BrickPool& pool);

// The same down to the lowest brick that daylight enters straight from above. Below, the source is emission.
ChunkBricks findSunlitSources(const world::Chunk& chunk, const LightTable& table, BrickPool& pool);

// Finds the sections of a chunk that one can look into from above or from the side, section by section from
// the top: daylight enters them straight from above, or no block in them and in the section above dims light,
// as under an island in the sky or in a high hall.
class OpenSections {
  public:
    explicit OpenSections(const LightTable& table);
    // Takes the next section. Returns whether it is open.
    bool isOpen(const world::Section& section);

  private:
    const LightTable& table_;
    BrickPool pool_;
    Daylight daylight_;
    bool isClearAbove_ = false;
};

// Returns the number of the lowest open section of a chunk, as far down as it is made.
int lowestOpenSection(const world::Chunk& chunk, const LightTable& table);

BrickView emissionOf(const world::Section& section, const LightTable& table, BrickPool& pool);
BrickView opacityOf(const world::Section& section, const LightTable& table, BrickPool& pool);

}  // namespace terrane::light

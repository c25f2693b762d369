// Opacity and emission of block types, by id. Made once a session, immutable, shared by all threads.
#pragma once

#include <vector>

#include "terrane/light/light_value.h"
#include "terrane/world/block_registry.h"

namespace terrane::light {

class LightTable {
  public:
    explicit LightTable(const world::BlockRegistry& blocks);

    // Opacity 0…15 of the block in each of the four components; unknown ids have that of "missing".
    LightValue opacity(world::BlockId id) const { return entry(id).opacity; }
    // Red, green and blue; no daylight.
    LightValue emission(world::BlockId id) const { return entry(id).emission; }

  private:
    struct Entry {
        LightValue opacity, emission;
    };
    const Entry& entry(world::BlockId id) const { return entries_[id < entries_.size() ? id : missing_]; }

    std::vector<Entry> entries_;
    world::BlockId missing_;
};

}  // namespace terrane::light

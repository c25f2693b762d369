// Finds how the light sources of a chunk change with its blocks. Inside the module; any thread may use it.
#pragma once

#include <span>
#include <vector>

#include "terrane/light/light_sources.h"
#include "terrane/light/relight.h"

namespace terrane::light {

// A voxel whose opacity or source differs. A source includes the daylight that comes straight down.
struct SourceChange {
    world::BlockIndex index = 0;
    LightValue sourceBefore = 0, sourceAfter = 0;
    bool moreOpaque = false;  // than before
    bool isBlock = false;     // its block changed; false: only daylight from above did
};

// Returns the changed blocks and every voxel below them whose daylight from above differs.
std::vector<SourceChange> findSourceChanges(const world::Chunk& chunk, std::span<const BlockChange> changes,
                                            const LightTable& table);

}  // namespace terrane::light

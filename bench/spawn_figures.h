// What players of new worlds see: where they begin, and how much of the land around is in view. Used by
// bench_land.
#pragma once

#include <cstdint>
#include <vector>

#include "bench/land_figures.h"

namespace terrane::bench {

// By seed. The ground alone hides the view, in columns 16 blocks wide up to 2 km.
struct SpawnStatistics {
    int spawns = 0, onLand = 0;
    std::vector<float> seen;    // share of the area
    std::vector<float> relief;  // blocks from the lowest to the highest ground in view
};

void addSpawn(SpawnStatistics& s, const LandKind& kind, std::uint64_t seed);

}  // namespace terrane::bench

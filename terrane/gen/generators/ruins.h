// Ruins as shapes that generators stamp: walls of rooms, towers and columns from a grammar, broken by
// chance. Drawn once a process, on first use, the same on every machine. Any thread may call these functions.
#pragma once

#include <vector>

#include "terrane/gen/language/builder.h"

namespace terrane::gen::ruins {

struct RuinRecord {
    int first = -1, count = 0;  // numbers of the shapes
};

// Cached.
const std::vector<VoxelShape>& shapes();
RuinRecord record(GeneratorBuilder& g);
// Returns one of the shapes by a hash in 0…2^24−1.
Int shapeOf(const RuinRecord& ruins, Int hash);

}  // namespace terrane::gen::ruins

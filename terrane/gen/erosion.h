// An erosion filter: gullies and ridges that branch downhill, found for each column by itself, without
// simulation and without neighbors. Waves of one size run across the slope, so that their valleys run down
// it; each following octave is smaller and follows the slope that the last one left. After R. S. Johansen,
// Fast and Gorgeous Erosion Filter (2026), who builds on C. John and F. Westin; the formulas here are our
// own.
#pragma once

#include <string_view>

#include "terrane/gen/pass.h"

namespace terrane::gen {

struct Erosion {
    int size = 128;          // blocks: from gully to gully in the first octave
    int octaves = 5;         // each half as large
    float depth = 0.16f;     // of gullies, in sizes, on ground as steep as `fullSlope`
    float fullSlope = 0.6f;  // blocks a block, from which on gullies are whole
    float gain = 0.56f;      // depth of an octave by the one before
};

struct Eroded {
    Float height;  // blocks to add: at most 0 on ridges, less in gullies
    Float ridge;   // -1…1: in a gully … on a ridge, of the large octaves
};

// `slope`: of the ground before, blocks a block. `name` makes the seeds. `strength` 0…1, by column: 0 leaves
// the ground as it is. Octaves that columns are too wide for fade; what they would take off on average is
// taken off all the same, so that far land is as high as near land.
Eroded erode(Pass& p, std::string_view name, Vec2 slope, Float strength, const Erosion& erosion);

}  // namespace terrane::gen

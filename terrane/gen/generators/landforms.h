// Landforms that several generators have, for 2D passes. Heights are in blocks.
#pragma once

#include "terrane/gen/language/pass.h"

namespace terrane::gen::landforms {

// Returns a smooth staircase over a height: flat steps of `rise` blocks with steep risers.
Float terraces(Float height, float rise, float steepness);
// Returns table mountains with steep sides, and canyons between them, above the plain: 4…82.
Float tables(Pass& p);
// Returns crests across the wind, which comes from the west; steep in the lee: up to 18.
Float dunes(Pass& p);
// Returns towers with steep sides and round tops: up to 67.
Float towers(Pass& p);

}  // namespace terrane::gen::landforms

// The inner loops of the solver in SIMD, for the best instruction set of the machine. Only this module
// includes it.
//
// A row of 16 voxels is handled at once, all four components of each: 64 levels.
#pragma once

#include <array>

#include "terrane/light/light_field.h"

namespace terrane::light {

// Daylight that reaches each column (x + 16 y) from above, in bits 12–15.
using DaylightColumns = std::array<LightValue, world::kChunkSize * world::kChunkSize>;

// Propagates daylight down through a brick: writes columns | emission to `light` for each voxel, where
// `emission` is a brick too (it may be `light` itself). `columns` return the daylight that enters the brick
// below.
void propagateSunlight(const LightValue* opacity, const LightValue* emission, DaylightColumns& columns,
                       LightValue* light);

// Raises the marked rows of a brick, and the rows of the brick affected by them, until every voxel is at
// least each neighbor less 1 + its opacity. Marks the affected rows of the bricks beside it.
void raiseBrick(LightField& field, int index);

// Raises brick after brick until no row is marked.
void raiseLight(LightField& field);

// Runs the decrease queue in a brick: `light` has the levels to remove. A level of `before` that exceeds its
// source and equals the level that a removed neighbor gave is removed too. Starts from the marked rows, and
// marks the affected rows of the bricks beside it.
void decreaseBrick(LightField& field, int index);

// Sets light = source where `decreased` is not 0, else before, for whole bricks. `light` may be `decreased`.
void replaceDecreased(const LightValue* decreased, const LightValue* source, const LightValue* before,
                      LightValue* light);

}  // namespace terrane::light

// Landforms and what is below them, which several generators have. Heights are in blocks.
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

// Returns the square of the distance from block 0, 0, where new worlds begin, in radii: exact up to 1, more
// beyond.
Float fromOrigin(Pass& p, int radius);

// Returns the block of the beds of rivers and lakes. `patches` and `spots`: noise of about 30 and 8 blocks.
Block riverBed(Pass& p, Float patches, Float spots);

// These are for 3D passes.

// Returns whether this voxel is in a winding tunnel: two noises are both near 0. `where`, above -0.05: how
// wide tunnels are here.
Bool isTunnel(Pass& p, Float where);
// Returns the rock with veins of ore where it is deep enough.
Block withOre(Pass& p, Block rock, Bool isDeep);

// Shares of the floor of caves, each with those before it.
struct CaveLife {
    int crystalsBelow;  // z
    float crystals, glowingMushrooms, mushrooms;
};
// Writes a pass that grows it on the floors of caves below `caveTop`.
void growCaveLife(Pass& p, Int caveTop, const CaveLife& life);

}  // namespace terrane::gen::landforms

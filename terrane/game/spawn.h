// Where a new world begins: on open, dry ground with something to look at.
#pragma once

#include "terrane/gen/generator.h"
#include "terrane/world/block_registry.h"
#include "terrane/world/pose.h"

namespace terrane::game {

// The same for the same world. Generates up to some hundred chunks around 0,0, a tenth of a second; where
// none of them is pleasant, a place above 0,0.
world::Pose findSpawn(const gen::Generator& generator, const world::BlockRegistry& blocks);

}  // namespace terrane::game

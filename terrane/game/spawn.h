// Where a new world begins: on open, dry ground with something to look at; and where a player goes on who
// fell out of it.
#pragma once

#include <optional>

#include "terrane/gen/generator.h"
#include "terrane/world/block_registry.h"
#include "terrane/world/pose.h"
#include "terrane/world/world.h"

namespace terrane::game {

// The same for the same world. Generates up to some hundred chunks around 0,0, a tenth of a second; where
// none of them is pleasant, a place above 0,0.
world::Pose findSpawn(const gen::Generator& generator, const world::BlockRegistry& blocks);

// For a player whose eyes are below the world: on the highest block of the same column. None where it is not
// below, where the chunk is not loaded, and where the column is empty.
std::optional<world::Pose> backOnSurface(const world::World& world, const world::BlockRegistry& blocks,
                                         const world::Pose& pose);

}  // namespace terrane::game

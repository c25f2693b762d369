// Finds the spawn of a new world, on open, dry ground with a view, and a position for a player who fell out
// of the world.
#pragma once

#include <optional>
#include <span>

#include "terrane/game/session.h"
#include "terrane/gen/generator.h"
#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/character.h"
#include "terrane/world/pose.h"
#include "terrane/world/world.h"

namespace terrane::game {

// Returns the start of a new world, which is the same for the same world: of dry, flat places near 0,0 the
// first with an open view. The player looks where it is most open. It generates up to some hundred chunks
// around 0,0, in a tenth of a second; if none of them is suitable, the place is above 0,0.
world::Pose findSpawn(const gen::Generator& generator, const world::BlockRegistry& blocks);

// Returns the free place nearest to `spawn`: on firm ground, not in a block or liquid, and apart from the
// bodies in `taken`. It sees edits, also in chunks that are not loaded. On the same level as the spawn within
// some blocks, so that players appear inside of a house there, else on the surface. If there is no ground at
// all, such as above a sea, the place is at the spawn's height.
world::Pose freePlaceNear(const world::Pose& spawn, Session& session, std::span<const world::Aabb> taken);

// Returns the pose on the highest block of the column for a player whose eyes are below the world. Returns
// nothing if it is not below, if the chunk is not loaded or if the column is empty.
std::optional<world::Pose> poseOnSurface(const world::World& world, const world::BlockRegistry& blocks,
                                         const world::Pose& pose);

}  // namespace terrane::game

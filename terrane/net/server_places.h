// Places with names, in the world's metadata: maps show them (terrane/web). Players name where they stand,
// operators any place. On the server's thread.
#pragma once

#include <string>
#include <string_view>

#include "terrane/game/places.h"
#include "terrane/net/server_state.h"

namespace terrane::net {

// Each answers with a line for who asked. Servers of the same world hear of it.
//
// A place of that name moves where `mayMove`; else the name is taken.
std::string markPlace(ServerState& server, std::string_view name, const world::Pose& pose, bool mayMove);
std::string unmarkPlace(ServerState& server, std::string_view name);
std::string placeList(ServerState& server);

// A player says "/mark NAME". Guests may not; operators alone move what has a name.
std::string markHere(ServerState& server, const ServerClient& client, std::string_view name);

// As another server did.
void applyPlaceChange(ServerState& server, const PlaceChange& change);
// Takes all names of places that the world's store has now: changes of other servers may have been missed.
// Own ones that wait to be saved are newer.
void takeAllPlaces(ServerState& server, const std::vector<game::Place>& places);
// Tells other servers of own changes once the store has them: who misses that finds them there.
void tellSavedPlaces(ServerState& server);

}  // namespace terrane::net

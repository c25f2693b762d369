// Messages of players other than block changes: movement, view, chat, visibility of other players. On the
// server's thread.
#pragma once

#include <string>
#include <string_view>

#include "terrane/game/places.h"
#include "terrane/net/server/server_state.h"

namespace terrane::net {

// Named places in the world's metadata, shown on maps (terrane/web). Players mark their own position,
// operators any position. On the server's thread.
// Each returns a line for the player who asked. Other servers of the world are told.
//
// markPlace() moves an existing place.
std::string markPlace(ServerPlaces& places, std::string_view name, const world::Pose& pose);
std::string unmarkPlace(ServerPlaces& places, std::string_view name);
std::string placeList(const ServerPlaces& places);

// The chat commands "/mark NAME" and, for players who are no operators, "/unmark NAME". Guests may not use
// them; only operators may move or remove places of others. Players have a share of the places
// (place_owners.h).
std::string markHere(ServerPlaces& places, const ServerClient& client, std::string_view name);
std::string unmarkOwn(ServerPlaces& places, const ServerClient& client, std::string_view name);

// Applies a change of another server.
void applyPlaceChange(ServerPlaces& places, const PlaceChange& change);
// Replaces all places by those of the world's store, since changes of other servers may have been missed. Own
// changes that wait to be saved are kept.
void replacePlaces(ServerPlaces& places, const std::vector<game::Place>& stored);
// Tells other servers of own changes once the store has them, so a server that misses the message finds them
// there.
void publishSavedPlaces(ServerPlaces& places);

// Handles a message of a playing client.
void onPlayerMessage(ServerState& server, ServerClient& client, ClientMessage message);

// Tells all players who appears, moves and disappears. Call in each tick.
void broadcastVisibility(ServerClients& clients);
// Sends the time and pings; disconnects clients that do not answer. Call in each tick.
void sendKeepAlives(ServerClients& clients, const game::DayClock& clock);

}  // namespace terrane::net

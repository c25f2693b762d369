// Messages of players other than block changes: movement, view, chat, visibility of other players. On the
// server's thread.
#pragma once

#include "terrane/net/server_state.h"

namespace terrane::net {

// Handles a message of a playing client.
void onPlayerMessage(ServerState& server, ServerClient& client, ClientMessage message);

// Tells all players who appears, moves and disappears. Call in each tick.
void tellSight(ServerState& server);
// Sends the time and pings; disconnects clients that do not answer. Call in each tick.
void keepInTouch(ServerState& server);

}  // namespace terrane::net

// What players say and do besides changing blocks: they move, look, talk and are seen by others. On the
// server's thread.
#pragma once

#include "terrane/net/server_state.h"

namespace terrane::net {

// A message of a client that plays.
void onPlayerMessage(ServerState& server, ServerClient& client, ClientMessage message);

// Who appears, moves and is gone, to all. In each tick.
void tellSight(ServerState& server);
// The time, questions whether clients are there, and those who do not answer. In each tick.
void keepInTouch(ServerState& server);

}  // namespace terrane::net

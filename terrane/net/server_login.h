// How a connection becomes a player: Hello, Login, Proof (docs/protocol.md), each answered or refused. On the
// server's thread.
#pragma once

#include "terrane/net/server_state.h"

namespace terrane::net {

// What the server offers its world by. Generates the sample chunks: up to 0.3 s.
void prepareLogin(ServerState& server, std::uint64_t random);

// A message of a client that does not play yet.
void onLoginMessage(ServerState& server, ServerClient& client, const ClientMessage& message);
// Passwords that were compared; who took too long. In each tick.
void updateLogins(ServerState& server);

}  // namespace terrane::net

// The login of a connection: Hello, Login, Proof (docs/protocol.md), each answered or refused. On the
// server's thread.
#pragma once

#include "terrane/net/server_state.h"

namespace terrane::net {

// Prepares the data of WorldOffer. Generates the sample chunks: up to 0.3 s.
void prepareLogin(ServerState& server, std::uint64_t random);

// Handles a message of a client that is not playing yet.
void onLoginMessage(ServerState& server, ServerClient& client, const ClientMessage& message);
// Finishes password checks and refuses logins that took too long. Call in each tick.
void updateLogins(ServerState& server);

}  // namespace terrane::net

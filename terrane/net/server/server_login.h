// The login of a connection: Hello, Login, Proof (docs/protocol.md), each answered or refused. On the
// server's thread.
#pragma once

#include "terrane/net/server/server_state.h"

namespace terrane::net {

// Handles a message of a client that is not playing yet.
void onLoginMessage(ServerState& server, ServerClient& client, const ClientMessage& message);
// Finishes password checks and refuses logins that took too long. Call in each tick.
void updateLogins(ServerClients& clients, ServerPassword& password, const ServerOffer& offer,
                  base::JobSystem& jobs);

}  // namespace terrane::net

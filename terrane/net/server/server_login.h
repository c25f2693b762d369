// The login of a connection: Hello, Login, Proof (docs/protocol.md), each answered or refused. On the
// server's thread.
#pragma once

#include <memory>

#include "terrane/net/server/server_state.h"

namespace terrane::net {

// The content packs of a server's world, sent to clients that lack them. On the server's thread.
// Sends the requested part. Each pack is sent once per connection, from beginning to end; a request out of
// order is refused.
void onAskPack(ServerState& server, ServerClient& client, const AskPack& ask);

// Login time of a client that downloads packs, in addition to ServerSettings::loginWithin.
std::chrono::milliseconds timeForPacks(const ServerClient& client);

// Prepares the data of WorldOffer. Generates the sample chunks: up to 0.3 s.
void prepareLogin(ServerState& server, std::uint64_t random);

// Handles a message of a client that is not playing yet.
void onLoginMessage(ServerState& server, ServerClient& client, const ClientMessage& message);
// Finishes password checks and refuses logins that took too long. Call in each tick.
void updateLogins(ServerState& server);

}  // namespace terrane::net

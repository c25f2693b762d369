// The content packs of a server's world, sent to clients that lack them. On the server's thread.
#pragma once

#include <memory>

#include "terrane/net/server_state.h"

namespace terrane::net {

// Sends the requested part. Each pack is sent once per connection, from beginning to end; a request out of
// order is refused.
void onAskPack(ServerState& server, ServerClient& client, const AskPack& ask);

// Login time of a client that downloads packs, in addition to ServerSettings::loginWithin.
std::chrono::milliseconds timeForPacks(const ServerClient& client);

}  // namespace terrane::net

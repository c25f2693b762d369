// The content packs of a server's world, which clients may lack. On the server's thread.
#pragma once

#include <memory>

#include "terrane/net/server_state.h"

namespace terrane::net {

// Answers with the part that the client asks for. Each pack is sent once to a connection, from its beginning
// to its end; whoever asks in another order is sent away.
void onAskPack(ServerState& server, ServerClient& client, const AskPack& ask);

// How much longer than ServerSettings::loginWithin the login of a client may take, which gets packs.
std::chrono::milliseconds timeForPacks(const ServerClient& client);

}  // namespace terrane::net

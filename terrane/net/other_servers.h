// The other servers of a shared world: their players, where they are reached, and what servers that are gone
// left to save. On the server's thread.
#pragma once

#include <vector>

#include "terrane/net/server_state.h"

namespace terrane::net {

void takePoses(ServerState& server, const SharedNews& news);
// Tells them where own players are, some times a second.
void tellPosesIfDue(ServerState& server);
// All others that are there, or gone without saving. Tells clients of a change.
void takeServers(ServerState& server, std::vector<OtherServer> servers);
// Loads and saves chunks that a server which is gone changed and did not save.
void saveOrphans(ServerState& server);
// As a client is told.
Servers otherServers(const ServerState& server);

}  // namespace terrane::net

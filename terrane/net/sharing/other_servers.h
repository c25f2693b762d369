// The other servers of a shared world: their players and addresses, and the unsaved chunks of servers that
// are gone. On the server's thread.
#pragma once

#include <vector>

#include "terrane/net/server/server_state.h"

namespace terrane::net {

void applyPoses(ServerState& server, const SharedChanges& changes);
// Sends the poses of own players to the other servers a few times per second.
void publishPosesIfDue(ServerState& server);
// Takes the list of all other servers that run, or stopped without saving. Tells clients of changes.
void setOtherServers(ServerState& server, std::vector<OtherServer> servers);
// Loads and saves the chunks that a stopped server changed and did not save.
void saveOrphans(ServerState& server);
// The list of servers as sent to clients.
Servers otherServers(const ServerState& server);

}  // namespace terrane::net

// The other servers of a shared world: their players and addresses, and the unsaved chunks of servers that
// are gone. On the server's thread.
#pragma once

#include <span>
#include <vector>

#include "terrane/net/server/server_state.h"

namespace terrane::net {

void applyPoses(ServerClients& clients, std::span<const OtherPlayer> poses);
// Sends the poses of own players to the other servers a few times per second.
void publishPosesIfDue(SharingState& sharing, const ServerClients& clients);
// Takes the list of all other servers that run, or stopped without saving. Tells clients of changes.
void setOtherServers(SharingState& sharing, ServerClients& clients, std::vector<OtherServer> servers);
// Loads and saves the chunks that a stopped server changed and did not save.
void saveOrphans(SharingState& sharing, stream::ChunkPipeline& pipeline);
// The list of servers as sent to clients.
Servers otherServers(std::span<const OtherServer> servers);

}  // namespace terrane::net

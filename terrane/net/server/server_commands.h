// Commands of players that change blocks. A command waits until its chunks are loaded, runs in order through
// the session, which checks it, and is answered once its edits are in the history. On the server's thread.
#pragma once

#include "terrane/net/server/server_state.h"

namespace terrane::net {

void enqueueCommand(ServerState& server, ServerClient& client, WaitingCommand command);
// An invalid structure changes nothing.
void takePlace(ServerState& server, ServerClient& client, const Place& place);
// Runs the commands that are ready. Call in each tick.
void runCommands(ServerState& server);
// Sends the results of commands whose changes are durable. Call after the changes were sent.
void sendDecisions(ServerState& server);

}  // namespace terrane::net

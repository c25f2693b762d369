// What players do to blocks: their commands wait until the chunks are loaded, run in their order through the
// session, which checks them, and are decided on once the history has what they changed. On the server's
// thread.
#pragma once

#include "terrane/net/server_state.h"

namespace terrane::net {

void takeCommand(ServerState& server, ServerClient& client, WaitingCommand command);
// What is no structure changes nothing.
void takePlace(ServerState& server, ServerClient& client, const Place& place);
// Runs what can run. In each tick.
void runCommands(ServerState& server);
// Tells what became of commands, as far as their changes are durable. After clients were told of the changes.
void tellDecisions(ServerState& server);

}  // namespace terrane::net

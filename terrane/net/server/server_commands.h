// Commands of players that change blocks. A command waits until its chunks are loaded, runs in order through
// the session, which checks it, and is answered once its edits are in the history. On the server's thread.
#pragma once

#include <cstdint>

#include "terrane/net/server/server_state.h"

namespace terrane::net {

// Disconnects a client that sends too many commands.
void enqueueCommand(ServerClients& clients, ServerClient& client, game::Session& session,
                    WaitingCommand command);
// The command to place a structure; an invalid structure becomes an empty one, which changes nothing.
Build buildFrom(const Place& place, ClientBuckets& buckets, const world::BlockRegistry& blocks, Time now);
// Runs the commands that are ready, whose edits the session's listener adds to the history. Call in each
// tick.
void runCommands(ServerClients& clients, game::Session& session, const ServerHistory& history);
// Sends the results of commands whose writes are durable, up to this one. Call after the changes were sent.
void sendDecisions(ServerClients& clients, std::uint64_t durable);

}  // namespace terrane::net

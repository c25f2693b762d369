// What is said to clients, and how they leave. On the server's thread.
#pragma once

#include <string>

#include "terrane/net/server_state.h"

namespace terrane::net {

// Puts a message into the client's outgoing bytes; nothing for one that is sent away.
void send(ServerClient& client, const ServerMessage& message);
// A message that is encoded once for several clients.
void sendEncoded(ServerClient& client, ByteView message);

// Lines to one player, or to all who play. No name: the server speaks. Any bytes may be in them; what a
// message cannot have is escaped, and long lines are cut.
void say(ServerClient& client, const std::string& text);
// The time of day on this server.
void setTimeHere(ServerState& server, double timeDay);
// To the players of this server alone, and to those of all.
void sayHere(ServerState& server, const std::string& name, const std::string& text);
void sayToAll(ServerState& server, const std::string& name, const std::string& text);

// Tells the client why (any bytes), and sends it away: nothing that it says counts any more.
void refuse(ServerState& server, ServerClient& client, Refusal why, const std::string& reason);
// It plays no longer: its place is kept, others hear of it.
void leave(ServerState& server, ServerClient& client);

// Null where nobody of that number or name plays.
ServerClient* playingClient(ServerState& server, game::PlayerId player);
ServerClient* playingClient(ServerState& server, std::string_view name);

// use(ServerClient&) for each who plays.
template <class Use>
void forEachPlaying(ServerState& server, Use use) {
    for (auto& [id, client] : server.clients)
        if (client.stage == ServerClient::Stage::Playing) use(client);
}

}  // namespace terrane::net

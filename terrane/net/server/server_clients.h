// Messages to clients, and disconnecting them. On the server's thread.
#pragma once

#include <string>

#include "terrane/game/session.h"
#include "terrane/net/server/server_state.h"

namespace terrane::net {

// Appends a message to the client's outgoing bytes; drops it if the client is being disconnected.
void send(ServerClient& client, const ServerMessage& message);
// Sends a message that was encoded once for several clients.
void sendEncoded(ServerClient& client, ByteView message);

// Sends lines of chat to one player; the sender is the server. `text` may contain any bytes: what a message
// cannot contain is escaped, and long lines are cut.
void say(ServerClient& client, const std::string& text);
// The time of day, as sent to clients.
Clock clockOf(const game::DayClock& clock);
// The mode and the items of a player, likewise.
Items itemsOf(const game::Session& session, game::PlayerId player);
// Sets the time of day on this server and tells its players.
void setTimeHere(ServerClients& clients, game::DayClock& clock, double timeDay);
// Sends chat lines to the players of this server, or of all servers. An empty name means the server.
void broadcastChatLocally(ServerClients& clients, const std::string& name, const std::string& text);
void broadcastChat(ServerClients& clients, const std::string& name, const std::string& text);

// Sends Refused with the reason (any bytes) and disconnects the client; its further messages are ignored.
void refuse(ServerClients& clients, ServerClient& client, Refusal why, const std::string& reason);
// The same for a message that is not allowed at this time.
void refuseUnexpected(ServerClients& clients, ServerClient& client, const ClientMessage& message);
// The message for a banned player.
std::string banText(const std::string& reason);
// Ends the client's play: stores its position and tells other players.
void leave(ServerClients& clients, ServerClient& client);

// Takes one from the bucket of the address, which begins as `full`. This machine has no limit.
bool takeOfAddress(AddressBuckets& buckets, const ClientAddress& address, const base::TokenBucket& full,
                   Time now);

// Null if no such player is playing.
ServerClient* playingClient(ServerClients& clients, game::PlayerId player);
ServerClient* playingClient(ServerClients& clients, std::string_view name);

// Calls use(ServerClient&) for each playing client. `Clients`: ServerClients, may be const.
template <class Clients, class Use>
void forEachPlaying(Clients& clients, Use use) {
    for (auto& [id, client] : clients.all)
        if (client.stage == ServerClient::Stage::Playing) use(client);
}

// Calls use(const KnownPlayer&, const PlayerAt&) for each player of another server.
template <class Use>
void forEachElsewhere(const ServerClients& clients, Use use) {
    for (const auto& [id, other] : clients.elsewhere) {
        const KnownPlayer* known = clients.known.byId(id);
        if (known && !clients.playing.contains(id)) use(*known, other.at);
    }
}

}  // namespace terrane::net

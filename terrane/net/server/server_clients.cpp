#include "terrane/net/server/server_clients.h"

#include "terrane/base/log.h"
#include "terrane/net/wire/wire.h"

namespace terrane::net {
namespace {

std::vector<std::string_view> linesOf(std::string_view text) {
    std::vector<std::string_view> lines;
    while (true) {
        const std::size_t end = text.find('\n');
        lines.push_back(text.substr(0, end));
        if (end == std::string_view::npos) return lines;
        text.remove_prefix(end + 1);
    }
}

}  // namespace

bool takeOfAddress(AddressBuckets& buckets, const ClientAddress& address, const base::TokenBucket& full,
                   Time now) {
    // Bounds the memory; beyond it the limits are reset.
    constexpr std::size_t kMaxAddresses = 4096;
    if (address.isOwnMachine) return true;
    if (buckets.size() >= kMaxAddresses) buckets.clear();
    return buckets.try_emplace(address.network, full).first->second.take(1, now);
}

void send(ServerClient& client, const ServerMessage& message) {
    sendEncoded(client, encode(message));
}

void sendEncoded(ServerClient& client, ByteView message) {
    if (client.stage != ServerClient::Stage::Closed) appendFrame(client.outgoing, message);
}

void say(ServerClient& client, const std::string& text) {
    for (const std::string_view line : linesOf(text)) send(client, Said{{}, plainText(line, kMaxChatBytes)});
}

Clock clockOf(const ServerState& server) {
    const game::DayClock& clock = server.session.clock;
    return {clock.timeDay, 1 / (60 * clock.dayMinutes)};
}

void setTimeHere(ServerState& server, double timeDay) {
    server.session.clock.timeDay = timeDay;
    forEachPlaying(server, [&](ServerClient& client) { send(client, clockOf(server)); });
}

void broadcastChatLocally(ServerState& server, const std::string& name, const std::string& text) {
    for (const std::string_view line : linesOf(text)) {
        const Bytes message = encode(ServerMessage(Said{name, plainText(line, kMaxChatBytes)}));
        forEachPlaying(server, [&](ServerClient& client) { sendEncoded(client, message); });
    }
}

void broadcastChat(ServerState& server, const std::string& name, const std::string& text) {
    broadcastChatLocally(server, name, text);
    if (!server.sharing.shared) return;
    for (const std::string_view line : linesOf(text))
        server.sharing.shared->say({name, plainText(line, kMaxChatBytes)});
}

void refuse(ServerState& server, ServerClient& client, Refusal why, const std::string& reason) {
    if (client.stage == ServerClient::Stage::Closed) return;
    send(client, Refused{why, plainText(reason, kMaxReasonBytes)});
    base::logInfo("{} ({}): {}", client.name.empty() ? "somebody" : client.name, client.address.shown,
                  reason);
    leave(server, client);
    client.stage = ServerClient::Stage::Closed;
}

void refuseUnexpected(ServerState& server, ServerClient& client, const ClientMessage& message) {
    refuse(server, client, Refusal::ProtocolError, fmt::format("unexpected message {}", nameOf(message)));
}

std::string banText(const std::string& reason) {
    return "you are banned from this server: " + reason;
}

void leave(ServerState& server, ServerClient& client) {
    if (client.stage != ServerClient::Stage::Playing) return;
    client.stage = ServerClient::Stage::Closed;
    server.knownPlayers.setPose(client.player, poseOf(client.pose));
    server.playing.erase(client.player);
    if (server.sharing.shared) server.sharing.shared->publishLeft(client.player);
    server.left.insert_or_assign(client.player, FormerClient{server.now, client.buckets});
    base::logInfo("{} left", client.name);
    broadcastChat(server, {}, client.name + " left");
}

ServerClient* playingClient(ServerState& server, game::PlayerId player) {
    const auto found = server.playing.find(player);
    return found == server.playing.end() ? nullptr : &server.clients.at(found->second);
}

ServerClient* playingClient(ServerState& server, std::string_view name) {
    const KnownPlayer* known = server.knownPlayers.byName(name);
    return known ? playingClient(server, known->id) : nullptr;
}

}  // namespace terrane::net

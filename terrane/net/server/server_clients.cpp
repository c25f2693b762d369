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

Items itemsOf(const game::Session& session, game::PlayerId player) {
    return {session.modeOf(player), session.itemsOf(player).slots};
}

Clock clockOf(const game::DayClock& clock) {
    return {clock.timeDay, 1 / (60 * clock.dayMinutes)};
}

void setTimeHere(ServerClients& clients, game::DayClock& clock, double timeDay) {
    clock.timeDay = timeDay;
    forEachPlaying(clients, [&](ServerClient& client) { send(client, clockOf(clock)); });
}

void broadcastChatLocally(ServerClients& clients, const std::string& name, const std::string& text) {
    for (const std::string_view line : linesOf(text)) {
        const Bytes message = encode(ServerMessage(Said{name, plainText(line, kMaxChatBytes)}));
        forEachPlaying(clients, [&](ServerClient& client) { sendEncoded(client, message); });
    }
}

void broadcastChat(ServerClients& clients, const std::string& name, const std::string& text) {
    broadcastChatLocally(clients, name, text);
    if (!clients.shared) return;
    for (const std::string_view line : linesOf(text))
        clients.shared->say({name, plainText(line, kMaxChatBytes)});
}

void refuse(ServerClients& clients, ServerClient& client, Refusal why, const std::string& reason) {
    if (client.stage == ServerClient::Stage::Closed) return;
    send(client, Refused{why, plainText(reason, kMaxReasonBytes)});
    base::logInfo("{} ({}): {}", client.name.empty() ? "somebody" : client.name, client.address.shown,
                  reason);
    leave(clients, client);
    client.stage = ServerClient::Stage::Closed;
}

void refuseUnexpected(ServerClients& clients, ServerClient& client, const ClientMessage& message) {
    refuse(clients, client, Refusal::ProtocolError, fmt::format("unexpected message {}", nameOf(message)));
}

std::string banText(const std::string& reason) {
    return "you are banned from this server: " + reason;
}

void leave(ServerClients& clients, ServerClient& client) {
    if (client.stage != ServerClient::Stage::Playing) return;
    client.stage = ServerClient::Stage::Closed;
    clients.known.setPose(client.player, poseOf(client.pose));
    clients.playing.erase(client.player);
    if (clients.shared) clients.shared->publishLeft(client.player);
    clients.former.insert_or_assign(client.player, FormerClient{clients.now, client.buckets});
    base::logInfo("{} left", client.name);
    broadcastChat(clients, {}, client.name + " left");
    clients.events.left.notify({client.player});
}

ServerClient* playingClient(ServerClients& clients, game::PlayerId player) {
    const auto found = clients.playing.find(player);
    return found == clients.playing.end() ? nullptr : &clients.all.at(found->second);
}

ServerClient* playingClient(ServerClients& clients, std::string_view name) {
    const KnownPlayer* known = clients.known.byName(name);
    return known ? playingClient(clients, known->id) : nullptr;
}

}  // namespace terrane::net

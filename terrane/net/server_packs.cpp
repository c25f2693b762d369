#include "terrane/net/server_packs.h"

#include <algorithm>

#include "terrane/net/server_clients.h"

namespace terrane::net {
namespace {

constexpr std::size_t kMaxUnsentParts = 2;

}  // namespace

void onAskPack(ServerState& server, ServerClient& client, const AskPack& ask) {
    client.sentOfPacks.resize(server.packs.size());
    const bool isNext = ask.number < server.packs.size() && ask.offset == client.sentOfPacks[ask.number] &&
                        ask.offset < server.packs[ask.number].archive->size();
    if (!isNext)
        return refuse(server, client, Refusal::ProtocolError, "this part of a pack is not the next one");
    // Clients request a part after the previous one arrived; this bounds the memory for clients that do not
    // read.
    if (client.outgoing.size() + client.unsent > kMaxUnsentParts * kMaxPackPart)
        return refuse(server, client, Refusal::TooSlow, "parts of packs were asked for that are not read");
    const Bytes& archive = *server.packs[ask.number].archive;
    const std::size_t count = std::min<std::size_t>(kMaxPackPart, archive.size() - ask.offset);
    const auto begin = archive.begin() + static_cast<std::ptrdiff_t>(ask.offset);
    send(client, PackPart{ask.number, ask.offset, Bytes(begin, begin + static_cast<std::ptrdiff_t>(count))});
    client.sentOfPacks[ask.number] += static_cast<std::uint32_t>(count);
    ++client.packParts;
}

// Allows a second for each part, plus time to load the packs.
std::chrono::milliseconds timeForPacks(const ServerClient& client) {
    return client.packParts == 0 ? std::chrono::seconds(0) : std::chrono::seconds(20 + client.packParts);
}

}  // namespace terrane::net

#include "terrane/net/sharing/other_servers.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "terrane/base/log.h"
#include "terrane/base/text.h"
#include "terrane/net/server/server_clients.h"
#include "terrane/net/server/server_view.h"
#include "terrane/net/wire/wire.h"

namespace terrane::net {
namespace {

using world::ChunkPos;

constexpr std::uint64_t kTicksPerPoses = 4, kTicksPerAllPoses = 40;
// A player without news for this long is dropped.
constexpr std::chrono::seconds kForgetAfter{8};
// Orphaned chunks saved in a tick, some milliseconds, and requested ahead.
constexpr std::size_t kOrphans = 8, kOrphansAhead = 32;

}  // namespace

void applyPoses(ServerClients& clients, std::span<const OtherPlayer> poses) {
    for (const OtherPlayer& other : poses) {
        PlayerElsewhere& known = clients.elsewhere[other.id];
        known.at.id = other.id;
        known.at.pose = other.pose;
        if (other.swings) known.at.swungTick = clients.tick;
        known.heardAt = clients.now;
    }
    std::erase_if(clients.elsewhere,
                  [&](const auto& entry) { return clients.now - entry.second.heardAt > kForgetAfter; });
}

void publishPosesIfDue(SharingState& sharing, const ServerClients& clients) {
    if (clients.tick % kTicksPerPoses != 0) return;
    const bool isAll = clients.tick % kTicksPerAllPoses == 0;
    std::vector<OtherPlayer> moved;
    std::unordered_map<game::PlayerId, WirePose> told;
    forEachPlaying(clients, [&](const ServerClient& client) {
        const auto before = sharing.toldPoses.find(client.player);
        const bool isStill = before != sharing.toldPoses.end() && before->second == client.pose;
        const bool swings = client.swungTick > 0 && clients.tick - client.swungTick < kTicksPerPoses;
        if (isAll || !isStill || swings) moved.push_back({client.player, client.pose, swings});
        told[client.player] = client.pose;
    });
    sharing.toldPoses = std::move(told);
    if (!moved.empty()) sharing.shared->publishPoses(moved);
}

void setOtherServers(SharingState& sharing, ServerClients& clients, std::vector<OtherServer> servers) {
    for (const OtherServer& other : servers) {
        const auto isItsOwn = [&](const SharingState::Orphans& orphans) {
            return orphans.server == other.number;
        };
        // It had only stalled: it saves its own changes.
        if (other.isAlive) {
            std::erase_if(sharing.orphans, isItsOwn);
            sharing.forgotten.erase(other.number);
            continue;
        }
        if (sharing.forgotten.contains(other.number) || std::ranges::any_of(sharing.orphans, isItsOwn))
            continue;
        base::logInfo("the server {} is gone; saved here: {} that it changed", other.name,
                      base::counted(other.unsaved.size(), "chunk"));
        sharing.orphans.push_back({other.number, sharing.newest, other.unsaved});
    }
    // A server without an address cannot be reached by clients.
    std::erase_if(servers, [](const OtherServer& other) { return !other.isAlive || other.address.empty(); });
    const auto isSame = [](const OtherServer& a, const OtherServer& b) {
        return a.address == b.address && a.key == b.key;
    };
    if (std::ranges::equal(servers, sharing.servers, isSame)) return;
    sharing.servers = std::move(servers);
    const Bytes message = encode(ServerMessage(otherServers(sharing.servers)));
    forEachPlaying(clients, [&](ServerClient& client) { sendEncoded(client, message); });
}

// Loading a chunk applies the tail, which marks it as changed, so that it is saved.
void saveOrphans(SharingState& sharing, stream::ChunkPipeline& pipeline) {
    if (sharing.orphans.empty()) return;
    SharingState::Orphans& orphans = sharing.orphans.front();
    for (const ChunkPos chunk :
         std::span(orphans.chunks).last(std::min(kOrphansAhead, orphans.chunks.size())))
        (void)pipeline.maybeLoadChunkAt(chunk);
    for (std::size_t k = 0; k < kOrphans && !orphans.chunks.empty(); ++k) {
        if (!pipeline.maybeLoadChunkAt(orphans.chunks.back())) return;
        orphans.chunks.pop_back();
    }
    if (!orphans.chunks.empty()) return;
    // A running save may have begun before the last chunk was loaded.
    if (!orphans.savedBy) orphans.savedBy = sharing.savesBegun + 1;
    if (sharing.savesDone < *orphans.savedBy || sharing.ownSaved < orphans.newest) return;
    sharing.shared->removeStoppedServer(orphans.server);
    sharing.forgotten.insert(orphans.server);
    sharing.orphans.pop_front();
}

Servers otherServers(std::span<const OtherServer> servers) {
    Servers others;
    for (const OtherServer& other : servers)
        if (others.places.size() < kMaxServersInMessage && other.address.size() <= kMaxAddressBytes &&
            other.key.size() <= kServerKeyBytes && isPlainText(other.address) && isPlainText(other.key))
            others.places.push_back({other.address, other.key});
    return others;
}

}  // namespace terrane::net

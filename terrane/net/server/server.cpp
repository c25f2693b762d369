#include "terrane/net/server/server.h"

#include <algorithm>
#include <utility>

#include "terrane/base/log.h"
#include "terrane/net/server/server_clients.h"
#include "terrane/net/server/server_commands.h"
#include "terrane/net/server/server_history.h"
#include "terrane/net/server/server_login.h"
#include "terrane/net/server/server_players.h"
#include "terrane/net/server/server_view.h"
#include "terrane/net/sharing/server_sharing.h"
#include "terrane/net/wire/security.h"
#include "terrane/world/changes/random_ticks.h"

namespace terrane::net {
namespace {

// Interval of the search for chunks in which time passes.
constexpr std::uint64_t kTicksPerLiveChunks = 40;

void noteEdits(ServerState& server, std::span<const world::BlockEdit> edits) {
    for (const world::BlockEdit& edit : edits)
        server.changed[world::chunkOf(edit.pos)].push_back(world::blockIndex(edit.pos));
}

bool hasState(const world::Chunk& chunk) {
    for (int section = 0; section < world::kSectionsPerChunk; ++section) {
        const world::Section& states = chunk.blockStates(section);
        if (!states.isUniform() || states.uniformValue() != 0) return true;
    }
    return false;
}

// Time passes in edited chunks near players; generated blocks are at rest. These chunks and their neighbors,
// into which liquids may flow, stay loaded.
void findLiveChunks(ServerState& server) {
    std::unordered_set<world::ChunkPos, world::ChunkPosHash> live;
    forEachPlaying(server, [&](const ServerClient& client) {
        const world::ChunkPos own = world::chunkOf(poseOf(client.pose).position);
        for (const world::ChunkPos pos : server.edited.within(own, world::kTickRadius)) live.insert(pos);
    });
    server.liveChunks.clear();
    stream::ChunkPipeline& pipeline = server.session.pipeline();
    for (const world::ChunkPos pos : live) {
        const world::ChunkPtr chunk = pipeline.maybeLoadChunkAt(pos);
        if (!chunk || !hasState(*chunk)) continue;
        server.liveChunks.push_back(pos);
        for (const world::ChunkPos beside : world::chunksWithin(pos, 1))
            if (world::isInWorld(beside)) (void)pipeline.maybeLoadChunkAt(beside);
    }
    std::ranges::sort(server.liveChunks);
    requestRegions(server, server.liveChunks);
}

// Chunks in which this server lets time pass.
std::vector<world::ChunkPos> growingChunks(const ServerState& server) {
    std::vector<world::ChunkPos> chunks;
    std::ranges::copy_if(server.liveChunks, std::back_inserter(chunks),
                         [&](world::ChunkPos chunk) { return mayGrow(server, chunk); });
    return chunks;
}

void forgetHistories(ServerState& server) {
    std::erase_if(server.left, [&](const auto& entry) {
        if (server.now - entry.second.at < server.settings.keepHistoryFor) return false;
        server.session.removePlayer(entry.first);
        return true;
    });
}

ServerClient* clientOf(ServerState& server, ConnectionId id) {
    const auto found = server.clients.find(id);
    return found == server.clients.end() ? nullptr : &found->second;
}

base::Result<void> prepare(ServerState& server) {
    auto edited = TERRANE_TRY(server.session.store().editedChunks());
    for (const world::ChunkPos pos : edited) server.edited.add(pos);
    auto password = TERRANE_TRY(server.records.text(kPasswordText));
    server.passwordHash = std::move(password);
    server.session.permissions.claims = server.knownPlayers.claims();
    server.session.clock.dayMinutes = server.settings.dayMinutes;
    std::uint64_t random = 0;
    fillRandom(std::as_writable_bytes(std::span(&random, 1)));
    prepareLogin(server, random);
    return {};
}

}  // namespace

base::Result<std::unique_ptr<ServerState>> openServer(const ServerParts& parts,
                                                      const ServerSettings& settings,
                                                      std::shared_ptr<WrittenTiles> tiles) {
    auto server = std::make_unique<ServerState>(parts, settings);
    server->world = parts.fingerprint;
    if (tiles) server->writtenTiles = std::move(tiles);
    game::Session& session = server->session;
    session.setEditListener([&state = *server](game::PlayerId, std::span<const world::BlockEdit> edits) {
        noteEdits(state, edits);
    });
    session.setChangeListener(
        [&state = *server](game::PlayerId player, std::span<const game::ChangedBlock> changes) {
            logChanges(state, player, changes);
        },
        parts.records.shared() != nullptr);
    TERRANE_TRY(restoreEdits(*server));
    TERRANE_TRY(beginSharing(*server));
    TERRANE_TRY(prepare(*server));
    return server;
}

void addWrittenTiles(WrittenTiles& written, std::span<const world::ChunkPos> tiles) {
    const std::lock_guard lock(written.mutex);
    written.tiles.insert(written.tiles.end(), tiles.begin(), tiles.end());
}

void onOpened(ServerState& server, ConnectionId id, Bytes channel, ClientAddress address, Time now) {
    server.now = std::max(server.now, now);
    ServerClient& client = server.clients.try_emplace(id, id, server.settings.maxSpeed).first->second;
    client.channel = std::move(channel);
    client.address = std::move(address);
    client.openedAt = client.heardAt = server.now;
}

void onMessage(ServerState& server, ConnectionId id, ByteView bytes, Time now) {
    server.now = std::max(server.now, now);
    ServerClient* client = clientOf(server, id);
    if (!client || client->stage == ServerClient::Stage::Closed) return;
    if (!client->buckets.messages.take(1, server.now))
        return refuse(server, *client, Refusal::TooMuch, "too many messages");
    auto message = decodeClientMessage(bytes);
    if (!message) return refuse(server, *client, Refusal::ProtocolError, message.error().message);
    client->heardAt = server.now;
    if (client->stage == ServerClient::Stage::Playing)
        onPlayerMessage(server, *client, std::move(*message));
    else
        onLoginMessage(server, *client, *message);
}

void onMalformedMessage(ServerState& server, ConnectionId id, const std::string& what, Time now) {
    server.now = std::max(server.now, now);
    if (ServerClient* client = clientOf(server, id)) refuse(server, *client, Refusal::ProtocolError, what);
}

void onClosed(ServerState& server, ConnectionId id, Time now) {
    server.now = std::max(server.now, now);
    if (ServerClient* client = clientOf(server, id)) leave(server, *client);
    server.clients.erase(id);
}

void tick(ServerState& server, Time now) {
    server.now = std::max(server.now, now);
    ++server.tick;
    applySharedChanges(server);
    sendChangedBlocks(server);
    updateLogins(server);
    // At both calls of update() no change waits to be sent, so chunks may be unloaded. It runs twice because
    // a chunk that is not in the store takes two jobs while a command waits for it.
    server.session.pipeline().update(server.now);
    completeLoaded(server);
    runCommands(server);
    continueRollbacks(server);
    if (server.tick % kTicksPerLiveChunks == 1) findLiveChunks(server);
    server.session.advance(std::chrono::duration<double>(kServerTick).count(), growingChunks(server));
    sendChangedBlocks(server);
    server.session.pipeline().update(server.now);
    completeLoaded(server);
    sendDecisions(server);
    sendViews(server);
    broadcastVisibility(server);
    sendKeepAlives(server);
    autosave(server);
    updateSharing(server);
    forgetHistories(server);
}

base::Result<void> stop(ServerState& server, const std::string& reason) {
    for (auto& [id, client] : server.clients) refuse(server, client, Refusal::Stopping, reason);
    return saveEverything(server);
}

}  // namespace terrane::net

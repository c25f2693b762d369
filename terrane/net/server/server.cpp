#include "terrane/net/server/server.h"

#include <algorithm>
#include <utility>

#include "terrane/game/player_state.h"
#include "terrane/net/server/server_clients.h"
#include "terrane/net/server/server_commands.h"
#include "terrane/net/server/server_history.h"
#include "terrane/net/server/server_login.h"
#include "terrane/net/server/server_players.h"
#include "terrane/net/server/server_view.h"
#include "terrane/net/sharing/other_servers.h"
#include "terrane/net/sharing/server_sharing.h"
#include "terrane/world/changes/random_ticks.h"

namespace terrane::net {
namespace {

// Interval of the search for chunks in which time passes.
constexpr std::uint64_t kTicksPerLiveChunks = 40;

bool hasState(const world::Chunk& chunk) {
    const world::Heights heights = chunk.heights();
    for (int section = heights.firstSection(); section < heights.endSection(); ++section) {
        const world::Section& states = chunk.blockStates(section);
        if (!states.isUniform() || states.uniformValue() != 0) return true;
    }
    return false;
}

// Time passes in edited chunks near players; generated blocks are at rest. These chunks and their neighbors,
// into which liquids may flow, stay loaded.
std::vector<world::ChunkPos> findLiveChunks(const ServerClients& clients, const EditedChunks& edited,
                                            game::Session& session) {
    stream::ChunkPipeline& pipeline = session.pipeline();
    const bool hasRandomTicks = !session.events.randomTickBlocks.empty();
    std::unordered_set<world::ChunkPos, world::ChunkPosHash> near;
    forEachPlaying(clients, [&](const ServerClient& client) {
        const world::ChunkPos own = world::chunkOf(poseOf(client.pose).position);
        for (const world::ChunkPos pos : edited.within(own, world::kTickRadius)) near.insert(pos);
    });
    std::vector<world::ChunkPos> live;
    for (const world::ChunkPos pos : near) {
        const world::ChunkPtr chunk = pipeline.maybeLoadChunkAt(pos);
        if (!chunk || (!hasRandomTicks && !hasState(*chunk))) continue;
        live.push_back(pos);
        for (const world::ChunkPos beside : world::chunksWithin(pos, 1))
            if (world::isInWorld(beside)) (void)pipeline.maybeLoadChunkAt(beside);
    }
    std::ranges::sort(live);
    return live;
}

void forgetHistories(ServerClients& clients, game::Session& session) {
    std::erase_if(clients.former, [&](const auto& entry) {
        if (clients.now - entry.second.at < clients.settings.keepHistoryFor) return false;
        session.removePlayer(entry.first);
        return true;
    });
}

// Applies what the other servers of a shared world reported since the last call.
void applySharedChanges(ServerState& server) {
    if (!server.sharing.shared) return;
    ServerClients& clients = server.clients;
    ServerEdits& edits = server.edits;
    game::Session& session = server.session;
    SharedChanges changes = server.sharing.shared->popChanges();
    for (const HistoryEvent& event : changes.history)
        if (const auto* edit = std::get_if<LoggedEdit>(&event))
            server.history.stamps.hear(edit->timeMs, clients.now);
    applyHistory(server.sharing, session, clients, edits, changes);
    const std::vector<world::ChunkPos> stored = dropTail(server.sharing, changes.saved, clients.now);
    if (edits.onChanged && !stored.empty()) edits.onChanged(stored);
    applyPlayers(clients, session.permissions, changes);
    applyPoses(clients, changes.poses);
    for (const SharedLine& line : changes.lines) broadcastChatLocally(clients, line.name, line.text);
    onTilesChanged(edits, changes.tiles);
    if (changes.allPlaces) replacePlaces(server.places, *changes.allPlaces);
    for (const PlaceChange& change : changes.places) applyPlaceChange(server.places, change);
    if (changes.passwordHash) server.password.hash = *changes.passwordHash;
    if (changes.timeDay) setTimeHere(clients, session.clock, *changes.timeDay);
    if (changes.servers) setOtherServers(server.sharing, clients, std::move(*changes.servers));
}

// Loads and unloads chunks. Call while no change waits to be sent, so that no changed chunk is unloaded.
void updateChunks(SharingState& sharing, game::Session& session, Time now) {
    session.pipeline().update(now);
    completeLoaded(sharing, session);
}

// The client with this number, at this time; null if there is none.
ServerClient* clientAt(ServerClients& clients, ConnectionId id, Time now) {
    clients.now = std::max(clients.now, now);
    const auto found = clients.all.find(id);
    return found == clients.all.end() ? nullptr : &found->second;
}

}  // namespace

namespace {

// Fails for the records of another world, whose file has been deleted: their history would change this one.
base::Result<void> checkWorldOf(ServerRecords& records, const store::WorldIdentity& world) {
    std::string own = fmt::format("{} {}", world.seed, world.generator);
    if (world.heights != world::Heights()) own += fmt::format(", layers {}", world::describe(world.heights));
    const std::string known = TERRANE_TRY(records.text(kWorldText));
    if (known.empty()) records.setText(kWorldText, own);
    if (known.empty() || known == own) return {};
    return base::fail(
        base::ErrorCode::Incompatible,
        "the server's file beside the world is of another world (seed and generator {}): move it "
        "away, or the world",
        known);
}

}  // namespace

namespace {

// The number of a pack of the session among the known players, whom the history names. kNoPlayer if there is
// no new number now.
game::PlayerId packIdOf(ServerState& server, game::PackId pack) {
    if (pack == game::kNoPack) return game::kNoPlayer;
    game::PlayerId& known = server.packPlayers[pack];
    if (known != game::kNoPlayer) return known;
    const std::string& name = server.session.packs.at(pack - 1);
    PublicKey key{};  // no private key belongs to a name
    std::ranges::transform(name.substr(0, key.size()), key.begin(), [](char c) { return std::byte(c); });
    KnownPlayers& players = server.clients.known;
    if (const KnownPlayer* player = players.byKey(key)) return known = player->id;
    game::PlayerId number = game::kNoPlayer;
    if (SharedWorld* shared = server.sharing.shared) {
        number = shared->allocatePlayerId();
        if (number == game::kNoPlayer) return number;
    }
    std::string shown = "pack:" + name;
    while (players.byName(shown)) shown += '*';
    return known = players.add(key, shown, game::Role::Guest, number).id;
}

void listen(ServerState& server) {
    game::Events& events = server.session.events;
    const auto keep = [&](game::Subscription subscription) {
        server.subscriptions.push_back(std::move(subscription));
    };
    keep(events.edited.add([&changed = server.changed](const game::BlocksEdited& event) {
        for (const world::BlockEdit& edit : event.edits)
            changed[world::chunkOf(edit.pos)].push_back(world::blockIndex(edit.pos));
    }));
    auto& changes = server.history.records.shared() ? events.changedAtAll : events.changed;
    keep(changes.add([&server](const game::BlocksChanged& event) {
        const game::Author author{event.author.player, packIdOf(server, event.author.pack)};
        logChanges(server.history, server.sharing, author, server.clients.now, event.blocks);
    }));
    keep(events.items.add([&server](const game::ItemsChanged& event) {
        server.clients.known.setItems(event.player, game::textOf(server.session.itemsOf(event.player)));
        if (ServerClient* client = playingClient(server.clients, event.player))
            send(*client, itemsOf(server.session, event.player));
    }));
    keep(events.said.add([&clients = server.clients](const game::Said& line) {
        if (line.to == game::kNoPlayer) return broadcastChat(clients, {}, line.text);
        if (ServerClient* client = playingClient(clients, line.to)) say(*client, line.text);
    }));
}

}  // namespace

base::Result<std::unique_ptr<ServerState>> openServer(const ServerParts& parts,
                                                      const ServerSettings& settings) {
    auto server = std::make_unique<ServerState>(parts, settings);
    game::Session& session = parts.session;
    session.mode = settings.mode.value_or(game::loadMode(session.store()));
    if (parts.records.shared() && session.mode == game::Mode::Survival)
        return base::fail(base::ErrorCode::BadInput,
                          "survival: the world is shared between servers in PostgreSQL, where items are not "
                          "kept with the blocks; serve it from a file, or with --mode creative");
    if (settings.mode) game::saveMode(session.store(), *settings.mode);
    listen(*server);
    session.together = [&records = parts.records] { return records.together(); };
    TERRANE_TRY(checkWorldOf(parts.records, session.store().identity()));
    startStamps(server->history);
    const bool isRestored = TERRANE_TRY(restoreEdits(server->history, session));
    if (isRestored) TERRANE_TRY(saveEverything(*server));
    TERRANE_TRY(beginSharing(server->sharing, parts.records, session, server->edits.chunks));
    const auto edited = TERRANE_TRY(session.store().editedChunks());
    for (const world::ChunkPos pos : edited) server->edits.chunks.add(pos);
    auto hash = TERRANE_TRY(parts.records.text(kPasswordText));
    server->password.hash = std::move(hash);
    session.permissions.claims = parts.knownPlayers.claims();
    session.clock.dayMinutes = settings.dayMinutes;
    return server;
}

void onOpened(ServerState& server, ConnectionId id, Bytes channel, ClientAddress address, Time now) {
    ServerClients& clients = server.clients;
    clients.now = std::max(clients.now, now);
    ServerClient& client = clients.all.try_emplace(id, id, server.settings.maxSpeed).first->second;
    client.channel = std::move(channel);
    client.address = std::move(address);
    client.openedAt = client.heardAt = clients.now;
}

void onMessage(ServerState& server, ConnectionId id, ByteView bytes, Time now) {
    ServerClients& clients = server.clients;
    ServerClient* client = clientAt(clients, id, now);
    if (!client || client->stage == ServerClient::Stage::Closed) return;
    if (!client->buckets.messages.take(1, clients.now))
        return refuse(clients, *client, Refusal::TooMuch, "too many messages");
    auto message = decodeClientMessage(bytes);
    if (!message) return refuse(clients, *client, Refusal::ProtocolError, message.error().message);
    client->heardAt = clients.now;
    if (client->stage == ServerClient::Stage::Playing)
        onPlayerMessage(server, *client, std::move(*message));
    else
        onLoginMessage(server, *client, *message);
}

void onMalformedMessage(ServerState& server, ConnectionId id, const std::string& what, Time now) {
    if (ServerClient* client = clientAt(server.clients, id, now))
        refuse(server.clients, *client, Refusal::ProtocolError, what);
}

void onClosed(ServerState& server, ConnectionId id, Time now) {
    if (ServerClient* client = clientAt(server.clients, id, now)) leave(server.clients, *client);
    server.clients.all.erase(id);
}

void tick(ServerState& server, Time now) {
    game::Session& session = server.session;
    ServerClients& clients = server.clients;
    ServerEdits& edits = server.edits;
    ServerHistory& history = server.history;
    SharingState& sharing = server.sharing;
    clients.now = std::max(clients.now, now);
    ++clients.tick;
    history.stamps.begin(clients.now);
    applySharedChanges(server);
    sendChangedBlocks(clients, edits, session.world(), std::exchange(server.changed, {}));
    updateLogins(clients, server.password, server.offer, server.jobs);
    // Chunks are updated twice because a chunk that is not in the store takes two jobs while a command waits
    // for it.
    updateChunks(sharing, session, clients.now);
    runCommands(clients, session, history);
    continueRollbacks(history, sharing, session, server.clients.now);
    if (clients.tick % kTicksPerLiveChunks == 1) {
        server.liveChunks = findLiveChunks(clients, edits.chunks, session);
        if (sharing.shared) requestRegions(*sharing.shared, server.liveChunks);
    }
    session.advance(std::chrono::duration<double>(kServerTick).count(),
                    growingChunks(sharing.shared, server.liveChunks));
    sendChangedBlocks(clients, edits, session.world(), std::exchange(server.changed, {}));
    updateChunks(sharing, session, clients.now);
    sendDecisions(clients, history.records.durable());
    sendViews(clients, edits);
    broadcastVisibility(clients);
    sendKeepAlives(clients, session.clock);
    autosave(history, sharing, session, clients.now);
    updateSharing(sharing, clients, server.places, session.pipeline());
    continueBackup(server);
    forgetHistories(clients, session);
}

ServerCounts countsOf(const ServerState& server) {
    const bool isShared = server.sharing.shared != nullptr;
    return {server.clients.playing.size(), server.session.world().chunkCount(), server.edits.chunks.count(0),
            isShared ? server.sharing.newest : server.history.newest};
}

base::Result<void> saveEverything(ServerState& server) {
    game::Session& session = server.session;
    ServerHistory& history = server.history;
    SharingState& sharing = server.sharing;
    while (!history.rollbacks.empty()) {
        (void)session.pipeline().chunkAt(history.rollbacks.front().chunk);
        completeLoaded(sharing, session);
        continueRollbacks(history, sharing, session, server.clients.now);
    }
    if (sharing.shared) {
        // Afterwards all own edits are decided among the servers.
        const auto flushed = history.records.flush();
        applySharedChanges(server);
        if (!flushed) return flushed;
    }
    game::saveTimeDay(session.store(), session.clock.timeDay);
    // Chunks are never ahead of the history, also on disk. The last flush reports errors.
    (void)history.records.flush();
    TERRANE_TRY(session.save());
    if (sharing.shared) {
        publishSavedPlaces(server.places);
        sharing.shared->publishState(0, sharing.newest);
    }
    if (history.saved < history.newest) {
        history.saved = history.newest;
        history.records.setSavedEdit(history.newest);
    }
    history.saving.reset();
    return history.records.flush();
}

base::Result<void> stop(ServerState& server, const std::string& reason) {
    cancelBackup(server);
    for (auto& [id, client] : server.clients.all) refuse(server.clients, client, Refusal::Stopping, reason);
    return saveEverything(server);
}

}  // namespace terrane::net

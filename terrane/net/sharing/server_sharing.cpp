#include "terrane/net/sharing/server_sharing.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "terrane/game/player_state.h"
#include "terrane/net/server/server_clients.h"
#include "terrane/net/server/server_history.h"
#include "terrane/net/server/server_players.h"
#include "terrane/net/server/server_view.h"
#include "terrane/net/sharing/other_servers.h"

namespace terrane::net {
namespace {

using world::ChunkPos;

constexpr std::chrono::seconds kStateEvery{1};
constexpr std::chrono::seconds kKeepTail{60};

void addToTail(SharingState& sharing, ChunkPos chunk, std::int64_t number, const ChunkDifference& after) {
    sharing.tail[chunk].push_back({number, after});
}

// The edits of a chunk that the store may lack.
ChunkDifference tailOf(const SharingState& sharing, ChunkPos pos) {
    ChunkDifference blocks;
    const auto found = sharing.tail.find(pos);
    if (found == sharing.tail.end()) return blocks;
    for (const SharingState::TailEdit& edit : found->second) mergeInto(blocks, edit.after);
    return blocks;
}

void noteUnsaved(ServerState& server, ChunkPos chunk, std::int64_t number) {
    if (server.session.pipeline().isUnsaved(chunk)) server.sharing.firstUnsaved.try_emplace(chunk, number);
}

// Applies an edit of another server. Own undecided edits of the same blocks will be refused.
void applyOther(ServerState& server, const LoggedEdit& edit) {
    SharingState& sharing = server.sharing;
    addToTail(sharing, edit.chunk, edit.number, edit.after);
    for (const ChangedBlock& block : edit.after) {
        const auto found = sharing.settled.find(world::blockPos(edit.chunk, block.index));
        if (found != sharing.settled.end()) found->second.value = block.value;
    }
    if (!server.session.world().maybeChunkAt(edit.chunk)) return sendBlocks(server, edit.chunk, edit.after);
    server.session.setBlocks(placedBlocks(edit.chunk, edit.after));
    noteUnsaved(server, edit.chunk, edit.number);
}

// Removes an edit from the counts of undecided edits per block and chunk.
void settle(SharingState& sharing, const LoggedEdit& edit) {
    for (const ChangedBlock& block : edit.after) {
        const auto found = sharing.settled.find(world::blockPos(edit.chunk, block.index));
        if (--found->second.undecided == 0) sharing.settled.erase(found);
    }
    const auto chunk = sharing.undecidedChunks->find(edit.chunk);
    if (--chunk->second == 0) sharing.undecidedChunks->erase(chunk);
}

void accept(ServerState& server, const std::vector<LoggedEdit>& edits, std::int64_t number) {
    SharingState& sharing = server.sharing;
    for (const LoggedEdit& edit : edits) {
        for (const ChangedBlock& block : edit.after)
            sharing.settled.at(world::blockPos(edit.chunk, block.index)).value = block.value;
        settle(sharing, edit);
        addToTail(sharing, edit.chunk, number, edit.after);
        noteUnsaved(server, edit.chunk, number);
        ++number;
    }
}

// Reverts a refused write to the values of the history. Later own writes on top of it will be refused as
// well.
void takeBack(ServerState& server, const std::vector<LoggedEdit>& edits) {
    SharingState& sharing = server.sharing;
    std::vector<world::PlacedBlock> blocks;
    for (const LoggedEdit& edit : edits) {
        for (const ChangedBlock& block : edit.after) {
            const world::BlockPos pos = world::blockPos(edit.chunk, block.index);
            blocks.push_back({pos, sharing.settled.at(pos).value});
        }
        settle(sharing, edit);
    }
    server.session.setBlocks(blocks);
}

void applyDecision(ServerState& server, const WriteDecision& decision) {
    const auto found = server.sharing.undecided.find(decision.write);
    if (found == server.sharing.undecided.end()) return;
    const std::vector<LoggedEdit> edits = std::move(found->second);
    server.sharing.undecided.erase(found);
    if (decision.isAccepted) return accept(server, edits, decision.firstNumber);
    takeBack(server, edits);
    server.sharing.refused.insert(decision.write);
}

// Drops edits that the store has. A chunk that was read before they were saved may still be on its way from a
// worker, so they are kept for kKeepTail.
void dropTail(ServerState& server, std::int64_t nowSaved) {
    SharingState& sharing = server.sharing;
    const Time now = server.now;
    if (nowSaved > sharing.saved) sharing.savedAt.push_back({now, nowSaved});
    sharing.saved = std::max(sharing.saved, nowSaved);
    std::optional<std::int64_t> before;
    for (; !sharing.savedAt.empty() && now - sharing.savedAt.front().first > kKeepTail;
         sharing.savedAt.pop_front())
        before = sharing.savedAt.front().second;
    if (!before) return;
    const std::int64_t saved = *before;
    std::vector<ChunkPos> changed;  // chunks whose stored rows have new edits
    for (auto& [chunk, edits] : sharing.tail)
        if (std::erase_if(edits, [&](const SharingState::TailEdit& edit) { return edit.number <= saved; }) >
            0)
            changed.push_back(chunk);
    if (server.onChanged && !changed.empty()) server.onChanged(changed);
    std::erase_if(sharing.tail, [](const auto& entry) { return entry.second.empty(); });
}

void applyPlayers(ServerState& server, const SharedChanges& changes) {
    for (const KnownPlayer& player : changes.players) {
        server.knownPlayers.learn(player);
        server.session.permissions.roles[player.id] = player.role;
        ServerClient* client = playingClient(server, player.id);
        if (client && client->role != player.role) {
            client->role = player.role;
            send(*client, RoleChanged{player.role});
        }
        if (client && !player.ban.empty()) refuse(server, *client, Refusal::Banned, banText(player.ban));
    }
    for (const game::PlayerId id : changes.refused) {
        if (ServerClient* client = playingClient(server, id))
            refuse(server, *client, Refusal::Name, "another player took the name at the same time");
        server.knownPlayers.forget(id);
    }
    for (const game::PlayerId id : changes.joined)
        if (ServerClient* client = playingClient(server, id))
            refuse(server, *client, Refusal::Replaced, "you joined again elsewhere");
    for (const game::PlayerId id : changes.left) server.sharing.players.erase(id);
    if (changes.claims) {
        server.knownPlayers.setClaims(*changes.claims);
        server.session.permissions.claims = server.knownPlayers.claims();
    }
}

}  // namespace

base::Result<void> beginSharing(ServerState& server) {
    SharingState& sharing = server.sharing;
    sharing.shared = server.records.shared();
    if (!sharing.shared) return {};
    const auto ends = TERRANE_TRY(server.records.historyEnds());
    sharing.newest = ends.newest;
    sharing.saved = ends.saved;
    sharing.ownSaved = ends.newest;
    const auto take = [&](const LoggedEdit& edit) -> base::Result<void> {
        if (edit.number > sharing.newest) return {};  // applySharedChanges() will deliver it
        addToTail(sharing, edit.chunk, edit.number, edit.after);
        server.edited.add(edit.chunk);
        return {};
    };
    const EditFilter unsaved{.afterNumber = ends.saved};
    TERRANE_TRY(server.records.forEachEdit(unsaved, EditOrder::OldestFirst, take));
    stream::ChunkPipeline& pipeline = server.session.pipeline();
    pipeline.setSaveFilter(
        [undecided = sharing.undecidedChunks](ChunkPos chunk) { return !undecided->contains(chunk); });
    (void)pipeline.takeLoaded();
    server.edited.setTail([&sharing](ChunkPos chunk) { return tailOf(sharing, chunk); });
    return {};
}

void trackWrite(ServerState& server, std::uint64_t write, std::vector<LoggedEdit> edits) {
    SharingState& sharing = server.sharing;
    if (!sharing.shared) return;
    for (const LoggedEdit& edit : edits) {
        ++(*sharing.undecidedChunks)[edit.chunk];
        for (const ChangedBlock& block : edit.before) {
            const world::BlockPos pos = world::blockPos(edit.chunk, block.index);
            ++sharing.settled.try_emplace(pos, SharingState::Settled{block.value, 0}).first->second.undecided;
        }
    }
    sharing.undecided.emplace(write, std::move(edits));
}

void applySharedChanges(ServerState& server) {
    SharingState& sharing = server.sharing;
    if (!sharing.shared) return;
    SharedChanges changes = sharing.shared->popChanges();
    for (const HistoryEvent& event : changes.history) {
        if (const auto* edit = std::get_if<LoggedEdit>(&event))
            applyOther(server, *edit);
        else
            applyDecision(server, std::get<WriteDecision>(event));
    }
    sharing.newest = std::max(sharing.newest, changes.newest);
    server.session.store().setVersion(sharing.newest);
    dropTail(server, changes.saved);
    applyPlayers(server, changes);
    applyPoses(server, changes);
    for (const SharedLine& line : changes.lines) broadcastChatLocally(server, line.name, line.text);
    onTilesChanged(server, changes.tiles);
    if (changes.allPlaces) replacePlaces(server, *changes.allPlaces);
    for (const PlaceChange& change : changes.places) applyPlaceChange(server, change);
    if (changes.passwordHash) server.passwordHash = *changes.passwordHash;
    if (changes.timeDay) setTimeHere(server, *changes.timeDay);
    if (changes.servers) setOtherServers(server, std::move(*changes.servers));
}

void completeLoaded(ServerState& server) {
    SharingState& sharing = server.sharing;
    if (!sharing.shared) return;
    for (const ChunkPos pos : server.session.pipeline().takeLoaded()) {
        const auto found = sharing.tail.find(pos);
        if (found == sharing.tail.end()) continue;
        // Usually the loaded chunk already has these values.
        ChunkDifference blocks = tailOf(sharing, pos);
        std::erase_if(blocks, [&](const ChangedBlock& block) {
            return world::blockValue(server.session.world(), world::blockPos(pos, block.index)) ==
                   block.value;
        });
        if (blocks.empty()) continue;
        server.session.setBlocks(placedBlocks(pos, blocks));
        noteUnsaved(server, pos, found->second.front().number);
    }
}

void updateSharing(ServerState& server) {
    SharingState& sharing = server.sharing;
    if (!sharing.shared) return;
    sharing.refused.clear();  // the players were told, unless they left
    publishPosesIfDue(server);
    saveOrphans(server);
    publishSavedPlaces(server);
    if (server.now < sharing.nextState) return;
    sharing.nextState = server.now + kStateEvery;
    sharing.shared->publishState(static_cast<int>(server.playing.size()), sharing.ownSaved);
}

void autosaveShared(ServerState& server) {
    SharingState& sharing = server.sharing;
    ServerHistory& history = server.history;
    store::ChunkStore& store = server.session.store();
    if (history.saving && store.status().durable >= history.saving->save) {
        sharing.ownSaved = history.saving->edit;
        sharing.savesDone = sharing.savesBegun;
        history.saving.reset();
    }
    if (history.saving || server.now < history.nextSave) return;
    history.nextSave = server.now + kHistorySaveEvery;
    stream::ChunkPipeline& pipeline = server.session.pipeline();
    ++sharing.savesBegun;
    pipeline.saveAll();
    std::erase_if(sharing.firstUnsaved, [&](const auto& entry) { return !pipeline.isUnsaved(entry.first); });
    std::int64_t upTo = sharing.newest;
    for (const auto& [chunk, number] : sharing.firstUnsaved) upTo = std::min(upTo, number - 1);
    history.saving = {upTo, game::saveTimeDay(store, server.session.clock.timeDay)};
}

bool mayGrow(const ServerState& server, ChunkPos chunk) {
    return !server.sharing.shared || server.sharing.shared->mayGrow(regionOf(chunk));
}

void requestRegions(ServerState& server, std::span<const ChunkPos> chunks) {
    if (!server.sharing.shared) return;
    std::set<Region> regions;
    for (const ChunkPos chunk : chunks) regions.insert(regionOf(chunk));
    server.sharing.shared->requestRegions({regions.begin(), regions.end()});
}

}  // namespace terrane::net

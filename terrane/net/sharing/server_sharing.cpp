#include "terrane/net/sharing/server_sharing.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "terrane/net/server/server_clients.h"
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

void noteUnsaved(SharingState& sharing, const stream::ChunkPipeline& pipeline, ChunkPos chunk,
                 std::int64_t number) {
    if (pipeline.isUnsaved(chunk)) sharing.firstUnsaved.try_emplace(chunk, number);
}

// Applies an edit of another server if its chunk is loaded, and returns whether it is. Own undecided edits of
// the same blocks will be refused.
bool applyOther(SharingState& sharing, game::Session& session, const LoggedEdit& edit) {
    addToTail(sharing, edit.chunk, edit.number, edit.after);
    for (const ChangedBlock& block : edit.after) {
        const auto found = sharing.settled.find(world::blockPos(edit.chunk, block.index));
        if (found != sharing.settled.end()) found->second.value = block.value;
    }
    if (!session.world().maybeChunkAt(edit.chunk)) return false;
    session.setBlocks(placedBlocks(edit.chunk, edit.after));
    noteUnsaved(sharing, session.pipeline(), edit.chunk, edit.number);
    return true;
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

void accept(SharingState& sharing, const stream::ChunkPipeline& pipeline,
            const std::vector<LoggedEdit>& edits, std::int64_t number) {
    for (const LoggedEdit& edit : edits) {
        for (const ChangedBlock& block : edit.after)
            sharing.settled.at(world::blockPos(edit.chunk, block.index)).value = block.value;
        settle(sharing, edit);
        addToTail(sharing, edit.chunk, number, edit.after);
        noteUnsaved(sharing, pipeline, edit.chunk, number);
        ++number;
    }
}

// Reverts a refused write to the values of the history. Later own writes on top of it will be refused as
// well.
void takeBack(SharingState& sharing, game::Session& session, const std::vector<LoggedEdit>& edits) {
    std::vector<world::PlacedBlock> blocks;
    for (const LoggedEdit& edit : edits) {
        for (const ChangedBlock& block : edit.after) {
            const world::BlockPos pos = world::blockPos(edit.chunk, block.index);
            blocks.push_back({pos, sharing.settled.at(pos).value});
        }
        settle(sharing, edit);
    }
    session.setBlocks(blocks);
}

// Changes the decision that the player of the write waits for: another server was first.
void refuseWrite(ServerClients& clients, std::uint64_t write) {
    forEachPlaying(clients, [&](ServerClient& client) {
        for (Decision& decision : client.decisions)
            if (decision.write == write)
                decision.done = {decision.done.number, decision.resultIfRefused, 0, 0};
    });
}

void applyDecision(SharingState& sharing, game::Session& session, ServerClients& clients,
                   const WriteDecision& decision) {
    const auto found = sharing.undecided.find(decision.write);
    if (found == sharing.undecided.end()) return;
    const std::vector<LoggedEdit> edits = std::move(found->second);
    sharing.undecided.erase(found);
    if (decision.isAccepted) return accept(sharing, session.pipeline(), edits, decision.firstNumber);
    takeBack(sharing, session, edits);
    refuseWrite(clients, decision.write);
}

}  // namespace

// A chunk that was read before its edits were saved may still be on its way from a worker, so they are kept
// for kKeepTail.
std::vector<ChunkPos> dropTail(SharingState& sharing, std::int64_t nowSaved, Time now) {
    if (nowSaved > sharing.saved) sharing.savedAt.push_back({now, nowSaved});
    sharing.saved = std::max(sharing.saved, nowSaved);
    std::optional<std::int64_t> before;
    for (; !sharing.savedAt.empty() && now - sharing.savedAt.front().first > kKeepTail;
         sharing.savedAt.pop_front())
        before = sharing.savedAt.front().second;
    if (!before) return {};
    std::vector<ChunkPos> changed;
    for (auto& [chunk, edits] : sharing.tail)
        if (std::erase_if(edits, [&](const SharingState::TailEdit& edit) { return edit.number <= *before; }) >
            0)
            changed.push_back(chunk);
    std::erase_if(sharing.tail, [](const auto& entry) { return entry.second.empty(); });
    return changed;
}

void applyPlayers(ServerClients& clients, game::Permissions& permissions, const SharedChanges& changes) {
    for (const KnownPlayer& player : changes.players) {
        clients.known.learn(player);
        permissions.roles[player.id] = player.role;
        ServerClient* client = playingClient(clients, player.id);
        if (client && client->role != player.role) {
            client->role = player.role;
            send(*client, RoleChanged{player.role});
        }
        if (client && !player.ban.empty()) refuse(clients, *client, Refusal::Banned, banText(player.ban));
    }
    for (const game::PlayerId id : changes.refused) {
        if (ServerClient* client = playingClient(clients, id))
            refuse(clients, *client, Refusal::Name, "another player took the name at the same time");
        clients.known.forget(id);
    }
    for (const game::PlayerId id : changes.joined)
        if (ServerClient* client = playingClient(clients, id))
            refuse(clients, *client, Refusal::Replaced, "you joined again elsewhere");
    for (const game::PlayerId id : changes.left) clients.elsewhere.erase(id);
    if (changes.claims) {
        clients.known.setClaims(*changes.claims);
        permissions.claims = clients.known.claims();
    }
}

base::Result<void> beginSharing(SharingState& sharing, ServerRecords& records, game::Session& session,
                                EditedChunks& edited) {
    sharing.shared = records.shared();
    if (!sharing.shared) return {};
    const auto ends = TERRANE_TRY(records.historyEnds());
    sharing.newest = ends.newest;
    sharing.saved = ends.saved;
    sharing.ownSaved = ends.newest;
    const auto take = [&](const LoggedEdit& edit) -> base::Result<void> {
        if (edit.number > sharing.newest) return {};  // SharedWorld::popChanges() will deliver it
        addToTail(sharing, edit.chunk, edit.number, edit.after);
        edited.add(edit.chunk);
        return {};
    };
    const EditFilter unsaved{.afterNumber = ends.saved};
    TERRANE_TRY(records.forEachEdit(unsaved, EditOrder::OldestFirst, take));
    stream::ChunkPipeline& pipeline = session.pipeline();
    pipeline.setSaveFilter(
        [undecided = sharing.undecidedChunks](ChunkPos chunk) { return !undecided->contains(chunk); });
    (void)pipeline.takeLoaded();
    edited.setTail([&sharing](ChunkPos chunk) { return tailOf(sharing, chunk); });
    return {};
}

void trackWrite(SharingState& sharing, std::uint64_t write, std::vector<LoggedEdit> edits) {
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

void applyHistory(SharingState& sharing, game::Session& session, ServerClients& clients, ServerEdits& edits,
                  const SharedChanges& changes) {
    for (const HistoryEvent& event : changes.history) {
        if (const auto* decision = std::get_if<WriteDecision>(&event)) {
            applyDecision(sharing, session, clients, *decision);
            continue;
        }
        const auto& edit = std::get<LoggedEdit>(event);
        if (!applyOther(sharing, session, edit)) sendBlocks(clients, edits, edit.chunk, edit.after);
    }
    sharing.newest = std::max(sharing.newest, changes.newest);
    session.store().setVersion(sharing.newest);
}

void completeLoaded(SharingState& sharing, game::Session& session) {
    if (!sharing.shared) return;
    for (const ChunkPos pos : session.pipeline().takeLoaded()) {
        const auto found = sharing.tail.find(pos);
        if (found == sharing.tail.end()) continue;
        // Usually the loaded chunk already has these values.
        ChunkDifference blocks = tailOf(sharing, pos);
        std::erase_if(blocks, [&](const ChangedBlock& block) {
            return world::blockValue(session.world(), world::blockPos(pos, block.index)) == block.value;
        });
        if (blocks.empty()) continue;
        session.setBlocks(placedBlocks(pos, blocks));
        noteUnsaved(sharing, session.pipeline(), pos, found->second.front().number);
    }
}

void updateSharing(SharingState& sharing, const ServerClients& clients, ServerPlaces& places,
                   stream::ChunkPipeline& pipeline) {
    if (!sharing.shared) return;
    publishPosesIfDue(sharing, clients);
    saveOrphans(sharing, pipeline);
    publishSavedPlaces(places);
    if (clients.now < sharing.nextState) return;
    sharing.nextState = clients.now + kStateEvery;
    sharing.shared->publishState(static_cast<int>(clients.playing.size()), sharing.ownSaved);
}

std::int64_t beginSharedSave(SharingState& sharing, game::Session& session) {
    ++sharing.savesBegun;
    session.queueSaves();
    std::erase_if(sharing.firstUnsaved,
                  [&](const auto& entry) { return !session.pipeline().isUnsaved(entry.first); });
    std::int64_t upTo = sharing.newest;
    for (const auto& [chunk, number] : sharing.firstUnsaved) upTo = std::min(upTo, number - 1);
    return upTo;
}

void endSharedSave(SharingState& sharing, std::int64_t edit) {
    sharing.ownSaved = edit;
    sharing.savesDone = sharing.savesBegun;
}

std::vector<ChunkPos> growingChunks(const SharedWorld* shared, const std::vector<ChunkPos>& chunks) {
    if (!shared) return chunks;
    std::vector<ChunkPos> growing;
    std::ranges::copy_if(chunks, std::back_inserter(growing),
                         [&](ChunkPos chunk) { return shared->mayGrow(regionOf(chunk)); });
    return growing;
}

void requestRegions(SharedWorld& shared, std::span<const ChunkPos> chunks) {
    std::set<Region> regions;
    for (const ChunkPos chunk : chunks) regions.insert(regionOf(chunk));
    shared.requestRegions({regions.begin(), regions.end()});
}

}  // namespace terrane::net

#include "terrane/net/server/server_history.h"

#include <map>

#include "terrane/base/log.h"
#include "terrane/game/player_state.h"
#include "terrane/net/server/server_players.h"

namespace terrane::net {
namespace {

// Chunks of a rollback per tick: some milliseconds.
constexpr std::size_t kRollbackChunks = 8;

// Waits until all own edits are decided among the servers.
base::Result<void> decideAll(ServerState& server) {
    if (!server.sharing.shared) return {};
    auto flushed = server.records.flush();
    applySharedChanges(server);
    return flushed;
}

}  // namespace

void logChanges(ServerState& server, game::PlayerId player, std::span<const game::ChangedBlock> changes) {
    ServerHistory& history = server.history;
    std::vector<LoggedEdit> edits = loggedEdits(history.newest + 1, player, nowMs(), changes);
    if (edits.empty()) return;
    if (!server.sharing.shared) history.newest = edits.back().number;
    history.lastWrite = server.records.append(edits);
    trackWrite(server, history.lastWrite, std::move(edits));
}

std::int64_t newestEdit(const ServerState& server) {
    return server.sharing.shared ? server.sharing.newest : server.history.newest;
}

base::Result<void> restoreEdits(ServerState& server) {
    if (server.records.shared()) return {};  // beginSharing() reads the tail instead
    ServerHistory& history = server.history;
    const auto ends = TERRANE_TRY(server.records.historyEnds());
    history.newest = ends.newest;
    history.saved = ends.saved;
    std::map<world::ChunkPos, ChunkDifference> chunks;
    const auto take = [&](const LoggedEdit& edit) -> base::Result<void> {
        mergeInto(chunks[edit.chunk], edit.after);
        return {};
    };
    const EditFilter unsaved{.afterNumber = ends.saved};
    TERRANE_TRY(server.records.forEachEdit(unsaved, EditOrder::OldestFirst, take));
    if (chunks.empty()) return {};
    for (const auto& [pos, blocks] : chunks) {
        (void)server.session.pipeline().chunkAt(pos);
        server.session.setBlocks(placedBlocks(pos, blocks));
    }
    base::logInfo("{} chunks brought back from the history, edits {} to {}", chunks.size(), ends.saved + 1,
                  ends.newest);
    return saveEverything(server);
}

void autosave(ServerState& server) {
    if (server.sharing.shared) return autosaveShared(server);
    ServerHistory& history = server.history;
    store::ChunkStore& store = server.session.store();
    if (history.saving && store.status().durable >= history.saving->save) {
        history.saved = history.saving->edit;
        server.records.setSavedEdit(history.saved);
        history.saving.reset();
    }
    if (history.saving || server.now < history.nextSave) return;
    history.nextSave = server.now + kHistorySaveEvery;
    server.session.pipeline().saveAll();
    const store::SaveNumber number = game::saveTimeDay(store, server.session.clock.timeDay);
    if (history.saved < history.newest) history.saving = {history.newest, number};
}

base::Result<void> saveEverything(ServerState& server) {
    // Finishes running rollbacks.
    while (!server.rollbacks.empty()) {
        (void)server.session.pipeline().chunkAt(server.rollbacks.front().chunk);
        completeLoaded(server);
        continueRollbacks(server);
    }
    TERRANE_TRY(decideAll(server));
    game::saveTimeDay(server.session.store(), server.session.clock.timeDay);
    TERRANE_TRY(server.session.save());
    if (server.sharing.shared) {
        publishSavedPlaces(server);
        server.sharing.shared->publishState(0, server.sharing.newest);
    }
    if (server.history.saved < server.history.newest) {
        server.history.saved = server.history.newest;
        server.records.setSavedEdit(server.history.newest);
    }
    server.history.saving.reset();
    return server.records.flush();
}

base::Result<std::size_t> startRollback(ServerState& server, const EditFilter& filter) {
    // The reader sees only durable edits.
    TERRANE_TRY(server.records.flush());
    const auto forEachEdit = [&](const EditFilter& selected, EditOrder order, const UseEdit& use) {
        return server.records.forEachEdit(selected, order, use);
    };
    auto plan = TERRANE_TRY(rollback(forEachEdit, filter));
    // Each block occurs once in the plan. Parts of earlier rollbacks stay separate, even of the same chunk.
    const std::size_t first = server.rollbacks.size();
    for (RolledBack& block : plan) {
        const world::ChunkPos chunk = world::chunkOf(block.pos);
        if (server.rollbacks.size() == first || server.rollbacks.back().chunk != chunk)
            server.rollbacks.push_back({chunk, {}});
        server.rollbacks.back().blocks.push_back(std::move(block));
    }
    return plan.size();
}

void continueRollbacks(ServerState& server) {
    game::Session& session = server.session;
    // Loads the chunks of the next parts ahead.
    for (std::size_t k = 0; k < std::min(server.rollbacks.size(), 4 * kRollbackChunks); ++k)
        (void)session.pipeline().maybeLoadChunkAt(server.rollbacks[k].chunk);
    for (std::size_t k = 0; k < kRollbackChunks && !server.rollbacks.empty(); ++k) {
        const RollbackPart& part = server.rollbacks.front();
        if (!session.world().maybeChunkAt(part.chunk)) return;
        std::vector<world::PlacedBlock> blocks;
        std::vector<game::ChangedBlock> changes;
        for (const RolledBack& block : part.blocks) {
            if (world::blockValue(session.world(), block.pos) != block.made) continue;
            blocks.push_back({block.pos, block.before});
            changes.push_back({block.pos, block.made, block.before});
        }
        session.setBlocks(blocks);
        logChanges(server, game::kNoPlayer, changes);
        server.rollbacks.pop_front();
    }
}

}  // namespace terrane::net

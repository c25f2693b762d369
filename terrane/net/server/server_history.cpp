#include "terrane/net/server/server_history.h"

#include <map>

#include "terrane/base/log.h"
#include "terrane/game/player_state.h"
#include "terrane/net/sharing/server_sharing.h"

namespace terrane::net {
namespace {

// Chunks of a rollback per tick: some milliseconds.
constexpr std::size_t kRollbackChunks = 8;

}  // namespace

void logChanges(ServerHistory& history, SharingState& sharing, game::PlayerId player,
                std::span<const game::ChangedBlock> changes) {
    std::vector<LoggedEdit> edits = loggedEdits(history.newest + 1, player, nowMs(), changes);
    if (edits.empty()) return;
    if (!sharing.shared) history.newest = edits.back().number;
    history.lastWrite = history.records.append(edits);
    trackWrite(sharing, history.lastWrite, std::move(edits));
}

base::Result<bool> restoreEdits(ServerHistory& history, game::Session& session) {
    if (history.records.shared()) return false;  // beginSharing() reads the tail instead
    const auto ends = TERRANE_TRY(history.records.historyEnds());
    history.newest = ends.newest;
    history.saved = ends.saved;
    std::map<world::ChunkPos, ChunkDifference> chunks;
    const auto take = [&](const LoggedEdit& edit) -> base::Result<void> {
        mergeInto(chunks[edit.chunk], edit.after);
        return {};
    };
    const EditFilter unsaved{.afterNumber = ends.saved};
    TERRANE_TRY(history.records.forEachEdit(unsaved, EditOrder::OldestFirst, take));
    if (chunks.empty()) return false;
    for (const auto& [pos, blocks] : chunks) {
        (void)session.pipeline().chunkAt(pos);
        session.setBlocks(placedBlocks(pos, blocks));
    }
    base::logInfo("{} chunks brought back from the history, edits {} to {}", chunks.size(), ends.saved + 1,
                  ends.newest);
    return true;
}

void autosave(ServerHistory& history, SharingState& sharing, game::Session& session, Time now) {
    store::ChunkStore& store = session.store();
    if (history.saving && store.status().durable >= history.saving->save) {
        if (sharing.shared) {
            endSharedSave(sharing, history.saving->edit);
        } else {
            history.saved = history.saving->edit;
            history.records.setSavedEdit(history.saved);
        }
        history.saving.reset();
    }
    if (history.saving || now < history.nextSave) return;
    history.nextSave = now + kHistorySaveEvery;
    std::int64_t upTo = history.newest;
    if (sharing.shared)
        upTo = beginSharedSave(sharing, session.pipeline());
    else
        session.pipeline().saveAll();
    const store::SaveNumber number = game::saveTimeDay(store, session.clock.timeDay);
    if (sharing.shared || history.saved < upTo) history.saving = {upTo, number};
}

base::Result<std::size_t> startRollback(ServerHistory& history, const EditFilter& filter) {
    // The reader sees only durable edits.
    TERRANE_TRY(history.records.flush());
    const auto forEachEdit = [&](const EditFilter& selected, EditOrder order, const UseEdit& use) {
        return history.records.forEachEdit(selected, order, use);
    };
    auto plan = TERRANE_TRY(rollback(forEachEdit, filter));
    // Each block occurs once in the plan. Parts of earlier rollbacks stay separate, even of the same chunk.
    const std::size_t first = history.rollbacks.size();
    for (RolledBack& block : plan) {
        const world::ChunkPos chunk = world::chunkOf(block.pos);
        if (history.rollbacks.size() == first || history.rollbacks.back().chunk != chunk)
            history.rollbacks.push_back({chunk, {}});
        history.rollbacks.back().blocks.push_back(std::move(block));
    }
    return plan.size();
}

void continueRollbacks(ServerHistory& history, SharingState& sharing, game::Session& session) {
    // Loads the chunks of the next parts ahead.
    for (std::size_t k = 0; k < std::min(history.rollbacks.size(), 4 * kRollbackChunks); ++k)
        (void)session.pipeline().maybeLoadChunkAt(history.rollbacks[k].chunk);
    for (std::size_t k = 0; k < kRollbackChunks && !history.rollbacks.empty(); ++k) {
        const RollbackPart& part = history.rollbacks.front();
        if (!session.world().maybeChunkAt(part.chunk)) return;
        std::vector<world::PlacedBlock> blocks;
        std::vector<game::ChangedBlock> changes;
        for (const RolledBack& block : part.blocks) {
            if (world::blockValue(session.world(), block.pos) != block.made) continue;
            blocks.push_back({block.pos, block.before});
            changes.push_back({block.pos, block.made, block.before});
        }
        session.setBlocks(blocks);
        logChanges(history, sharing, game::kNoPlayer, changes);
        history.rollbacks.pop_front();
    }
}

}  // namespace terrane::net

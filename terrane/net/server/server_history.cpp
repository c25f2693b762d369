#include "terrane/net/server/server_history.h"

#include <algorithm>
#include <chrono>
#include <map>

#include "terrane/base/log.h"
#include "terrane/base/text.h"
#include "terrane/game/player_state.h"
#include "terrane/net/sharing/server_sharing.h"

namespace terrane::net {
namespace {

// Chunks of a rollback per tick: some milliseconds.
constexpr std::size_t kRollbackChunks = 8;

ForEachEdit readerOf(ServerRecords& records) {
    return [&records](const EditFilter& selected, EditOrder order, const UseEdit& use) {
        return records.forEachEdit(selected, order, use);
    };
}

// Warns once while the system's clock is behind the stamps.
void warnIfBehind(StampClock& stamps, std::int64_t newestMs, std::int64_t systemMs) {
    const std::int64_t ahead = newestMs - systemMs;
    const bool isBehind = ahead > kWarnedOfDateMs;
    if (isBehind && !stamps.isBehind)
        base::logWarning(
            "the newest edit of the history has a date {} ahead of the clock: the clock is wrong, or "
            "was; new edits are dated after it",
            base::counted(static_cast<std::uint64_t>(ahead / 60'000), "minute"));
    stamps.isBehind = isBehind;
}

}  // namespace

std::int64_t StampClock::at(Time now) {
    begin(now);
    const auto since = std::chrono::duration_cast<std::chrono::milliseconds>(now - newestAt);
    newestAt += since;  // in whole milliseconds, so that no part of one is lost
    newestMs += since.count();
    const std::int64_t system = systemMs();
    warnIfBehind(*this, newestMs, system);
    return newestMs = std::max(newestMs, system);
}

void StampClock::hear(std::int64_t stampMs, Time now) {
    begin(now);
    const auto since = std::chrono::duration_cast<std::chrono::milliseconds>(now - newestAt);
    if (stampMs <= newestMs + since.count()) return;
    newestMs = std::min(stampMs, kLastDateMs);
    newestAt = now;
}

void startStamps(ServerHistory& history) {
    const auto newest = newestEdit(readerOf(history.records), {});
    if (!newest || !*newest) return;  // none; who reads the history hears of damage
    history.stamps.newestMs = std::min((*newest)->timeMs, kLastDateMs);
    warnIfBehind(history.stamps, history.stamps.newestMs, history.stamps.systemMs());
}

void logChanges(ServerHistory& history, SharingState& sharing, game::Author author, Time now,
                std::span<const game::ChangedBlock> changes) {
    std::vector<LoggedEdit> edits = loggedEdits(history.newest + 1, author, history.stamps.at(now), changes);
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
    base::logInfo("{} brought back from the history, edits {} to {}", base::counted(chunks.size(), "chunk"),
                  ends.saved + 1, ends.newest);
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
        upTo = beginSharedSave(sharing, session);
    else
        session.queueSaves();
    const store::SaveNumber number = game::saveTimeDay(store, session.clock.timeDay);
    if (sharing.shared || history.saved < upTo) history.saving = {upTo, number};
}

base::Result<std::size_t> startRollback(ServerHistory& history, EditFilter filter, std::int64_t ms,
                                        Time now) {
    // The reader sees only durable edits.
    TERRANE_TRY(history.records.flush());
    const ForEachEdit forEachEdit = readerOf(history.records);
    TERRANE_TRY(selectSince(filter, forEachEdit, history.stamps.at(now) - ms));
    auto plan = TERRANE_TRY(rollback(forEachEdit, filter));
    // Each block occurs once in the plan. Parts of earlier rollbacks stay separate, even of the same chunk.
    const std::size_t first = history.rollbacks.size();
    for (game::ChangedBlock& block : plan) {
        const world::ChunkPos chunk = world::chunkOf(block.pos);
        if (history.rollbacks.size() == first || history.rollbacks.back().chunk != chunk)
            history.rollbacks.push_back({chunk, {}, {}});
        history.rollbacks.back().blocks.push_back(std::move(block));
    }
    return plan.size();
}

void continueRollbacks(ServerHistory& history, SharingState& sharing, game::Session& session, Time now) {
    if (history.rollbacks.empty()) return;
    // Loads the chunks of the next parts ahead.
    for (std::size_t k = 0; k < std::min(history.rollbacks.size(), 4 * kRollbackChunks); ++k)
        (void)session.pipeline().maybeLoadChunkAt(history.rollbacks[k].chunk);
    for (std::size_t k = 0; k < kRollbackChunks && !history.rollbacks.empty(); ++k) {
        if (!session.world().maybeChunkAt(history.rollbacks.front().chunk)) return;
        const RollbackPart part = std::move(history.rollbacks.front());
        history.rollbacks.pop_front();
        session.runRules(part.settling);
        const std::vector<world::PlacedBlock> blocks = game::blocksBefore(session.world(), part.blocks);
        history.rolledBack += blocks.size();
        history.keptByRollbacks += part.blocks.size() - blocks.size();
        std::vector<game::ChangedBlock> changes;
        RollbackPart settling{part.chunk, {}, {}};
        for (const world::PlacedBlock& block : blocks) {
            changes.push_back({block.pos, world::blockValue(session.world(), block.pos), block.value});
            settling.settling.push_back(block.pos);
        }
        session.setBlocks(blocks);
        logChanges(history, sharing, {}, now, changes);
        if (!blocks.empty()) history.rollbacks.push_back(std::move(settling));
    }
    if (!history.rollbacks.empty()) return;
    base::logInfo("{} rolled back; {} that changed since {}", base::counted(history.rolledBack, "block"),
                  history.keptByRollbacks, history.keptByRollbacks == 1 ? "stays" : "stay");
    history.rolledBack = history.keptByRollbacks = 0;
}

}  // namespace terrane::net

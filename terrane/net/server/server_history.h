// Records the edit history and saves the world's store after it: after a crash the history restores what the
// store lacks, so no acknowledged decision is lost. On the server's thread.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <span>

#include "terrane/net/server/server_state.h"

namespace terrane::net {

// Logs the changes of a player's command, or of a rollback (game::kNoPlayer).
void logChanges(ServerHistory& history, SharingState& sharing, game::PlayerId player,
                std::span<const game::ChangedBlock> changes);

// Applies edits that the world's store lacks, and returns whether there are any. Call before players join;
// blocks.
[[nodiscard]] base::Result<bool> restoreEdits(ServerHistory& history, game::Session& session);

constexpr std::chrono::seconds kHistorySaveEvery{5};
// Sends edited chunks to the store every kHistorySaveEvery, and notes once they are saved. Call in each tick.
void autosave(ServerHistory& history, SharingState& sharing, game::Session& session, Time now);

// Reverts the selected edits where the blocks still have the edited value; runs over several ticks. Returns
// the number of blocks to check.
[[nodiscard]] base::Result<std::size_t> startRollback(ServerHistory& history, const EditFilter& filter);
void continueRollbacks(ServerHistory& history, SharingState& sharing, game::Session& session);

}  // namespace terrane::net

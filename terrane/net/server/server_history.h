// Records the edit history and saves the world's store after it: after a crash the history restores what the
// store lacks, so no acknowledged decision is lost. On the server's thread.
#pragma once

#include <chrono>
#include <span>

#include "terrane/net/server/server_state.h"

namespace terrane::net {

// Logs the changes of a player's command, or of a rollback (game::kNoPlayer).
void logChanges(ServerState& server, game::PlayerId player, std::span<const game::ChangedBlock> changes);

// Number of the world's newest edit, across all its servers.
std::int64_t newestEdit(const ServerState& server);

// Applies edits that the world's store lacks. Call before players join; blocks.
[[nodiscard]] base::Result<void> restoreEdits(ServerState& server);

constexpr std::chrono::seconds kHistorySaveEvery{5};
// Sends edited chunks to the store every kHistorySaveEvery, and notes in the history once they are saved.
// Call in each tick.
void autosave(ServerState& server);
// Saves all changes to the store and the records. Blocks.
[[nodiscard]] base::Result<void> saveEverything(ServerState& server);

// Reverts the selected edits where the blocks still have the edited value; runs over several ticks. Returns
// the number of blocks to check.
[[nodiscard]] base::Result<std::size_t> startRollback(ServerState& server, const EditFilter& filter);
void continueRollbacks(ServerState& server);

}  // namespace terrane::net

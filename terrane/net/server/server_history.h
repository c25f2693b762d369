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
void logChanges(ServerHistory& history, SharingState& sharing, game::Author author, Time now,
                std::span<const game::ChangedBlock> changes);

// Continues the stamps of the history's edits. Warns if the newest one is of the future.
void startStamps(ServerHistory& history);

// Applies edits that the world's store lacks, and returns whether there are any. Call before players join;
// blocks.
[[nodiscard]] base::Result<bool> restoreEdits(ServerHistory& history, game::Session& session);

constexpr std::chrono::seconds kHistorySaveEvery{5};
// Sends edited chunks to the store every kHistorySaveEvery, and notes once they are saved. Call in each tick.
void autosave(ServerHistory& history, SharingState& sharing, game::Session& session, Time now);

// Reverts the selected edits of the last `ms` milliseconds where the blocks are still what the edit made
// them, as undo does, and runs the rules: liquid without a source runs dry. Runs over several ticks; then a
// message says how many blocks changed. Returns the number of blocks to check. Which edits are the last ones
// follows from their order: an edit is older than all with greater numbers, whatever date it had.
[[nodiscard]] base::Result<std::size_t> startRollback(ServerHistory& history, EditFilter filter,
                                                      std::int64_t ms, Time now);
void continueRollbacks(ServerHistory& history, SharingState& sharing, game::Session& session, Time now);

}  // namespace terrane::net

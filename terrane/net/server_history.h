// Keeps the history of edits, and the world's own file behind it: what the history has is brought back after
// a crash, so that no decision that a client heard of is lost. On the server's thread.
#pragma once

#include <chrono>
#include <span>

#include "terrane/net/server_state.h"

namespace terrane::net {

// A player's command, or a roll-back (game::kNoPlayer), changed these blocks.
void logChanges(ServerState& server, game::PlayerId player, std::span<const game::ChangedBlock> changes);

// The number of the world's newest edit, of all servers of it.
std::int64_t newestEdit(const ServerState& server);

// Edits that the world's file lacks are made again. Before anybody plays; blocks.
[[nodiscard]] base::Result<void> restoreEdits(ServerState& server);

constexpr std::chrono::seconds kHistorySaveEvery{5};
// Every few seconds edited chunks go to the store; once they are there the history notes it. In each tick.
void keepSaving(ServerState& server);
// All that changed is in both files. Blocks.
[[nodiscard]] base::Result<void> saveEverything(ServerState& server);

// Takes back edits of players, where the blocks are still what those made them; goes on for some ticks. How
// many blocks it is about.
[[nodiscard]] base::Result<std::size_t> startRollback(ServerState& server, const EditFilter& filter);
void continueRollbacks(ServerState& server);

}  // namespace terrane::net

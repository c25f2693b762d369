// Commands that edit blocks: a command goes to the session, which checks it, changes the world and reports
// the changes to the pipeline as world::BlockEdit. All are plain values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "terrane/world/changes/block_edit.h"

namespace terrane::game {

using PlayerId = std::uint32_t;
// The world itself (growth) and scripts, which have no reach to check.
constexpr PlayerId kNoPlayer = 0;
constexpr PlayerId kLocalPlayer = 1;  // of a game without a network

constexpr double kReach = 8;  // blocks from the eyes of a player

struct EditCommand {
    PlayerId player = kNoPlayer;
    world::BlockPos pos;
    world::BlockChange change;
    std::optional<world::BlockId> expected;  // the block that the player saw there
};

enum class EditResult : std::uint8_t {
    Applied,
    Unchanged,   // the block is there already, or cannot stand there
    NotLoaded,   // no chunk is loaded, or the position is above or below the world
    OutOfReach,  // or the player is unknown
    Conflict,    // there is another block than expected
    Protected,   // the lowest layer of the world, which holds all else: no player breaks it
    NotEmpty,    // it holds items: no player breaks it before they are taken out
    BadData,     // no valid text, for a sign
    NotAllowed,  // to this player: Role::Guest
    Claimed,     // it is in a claim of somebody else
};

// The result of undoing or redoing a step.
struct UndoResult {
    enum class Outcome : std::uint8_t {
        Done,
        NoStep,
        NotLoaded,   // some chunk of it is not loaded: nothing changes, and the step stays the next one
        NotAllowed,  // the player may not change some block of it (permissions.h): likewise
        Sent,        // to the server that decides (Authority); the result comes later
    };
    Outcome outcome = Outcome::NoStep;
    std::size_t blocks = 0;   // restored
    std::size_t skipped = 0;  // not restored, since others changed them
};

}  // namespace terrane::game

// The one door for edits: whoever wants a block to change sends a command to the session, which checks it,
// changes the world and tells the pipeline by a world::BlockEdit what became of it. Plain values.
#pragma once

#include <cstdint>
#include <optional>

#include "terrane/world/block_edit.h"

namespace terrane::game {

using PlayerId = std::uint32_t;
// The world itself (growth) and scripts: nobody whose reach could be checked.
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
};

}  // namespace terrane::game

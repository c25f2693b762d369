// Commands that edit blocks: a command goes to the session, which checks it, changes the world and reports
// the changes to the pipeline as world::BlockEdit. All are plain values.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "terrane/world/changes/block_edit.h"

namespace terrane::game {

using PlayerId = std::uint32_t;
// The world itself (growth) and scripts, which have no reach to check.
constexpr PlayerId kNoPlayer = 0;
constexpr PlayerId kLocalPlayer = 1;  // of a game without a network

// A content pack whose rules change blocks, by its number in Session::packs.
using PackId = std::uint32_t;
constexpr PackId kNoPack = 0;

// Who changes blocks. A pack may act for a player, whose permissions then hold.
struct Author {
    PlayerId player = kNoPlayer;
    PackId pack = kNoPack;

    auto operator<=>(const Author&) const = default;
};
// An author as one number, which is that of the player if no pack acts.
constexpr std::uint64_t numberOf(Author author) {
    return std::uint64_t{author.pack} << 32 | author.player;
}
constexpr Author authorOf(std::uint64_t number) {
    return {static_cast<PlayerId>(number), static_cast<PackId>(number >> 32)};
}

constexpr double kReach = 8;  // blocks from the eyes of a player

struct EditCommand {
    PlayerId player = kNoPlayer;
    world::BlockPos pos;
    world::BlockChange change;
    std::optional<world::BlockId> expected;  // the block that the player saw there
    PackId pack = kNoPack;                   // that changes it, for the player or for nobody: in any distance
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
    Refused,     // by a listener of BeforeBlockAction (events.h), whose reason was said to the player
    NoItem,      // in survival: the player does not have what this needs
    NoRoom,      // in survival: the player has no room for what this gives
    TooSoon,     // in survival: breaking the block takes longer
    Creative,    // only in creative
    Sent,        // to the server that decides (Authority)
    Count
};

// The result of undoing or redoing a step.
struct UndoResult {
    enum class Outcome : std::uint8_t {
        Done,
        NoStep,
        NotLoaded,   // some chunk of it is not loaded: nothing changes, and the step stays the next one
        NotAllowed,  // the player may not change some block of it (permissions.h): likewise
        Sent,        // to the server that decides (Authority); the result comes later
        Refused,     // by a listener of BeforeBuildAction (events.h), whose reason was said to the player
    };
    Outcome outcome = Outcome::NoStep;
    std::size_t blocks = 0;   // restored
    std::size_t skipped = 0;  // not restored, since others changed them
};

}  // namespace terrane::game

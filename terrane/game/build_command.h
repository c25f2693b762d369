// Commands that change a box of blocks at once, through Session::build(): each is one step to undo. All are
// plain values and functions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "terrane/game/edit_command.h"
#include "terrane/game/fill_shape.h"
#include "terrane/world/changes/structure.h"

namespace terrane::game {

// The largest distance in blocks from the eyes of a player to the nearest block of the box.
constexpr double kBuildReach = 64;

// Fills the shape in the box with one block; with `replaced`, only in place of blocks of that type.
struct FillBox {
    world::BlockBox box;
    world::BlockId id = world::kAir;
    std::uint16_t state = 0;
    std::optional<world::BlockId> replaced;
    FillShape shape = {};
};
// Replaces all blocks of the box that begins at `low`, by air too. Invalid texts of signs are left out, and
// inventories get the slots of their block (world::fittedInventory()).
struct PlaceStructure {
    std::shared_ptr<const world::Structure> structure;  // not null
    world::BlockPos low;
};
using BuildChange = std::variant<FillBox, PlaceStructure>;

struct BuildCommand {
    PlayerId player = kNoPlayer;
    BuildChange change;
    PackId pack = kNoPack;  // see EditCommand::pack
};

struct BuildOutcome {
    enum class Result : std::uint8_t {
        Done,
        Empty,       // the box or the structure has no blocks
        TooLarge,    // more than world::kMaxStructureBlocks
        OutOfWorld,  // above or below the world
        NotLoaded,   // some chunk of it is not loaded
        OutOfReach,  // or the player is unknown
        NotAllowed,  // the player may not change some block of it (permissions.h)
        TooSoon,     // a server allows the player so many blocks only after a while
        Sent,        // to the server that decides (Authority); the result comes later
        Refused,     // by a listener of BeforeBuildAction (events.h), whose reason was said to the player
    };
    Result result = Result::Empty;
    std::size_t changed = 0;  // blocks that changed
    std::size_t skipped = 0;  // blocks of the lowest layer, which no player breaks
};

// Returns the box that a change affects. `low` is above `high` if there is no structure or it has no blocks.
world::BlockBox boxOf(const BuildChange& change);
// Returns the distance from a point to the nearest point of the box.
double distanceTo(const world::BlockBox& box, const glm::dvec3& point);

struct PlannedBlocks {
    // The blocks that change, ordered by chunk, then by block index.
    std::vector<world::PlacedBlock> blocks;
    std::size_t skipped = 0;
};
// Returns the new values of the blocks. With `protectsFloor`, the lowest layer stays unless it is air.
PlannedBlocks plannedBlocks(const world::World& world, const world::BlockRegistry& blocks,
                            const BuildChange& change, bool protectsFloor);

}  // namespace terrane::game

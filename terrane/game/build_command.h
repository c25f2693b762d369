// Commands that change a box of blocks at once, through Session::build(): each is one step to undo. Plain
// values and functions.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "terrane/game/edit_command.h"
#include "terrane/world/structure.h"

namespace terrane::game {

// Blocks from the eyes of a player to the nearest one of the box: how far one sees what one builds.
constexpr double kBuildReach = 64;

// Fills the box with one block, or puts it in the place of each block of one type there.
struct FillBox {
    world::BlockBox box;
    world::BlockId id = world::kAir;
    std::uint16_t state = 0;
    std::optional<world::BlockId> replaced;
};
// Replaces all blocks of the box that begins at `low`, by air too. Text that is none is left out.
struct PlaceStructure {
    std::shared_ptr<const world::Structure> structure;  // not null
    world::BlockPos low;
};
using BuildChange = std::variant<FillBox, PlaceStructure>;

struct BuildCommand {
    PlayerId player = kNoPlayer;
    BuildChange change;
};

struct BuildOutcome {
    enum class Result : std::uint8_t {
        Done,
        Empty,       // the box has no blocks, or the structure is none
        TooLarge,    // more than world::kMaxStructureBlocks
        OutOfWorld,  // above or below the world
        NotLoaded,   // some chunk of it is not loaded
        OutOfReach,  // or the player is unknown
        NotAllowed,  // the player may not change some block of it (permissions.h)
        Sent,        // to the server that decides (Authority): what becomes of it is told later
    };
    Result result = Result::Empty;
    std::size_t changed = 0;  // blocks that are others now
    std::size_t kept = 0;     // blocks of the lowest layer, which no player breaks
};

// The blocks that a change is about. `low` above `high` where a structure has none.
world::BlockBox boxOf(const BuildChange& change);
// Distance from a point to the nearest point of the box.
double distanceTo(const world::BlockBox& box, const glm::dvec3& point);

struct PlannedBlocks {
    // Without those that are the same already; chunk by chunk and in a chunk by block index.
    std::vector<world::PlacedBlock> blocks;
    std::size_t kept = 0;
};
// What the world's blocks become. `protectsFloor`: the lowest layer stays where it is not air.
PlannedBlocks plannedBlocks(const world::World& world, const world::BlockRegistry& blocks,
                            const BuildChange& change, bool protectsFloor);

}  // namespace terrane::game

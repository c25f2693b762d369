// A character that walks, jumps, swims and falls. It advances at a fixed rate on the thread that owns the
// world; characterEye() interpolates between two steps.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/world.h"

namespace terrane::world {

// A sweep moves a box until blocks stop it, on the thread that owns the world.
//
// Moves axis by axis, each in one sweep over all blocks on the way, so that no speed takes a box through a
// block. Chunks that are not loaded count as full.
// Blocks; exact to 2^-22 at the edge of the world.
struct Aabb {
    glm::dvec3 min{0}, max{1};
};

struct Sweep {
    glm::dvec3 moved{0};
    glm::bvec3 blocked{false};  // by axis: less far than asked for
};

// Returns the distance that `box` moves by `motion` (cut to kMaxMotion along each axis): first up or down,
// then along x, then y. Stops kSkin before an obstacle. A box that is already inside a block can leave it.
Sweep sweep(const World& world, const BlockRegistry& blocks, const Aabb& box, glm::dvec3 motion);
constexpr double kMaxMotion = 64, kSkin = 1.0 / 4096;

// Returns whether a collision box of a block overlaps the box; touching does not count.
bool collides(const World& world, const BlockRegistry& blocks, const Aabb& box);

// Returns whether the point is in a liquid. The cell of a source counts as full, that of flowing liquid up to
// its surface.
bool isInLiquid(const World& world, const BlockRegistry& blocks, glm::dvec3 point);

// Blocks and seconds. A jump reaches kJumpSpeed² / 2 kGravity = 1.28 blocks, enough for one.
constexpr double kCharacterWidth = 0.6, kCharacterHeight = 1.8, kEyeHeight = 1.62;
constexpr double kGravity = 26, kJumpSpeed = 8.15, kFallLimit = 55;
constexpr double kWalkSpeed = 4.5, kRunSpeed = 7.5, kSwimSpeed = 3.2, kClimbSpeed = 3;
constexpr double kFlySpeed = 11, kFlyRunSpeed = 22;
constexpr double kStepHeight = 0.6;  // walked up without a jump
constexpr double kStepSeconds = 1.0 / 120;

struct Character {
    glm::dvec3 feet{0};  // middle of the underside
    glm::dvec3 velocity{0};
    bool isOnGround = false;
    bool isSwimming = false;
    bool isClimbing = false;
    bool isBlocked = false;  // by an obstacle, in the last step
};

// The player's input. `direction` is horizontal, of length 0…1.
struct CharacterInput {
    glm::dvec2 direction{0};
    bool runs = false, jumps = false, dives = false;
    bool hasGravity = true;  // else it flies; up and down are `jumps` and `dives`
    bool autoJump = false;   // onto a block that is in the way
};

// Returns the character kStepSeconds later. A character inside a block, for example after a block was placed
// there, is lifted out; a character that extends into a chunk that is not loaded waits for it.
Character advanceCharacter(const World& world, const BlockRegistry& blocks, const Character& before,
                           const CharacterInput& input);

Aabb characterBox(glm::dvec3 feet);

// Returns the eye at `share` (0…1) between two steps. This smooths steps up, too.
inline glm::dvec3 characterEye(const Character& before, const Character& now, double share) {
    return before.feet + (now.feet - before.feet) * share + glm::dvec3(0, 0, kEyeHeight);
}

}  // namespace terrane::world

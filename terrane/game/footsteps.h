// Decides when a player on foot makes a sound: steps, landings, strokes in water. Pure bookkeeping, called
// once a frame.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

#include "terrane/world/block_registry.h"
#include "terrane/world/character.h"
#include "terrane/world/world.h"

namespace terrane::game {

struct FootEvent {
    enum class Kind : std::uint8_t { Step, Land, Climb, Splash, Swim };
    Kind kind = Kind::Step;
    float strength = 1;  // 0 to 1

    bool operator==(const FootEvent&) const = default;
};

class Footsteps {
  public:
    // The event since the last call; one at most. A character that was teleported makes no sound.
    std::optional<FootEvent> advance(const world::Character& now);
    // Forgets the last character, for example after the player flew.
    void reset() { before_.reset(); }

  private:
    std::optional<world::Character> before_;
    double sinceStep_ = 0;  // blocks
    double fallSpeed_ = 0;  // in the last frame in the air, blocks/s
};

// The block under the feet, also at its edge; air if there is none.
world::BlockId groundUnder(const world::World& world, const world::BlockRegistry& blocks, glm::dvec3 feet);

}  // namespace terrane::game

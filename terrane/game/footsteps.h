// When a player on foot makes a sound: steps, landings, strokes in water. Pure bookkeeping, called once a
// frame.
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
    // What the character did since the last call; one event at most. A character that was moved from afar
    // makes no sound on its way.
    std::optional<FootEvent> advance(const world::Character& now);
    // The next call begins anew, as after the player flew.
    void reset() { before_.reset(); }

  private:
    std::optional<world::Character> before_;
    double sinceStep_ = 0;  // blocks
    double fallSpeed_ = 0;  // of the last moment in the air, blocks a second
};

// The block that carries the feet, also where they stand over its edge; air in the air.
world::BlockId groundUnder(const world::World& world, const world::BlockRegistry& blocks, glm::dvec3 feet);

}  // namespace terrane::game

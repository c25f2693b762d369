// What a player does to blocks: breaks, builds, and which block it builds with. Called once a frame.
#pragma once

#include <optional>
#include <vector>

#include "terrane/game/held_button.h"
#include "terrane/game/player.h"
#include "terrane/game/session.h"
#include "terrane/world/ray_cast.h"

namespace terrane::game {

class BlockInteraction {
  public:
    explicit BlockInteraction(const world::BlockRegistry& blocks);

    HeldButton breaking, building;

    world::BlockId block() const { return kinds_[chosen_]; }
    // Steps through the kinds of blocks, around in a circle.
    void choose(int steps);
    // The kind of a block that is looked at.
    void choose(world::BlockId kind);

    // The block that the player looks at and can reach, as of the last act().
    const std::optional<world::RayHit>& target() const { return target_; }

    // Uses the block that the player looks at, as a door is opened. False where it cannot be used.
    bool use(Session& session, PlayerId id);

    // Breaks or builds where a button is held, by commands to the session; never into the player.
    void act(Session& session, PlayerId id, const Player& player, double seconds);

  private:
    std::vector<world::BlockId> kinds_;
    std::size_t chosen_ = 0;
    std::optional<world::RayHit> target_;
};

}  // namespace terrane::game

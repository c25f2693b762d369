// What a player does to blocks: breaks, builds, and which block it builds with. Called once a frame.
#pragma once

#include <optional>

#include "terrane/game/held_button.h"
#include "terrane/game/hotbar.h"
#include "terrane/game/player.h"
#include "terrane/game/session.h"
#include "terrane/world/ray_cast.h"

namespace terrane::game {

class BlockInteraction {
  public:
    explicit BlockInteraction(const world::BlockRegistry& blocks) : hotbar(firstHotbar(blocks)) {}

    HeldButton breaking, building;

    Hotbar hotbar;  // its chosen block is built

    world::BlockId block() const { return hotbar.block(); }

    // The block that the player looks at and can reach, as of the last act().
    const std::optional<world::RayHit>& target() const { return target_; }

    // Uses the block that the player looks at, as a door is opened. False where it cannot be used.
    bool use(Session& session, PlayerId id);

    // Takes the block that the player looks at in the hand. False where there is none.
    bool pick(const Session& session);

    // Breaks or builds where a button is held, by commands to the session; never into the player. What became
    // of the command; nothing where none was sent.
    std::optional<EditResult> act(Session& session, PlayerId id, const Player& player, double seconds);

  private:
    std::optional<EditResult> build(Session& session, PlayerId id, const Player& player,
                                    const world::Ray& ray) const;

    std::optional<world::RayHit> target_;
};

}  // namespace terrane::game

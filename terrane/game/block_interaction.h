// A player's actions on blocks: breaking, building and selecting the block to build; in survival, breaking
// takes time, and the item in the hand is used. The program calls it once a frame.
#pragma once

#include <optional>

#include "terrane/game/items.h"
#include "terrane/game/player.h"
#include "terrane/game/session.h"
#include "terrane/world/ray_cast.h"

namespace terrane::game {

// A button that acts when it is pressed and repeats while it is held.
class HeldButton {
  public:
    static constexpr double kFirstPause = 0.3, kPause = 0.15;  // seconds

    void press() { isDown_ = isNew_ = true; }
    // Releases the button. A button that is pressed and released within a frame still acts.
    void release() { isDown_ = false; }
    void cancel() { isDown_ = isNew_ = false; }
    bool isDown() const { return isDown_; }

    // Returns whether it acts in a frame of this length; at most once a frame.
    bool acts(double seconds) {
        if (isNew_) {
            isNew_ = false;
            wait_ = kFirstPause;
            return true;
        }
        if (!isDown_) return false;
        wait_ -= seconds;
        if (wait_ > 0) return false;
        wait_ = kPause;
        return true;
    }

  private:
    bool isDown_ = false, isNew_ = false;
    double wait_ = 0;  // seconds until it acts again
};

class BlockInteraction {
  public:
    explicit BlockInteraction(const world::BlockRegistry& blocks) : hotbar(defaultHotbar(blocks)) {}

    HeldButton breaking, building;

    Hotbar hotbar;  // its chosen block is built in creative; the chosen slot is that of survival too

    // Returns the block that is built: in survival that of the item in the hand, as of the last act().
    world::BlockId block() const { return held_.value_or(hotbar.block()); }

    // Returns how much of the block that the player looks at is broken in survival, 0 to 1.
    double broken() const { return mined_ ? mined_->done : 0; }

    // Returns the block that the player looks at and can reach, as of the last act().
    const std::optional<world::RayHit>& target() const { return target_; }

    // Uses the block that the player looks at, for example opens a door. Returns false if it cannot be used.
    bool use(Session& session, PlayerId id);

    // Selects in the hotbar the block that the player looks at; in survival, a slot of the hotbar that has
    // it. Returns false if there is no such block or slot, or players cannot build with it.
    bool pick(const Session& session, PlayerId id = kLocalPlayer);

    // Breaks or builds while a button is held, by commands to the session; never builds into the player.
    // Returns the result of the command, or nothing if none was sent.
    std::optional<EditResult> act(Session& session, PlayerId id, const Player& player, double seconds);

  private:
    // Breaking the block at `pos`, in survival.
    struct Mining {
        world::BlockPos pos;
        world::BlockId block = world::kAir;
        double done = 0;  // of 1
    };
    bool breaksNow(const Session& session, PlayerId id, double seconds);
    std::optional<EditResult> build(Session& session, PlayerId id, const Player& player,
                                    const world::Ray& ray) const;

    std::optional<world::RayHit> target_;
    std::optional<world::BlockId> held_;  // in survival
    std::optional<Mining> mined_;
};

}  // namespace terrane::game

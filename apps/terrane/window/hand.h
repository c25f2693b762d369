// What the person does to blocks: breaks, builds, and which block it builds with. Called by the game's
// loop once a frame.
#pragma once

#include <optional>
#include <vector>

#include "apps/terrane/window/held_button.h"
#include "apps/terrane/window/player.h"
#include "terrane/stream/chunk_pipeline.h"
#include "terrane/world/ray_cast.h"

namespace terrane::app {

class Hand {
  public:
    static constexpr double kReach = 8;  // blocks

    explicit Hand(const world::BlockRegistry& blocks);

    HeldButton breaking, building;

    world::BlockId block() const { return kinds_[chosen_]; }
    // Steps through the kinds of blocks, around in a circle.
    void choose(int steps);
    // The kind of a block that is looked at.
    void choose(world::BlockId kind);

    // What the person looks at and can reach, as of the last act().
    const std::optional<world::RayHit>& target() const { return target_; }

    // Breaks or builds where a button is held; never into the player.
    void act(const world::World& world, const world::BlockRegistry& blocks, stream::ChunkPipeline& pipeline,
             const Player& player, double seconds);

  private:
    std::vector<world::BlockId> kinds_;
    std::size_t chosen_ = 0;
    std::optional<world::RayHit> target_;
};

// The cell beside a face of a block.
world::BlockPos beside(world::BlockPos pos, world::Face face);

}  // namespace terrane::app

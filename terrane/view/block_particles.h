// Splinters that fly off a block that is broken: plain values that fall and end. Used on the world's thread.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <random>
#include <vector>

#include "terrane/world/block_registry.h"
#include "terrane/world/world.h"

namespace terrane::view {

struct Particle {
    glm::dvec3 position{0};
    glm::vec3 velocity{0};  // blocks a second
    float side = 0;         // of a square, in blocks
    float secondsLeft = 0;
    std::uint8_t shade = 0;  // 0…255: how bright beside the others of its block
    world::BlockId block = world::kAir;
};

class BlockParticles {
  public:
    // 24 of a block; at most 480 in all, the oldest go first: 480 × 48 bytes = 23 KB.
    static constexpr std::size_t kOfABlock = 24, kMost = 480;
    static constexpr float kSeconds = 0.8f, kGravity = 18;

    void burst(world::BlockPos pos, world::BlockId block);
    // They fall, and stop where a block is that collides.
    void advance(double seconds, const world::World& world, const world::BlockRegistry& blocks);
    const std::vector<Particle>& particles() const { return particles_; }

  private:
    std::vector<Particle> particles_;
    std::minstd_rand random_{1};  // of looks alone: nothing in the world depends on it
};

}  // namespace terrane::view

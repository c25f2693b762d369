// Particles of a broken block: plain values that fall and end. It is used on the world's thread.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <random>
#include <vector>

#include "terrane/world/blocks/block_registry.h"
#include "terrane/world/world.h"

namespace terrane::view {

struct Particle {
    glm::dvec3 position{0};
    glm::vec3 velocity{0};  // blocks a second
    float side = 0;         // of the square, in blocks
    float secondsLeft = 0;
    std::uint8_t shade = 0;  // 0…255: brightness among the particles of its block
    world::BlockId block = world::kAir;
};

class BlockParticles {
  public:
    // 24 particles a block, at most 480 in all; the oldest are removed first. 480 × 48 bytes = 23 KB.
    static constexpr std::size_t kParticlesPerBlock = 24, kMaxParticles = 480;
    static constexpr float kSeconds = 0.8f, kGravity = 18;

    void burst(world::BlockPos pos, world::BlockId block);
    // Moves all particles: they fall, and stop at blocks with collision.
    void advance(double seconds, const world::World& world, const world::BlockRegistry& blocks);
    const std::vector<Particle>& particles() const { return particles_; }

  private:
    std::vector<Particle> particles_;
    std::minstd_rand random_{1};  // for appearance only: the world does not depend on it
};

}  // namespace terrane::view

#include "terrane/view/block_particles.h"

#include <algorithm>
#include <glm/common.hpp>

#include "terrane/world/pose.h"

namespace terrane::view {
namespace {

constexpr float kLongestStep = 0.05f;  // seconds: no particle passes through a block

bool isSolid(const world::World& world, const world::BlockRegistry& blocks, const glm::dvec3& point) {
    const world::BlockPos at = world::blockOf(point);
    return world.heights().contains(at.z) && !blocks.type(world.block(at)).collision.empty();
}

}  // namespace

void BlockParticles::burst(world::BlockPos pos, world::BlockId block) {
    std::uniform_real_distribution<float> share(0, 1);
    const auto spread = [&] { return 2 * share(random_) - 1; };
    for (std::size_t k = 0; k < kParticlesPerBlock; ++k) {
        Particle p;
        p.position = {pos.x + 0.1 + 0.8 * double{share(random_)}, pos.y + 0.1 + 0.8 * double{share(random_)},
                      pos.z + 0.1 + 0.8 * double{share(random_)}};
        p.velocity = {1.6f * spread(), 1.6f * spread(), 1.0f + 2.2f * share(random_)};
        p.side = 0.06f + 0.07f * share(random_);
        p.secondsLeft = kSeconds * (0.5f + 0.5f * share(random_));
        p.shade = static_cast<std::uint8_t>(255 * share(random_));
        p.block = block;
        particles_.push_back(p);
    }
    if (particles_.size() > kMaxParticles)
        particles_.erase(particles_.begin(),
                         particles_.begin() + static_cast<std::ptrdiff_t>(particles_.size() - kMaxParticles));
}

void BlockParticles::advance(double seconds, const world::World& world, const world::BlockRegistry& blocks) {
    const float step = std::min(static_cast<float>(seconds), kLongestStep);
    for (Particle& p : particles_) {
        p.secondsLeft -= static_cast<float>(seconds);
        p.velocity.z -= kGravity * step;
        const glm::dvec3 next = p.position + glm::dvec3(p.velocity * step);
        if (isSolid(world, blocks, next))
            p.velocity = {0, 0, 0};
        else
            p.position = next;
    }
    std::erase_if(particles_, [](const Particle& p) { return p.secondsLeft <= 0; });
}

}  // namespace terrane::view

// Splinters of broken blocks on the screen.
#pragma once

#include "apps/terrane/window/overlay.h"
#include "terrane/view/block_particles.h"
#include "terrane/world/top_colors.h"

namespace terrane::app {

// As squares in the color of their block. `light`: what falls on them, 0…1.
void drawParticles(const Screen& screen, const render::Camera& camera, const view::BlockParticles& particles,
                   const world::TopColors& colors, const glm::vec3& light);

}  // namespace terrane::app

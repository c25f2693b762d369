// Draws the particles of broken blocks.
#pragma once

#include "apps/terrane/window/hud/overlay.h"
#include "terrane/view/block_particles.h"
#include "terrane/world/tint.h"

namespace terrane::app {

// Draws squares in the color of their block. `light`: on them, 0…1.
void drawParticles(const Screen& screen, const render::Camera& camera, const view::BlockParticles& particles,
                   const world::TopColors& colors, const glm::vec3& light);

}  // namespace terrane::app

// Draws the text of signs near the camera over the image, on the planes of their boards. Immediate mode.
#pragma once

#include <vector>

#include "apps/terrane/window/overlay.h"
#include "terrane/game/session.h"

namespace terrane::app {

constexpr double kSignDistance = 24;  // blocks at which text disappears

// The nearest signs around a point, at most 64. Visits the block entity data of the chunks there.
std::vector<world::BlockPos> signsNear(const game::Session& session, const glm::dvec3& point);

// Draws the letters that no block hides, of signs that face the camera; skips blocks that are no longer
// signs. Glass, liquids and plants hide no letters.
void drawSigns(const Screen& screen, const render::Camera& camera, const game::Session& session,
               const std::vector<world::BlockPos>& signs);

}  // namespace terrane::app

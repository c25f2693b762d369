// The text of signs near the camera, drawn over the image on the planes of their boards. Immediate mode.
#pragma once

#include <vector>

#include "apps/terrane/window/overlay.h"
#include "terrane/game/session.h"

namespace terrane::app {

constexpr double kSignDistance = 24;  // blocks from which text is seen

// Signs with text around a point, at most 64. Goes through the data of the chunks there.
std::vector<world::BlockPos> signsNear(const game::Session& session, const glm::dvec3& point);

// Those of them that are still signs, that face the camera, and each letter that no block hides. Blocks of
// glass, liquids and plants hide none.
void drawSigns(const Screen& screen, const render::Camera& camera, const game::Session& session,
               const std::vector<world::BlockPos>& signs);

}  // namespace terrane::app

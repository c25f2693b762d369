// A strip at the top of the image with the directions and named places. Immediate mode.
#pragma once

#include <span>

#include "apps/terrane/window/overlay.h"
#include "terrane/game/places.h"

namespace terrane::app {

void drawCompass(const Screen& screen, const world::Pose& pose, std::span<const game::Place> places);

}  // namespace terrane::app

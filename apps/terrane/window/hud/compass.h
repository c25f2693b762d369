// A strip at the top of the image with the directions and named places. Immediate mode.
#pragma once

#include <span>

#include "apps/terrane/window/hud/overlay.h"
#include "terrane/game/places.h"

namespace terrane::app {

void drawCompass(const Screen& screen, const world::Pose& pose, std::span<const game::Place> places);

// Debug view: a map of the loading state of the chunks around the camera, and of the far tiles beyond.
void drawLoadingMap(const Screen& screen, const stream::ChunkPipeline& pipeline,
                    const stream::TileTable& tiles);

}  // namespace terrane::app
